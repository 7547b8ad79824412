#include "nacre/geometry/polygon.h"

#include <array>
#include <cmath>

namespace nacre {
namespace {

struct Point2 {
    double x, y;
    bool operator==(const Point2&) const = default;
};

/// Twice the area of a triangle, positive if it is counter-clockwise.
double turn(const Point2& a, const Point2& b, const Point2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen along its Newell normal's largest component, counter-clockwise. Empty if it
/// has no area.
std::vector<Point2> flatten(std::span<const Point3f> corners) {
    Vec3d normal;
    const Vec3d origin(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        normal += cross(Vec3d(corners[i]) - origin, Vec3d(corners[i + 1]) - origin);
    const std::array<double, 3> size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int axis = size[0] > size[1] && size[0] > size[2] ? 0 : size[1] > size[2] ? 1 : 2;
    if (!(size[axis] > 0) || !std::isfinite(size[axis])) return {};
    // The axes after the one that is left out keep the orientation; turned round if seen from
    // behind.
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    std::vector<Point2> flat;
    flat.reserve(corners.size());
    for (const Point3f& p : corners) {
        const Vec3d relative = Vec3d(p) - origin;
        flat.push_back({relative[u], relative[v]});
    }
    return flat;
}

/// Whether the fan around corner 0 has no triangle that is turned the wrong way: then its triangles
/// do not overlap. What rounding of the coordinates may do to a straight corner counts as straight.
bool fan_covers(const std::vector<Point2>& p) {
    double area = 0, wrong = 0;
    for (std::size_t i = 2; i < p.size(); ++i) {
        const double t = turn(p[0], p[i - 1], p[i]);
        area += t;
        if (t < 0) wrong -= t;
    }
    return wrong <= 1e-6 * area;
}

/// A polygon that loses its ears.
class EarClipper {
  public:
    explicit EarClipper(const std::vector<Point2>& points) : p_(points) {
        const auto n = static_cast<std::uint32_t>(p_.size());
        next_.resize(n), previous_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) next_[i] = (i + 1) % n, previous_[(i + 1) % n] = i;
        for (std::uint32_t i = 0; i < n; ++i)
            if (!(corner(i) > 0)) reflex_.push_back(i);
    }

    void clip(std::vector<Mesh::Triangle>& triangles) {
        std::uint32_t at = 0;
        for (std::size_t left = p_.size(); left > 3; --left) {
            at = find_ear(at, left);
            triangles.push_back({previous_[at], at, next_[at]});
            const std::uint32_t before = previous_[at], after = next_[at];
            next_[before] = after;
            previous_[after] = before;
            // Of the others only the neighbours of an ear change, from reflex to convex.
            std::erase_if(reflex_, [&](std::uint32_t i) {
                return i == at || ((i == before || i == after) && corner(i) > 0);
            });
            at = next_[after];  // spreads the cuts instead of making a fan of slivers
        }
        triangles.push_back({previous_[at], at, next_[at]});
    }

  private:
    double corner(std::uint32_t i) const { return turn(p_[previous_[i]], p_[i], p_[next_[i]]); }

    bool is_ear(std::uint32_t i) const {
        if (!(corner(i) > 0)) return false;
        const Point2 &a = p_[previous_[i]], &b = p_[i], &c = p_[next_[i]];
        for (const std::uint32_t k : reflex_) {
            const Point2& q = p_[k];
            // The other end of a bridge to a hole lies on a corner of the ear and is no obstacle.
            if (q == a || q == b || q == c) continue;
            if (turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0) return false;
        }
        return true;
    }

    /// An ear from `at` on; without any (the polygon crosses itself, or is straight) a corner that
    /// costs least: a straight one, else any.
    std::uint32_t find_ear(std::uint32_t at, std::size_t left) const {
        std::uint32_t straight = at;
        bool found = false;
        for (std::size_t i = 0; i < left; ++i, at = next_[at]) {
            if (is_ear(at)) return at;
            if (!found && corner(at) == 0) straight = at, found = true;
        }
        return found ? straight : at;
    }

    const std::vector<Point2>& p_;
    std::vector<std::uint32_t> next_, previous_, reflex_;
};

}  // namespace

void cut_polygon(std::span<const Point3f> corners, std::vector<Mesh::Triangle>& triangles) {
    const std::vector<Point2> flat = flatten(corners);
    if (!flat.empty() && !fan_covers(flat)) return EarClipper(flat).clip(triangles);
    for (std::uint32_t i = 2; i < corners.size(); ++i) triangles.push_back({0, i - 1, i});
}

void PolygonList::cut() {
    std::vector<std::uint32_t> vertices;
    std::vector<Point3f> corners;
    std::vector<Mesh::Triangle> cut;
    for (const Polygon& polygon : polygons_) {
        Mesh::Triangle* fan = &mesh_.triangles[polygon.first_triangle];
        vertices.assign({fan[0][0], fan[0][1]});
        for (std::size_t i = 0; i + 2 < polygon.corners; ++i) vertices.push_back(fan[i][2]);
        corners.clear();
        for (const std::uint32_t v : vertices) corners.push_back(mesh_.positions[v]);
        cut.clear();
        cut_polygon(corners, cut);
        for (std::size_t i = 0; i < cut.size(); ++i)
            fan[i] = {vertices[cut[i][0]], vertices[cut[i][1]], vertices[cut[i][2]]};
    }
    polygons_ = {};
}

}  // namespace nacre
