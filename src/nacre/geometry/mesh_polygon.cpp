#include "nacre/geometry/mesh_polygon.h"

#include <cmath>
#include <deque>
#include <span>

#include "nacre/geometry/mesh_source.h"
#include "nacre/math/frame.h"

namespace nacre {
namespace {

struct Point {
    double x = 0, y = 0;
    bool operator==(const Point&) const = default;
};

/// Twice the signed area of a triangle.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Cuts one polygon in its plane. What counts as an ear loosens from level to level, since polygons
// that touch or cross themselves may have none in the strict sense.
class EarCutter {
  public:
    /// `tolerance` is the turn that rounding of the coordinates may make of none.
    EarCutter(std::vector<Point> points, double tolerance)
        : points_(std::move(points)), tolerance_(tolerance) {
        const std::size_t n = points_.size();
        nodes_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i)
            nodes_[i] = {i ? i - 1 : static_cast<std::uint32_t>(n - 1),
                         static_cast<std::uint32_t>(i + 1 < n ? i + 1 : 0)};
        // Only corners that are not convex can lie in an ear; sorted, few are looked at.
        for (std::uint32_t i = 0; i < n; ++i)
            if (turn_at(i) <= tolerance_) obstacles_.push_back(i);
        std::sort(obstacles_.begin(), obstacles_.end(),
                  [&](auto a, auto b) { return points_[a].x < points_[b].x; });
    }

    /// Hands each triangle's corners to emit(a, b, c).
    template <class Emit>
    void cut(const Emit& emit) {
        std::size_t left = points_.size();
        std::deque<std::uint32_t> waiting;
        std::uint32_t some = 0;  // a corner that is left
        for (int level = 0; left > 3;) {
            if (waiting.empty()) {
                if (swept_) ++level;
                swept_ = true;
                std::uint32_t i = some;
                do {
                    if (is_ear(i, level)) waiting.push_back(i);
                    i = nodes_[i].next;
                } while (i != some);
                continue;
            }
            const std::uint32_t tip = waiting.front();
            waiting.pop_front();
            // It may have changed since it was found.
            if (nodes_[tip].gone || !is_ear(tip, level)) continue;
            const auto [before, after, gone] = nodes_[tip];
            emit(before, tip, after);
            nodes_[tip].gone = true;
            nodes_[before].next = after;
            nodes_[after].before = before;
            --left;
            some = after;
            for (const std::uint32_t i : {before, after})
                if (is_ear(i, level)) waiting.push_back(i);
            swept_ = false;
        }
        emit(nodes_[some].before, some, nodes_[some].next);
    }

  private:
    struct Node {
        std::uint32_t before, next;
        bool gone = false;
    };

    const Point& at(std::uint32_t i) const { return points_[i]; }
    double turn_at(std::uint32_t i) const {
        return turn(at(nodes_[i].before), at(i), at(nodes_[i].next));
    }

    bool is_ear(std::uint32_t tip, int level) const {
        const Point &a = at(nodes_[tip].before), &b = at(tip), &c = at(nodes_[tip].next);
        // Edges of no length and edges there and back bound nothing.
        if (a == b || b == c || a == c || level >= 4) return true;
        const double area = turn(a, b, c);
        if (level == 3) return area >= 0;
        if (!(area > (level == 0 ? tolerance_ : 0))) return false;
        // Levels 0 and 1 keep away from corners on the cut, too.
        const double margin = level == 0 ? -tolerance_ : 0;
        const auto inside = [&](double side) { return level == 2 ? side > 0 : side >= margin; };
        const auto [low, high] = std::minmax({a.x, b.x, c.x});
        const auto from = std::lower_bound(obstacles_.begin(), obstacles_.end(), low,
                                           [&](std::uint32_t i, double x) { return at(i).x < x; });
        for (auto o = from; o != obstacles_.end() && at(*o).x <= high; ++o) {
            const Point& p = at(*o);
            if (nodes_[*o].gone || p == a || p == b || p == c || turn_at(*o) > tolerance_) continue;
            if (inside(turn(a, b, p)) && inside(turn(b, c, p)) && inside(turn(c, a, p)))
                return false;
        }
        return true;
    }

    std::vector<Point> points_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> obstacles_;
    double tolerance_;
    bool swept_ = false;
};

using Triangles = std::span<Mesh::Triangle>;

// Corner i of a polygon that is cut as a fan.
std::uint32_t corner(const Triangles& fan, std::size_t i) {
    return i < 2 ? fan[0][i] : fan[i - 2][2];
}

// Newell's normal: twice the vector area, whatever the corners; from the first corner on, as
// coordinates may be large.
Vec3d twice_area(const Mesh& mesh, const Triangles& fan) {
    const Vec3d origin(mesh.positions[fan[0][0]]);
    Vec3d sum{};
    for (const Mesh::Triangle& t : fan)
        sum += cross(Vec3d(mesh.positions[t[1]]) - origin, Vec3d(mesh.positions[t[2]]) - origin);
    return sum;
}

// The turn that rounding positions to single precision may make of none.
double rounding(const Mesh& mesh, const Triangles& fan) {
    double largest = 0, extent = 0;
    const Vec3d origin(mesh.positions[fan[0][0]]);
    for (std::size_t i = 0; i < fan.size() + 2; ++i) {
        const Vec3d p(mesh.positions[corner(fan, i)]);
        for (int k = 0; k < 3; ++k) {
            largest = std::max(largest, std::abs(p[k]));
            extent = std::max(extent, std::abs(p[k] - origin[k]));
        }
    }
    constexpr double kUnit = 0x1p-24;
    return 4 * kUnit * largest * extent;
}

bool fan_stays_inside(const Mesh& mesh, const Triangles& fan, const Vec3d& normal,
                      double tolerance) {
    const Vec3d origin(mesh.positions[fan[0][0]]);
    for (const Mesh::Triangle& t : fan)
        if (dot(cross(Vec3d(mesh.positions[t[1]]) - origin, Vec3d(mesh.positions[t[2]]) - origin),
                normal) < -tolerance)
            return false;
    return true;
}

void cut_if_concave(const Mesh& mesh, const Triangles& fan) {
    const Vec3d area = twice_area(mesh, fan);
    const double size = length(area);
    if (!(size > 0) || !std::isfinite(size)) return;  // no plane to cut it in
    const Vec3d normal = area / size;
    const double tolerance = rounding(mesh, fan);
    if (fan_stays_inside(mesh, fan, normal, tolerance)) return;
    const Frame<double> plane = Frame<double>::around(normal);
    const std::size_t corners = fan.size() + 2;
    const Vec3d origin(mesh.positions[fan[0][0]]);
    std::vector<std::uint32_t> vertices(corners);
    std::vector<Point> points(corners);
    for (std::size_t i = 0; i < corners; ++i) {
        vertices[i] = corner(fan, i);
        const Vec3d p = Vec3d(mesh.positions[vertices[i]]) - origin;
        points[i] = {dot(p, plane.s), dot(p, plane.t)};
    }
    std::size_t to = 0;
    EarCutter(std::move(points), tolerance).cut([&](auto a, auto b, auto c) {
        fan[to++] = {vertices[a], vertices[b], vertices[c]};
    });
}

}  // namespace

void Polygons::add(Mesh& mesh, const std::vector<std::uint32_t>& corners) {
    const std::size_t first = mesh.triangles.size();
    add_polygon(mesh, corners);
    if (corners.size() < 4) return;
    if (!runs_.empty()) {
        Run& last = runs_.back();
        if (last.corners == corners.size() &&
            last.first + last.count * (last.corners - 2) == first) {
            ++last.count;
            return;
        }
    }
    runs_.push_back({first, corners.size(), 1});
}

void Polygons::cut_concave(Mesh& mesh) const {
    for (const Run& run : runs_)
        for (std::size_t i = 0; i < run.count; ++i)
            cut_if_concave(mesh, Triangles(mesh.triangles)
                                     .subspan(run.first + i * (run.corners - 2), run.corners - 2));
}

}  // namespace nacre
