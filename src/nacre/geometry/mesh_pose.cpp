#include "nacre/geometry/mesh_pose.h"

#include <cmath>
#include <numbers>

#include "nacre/geometry/area_sampler.h"
#include "nacre/geometry/mesh_topology.h"
#include "nacre/geometry/ray_scene.h"

namespace nacre {
namespace {

struct Vec2d {
    double x = 0, y = 0;
};
using Outline = std::vector<Vec2d>;

double turn_of(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Convex hull, counter-clockwise (Andrew's monotone chain).
Outline convex_hull(Outline points) {
    std::ranges::sort(points, [](const Vec2d& a, const Vec2d& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    Outline hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = hull.size();
        for (const Vec2d& p : points) {
            while (hull.size() >= begin + 2 && turn_of(hull[hull.size() - 2], hull.back(), p) <= 0)
                hull.pop_back();
            hull.push_back(p);
        }
        if (!hull.empty()) hull.pop_back();
        std::ranges::reverse(points);
    }
    return hull;
}

double area_of(const Outline& hull) {
    double sum = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Vec2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return 0.5 * sum;
}

/// How far inside of the hull a point is; negative outside.
double depth_in(const Outline& hull, const Vec2d& p) {
    double least = 1e300;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Vec2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
        const double side = std::hypot(b.x - a.x, b.y - a.y);
        if (side > 0) least = std::min(least, turn_of(a, b, p) / side);
    }
    return hull.size() < 3 ? -1e300 : least;
}

/// Of many points those that the hull may have: the outermost of each of 512 strips.
class OutermostPoints {
  public:
    OutermostPoints(double from, double to) : from_(from), per_strip_(count / (to - from)) {}

    void add(const Vec2d& p) {
        const double at = (p.x - from_) * per_strip_;
        Strip& strip = strips_[at > 0 ? std::min(std::size_t(at), count - 1) : 0];
        if (p.y < strip.low.y) strip.low = p;
        if (p.y > strip.high.y) strip.high = p;
        if (p.x < left_.x) left_ = p;
        if (p.x > right_.x) right_ = p;
    }
    Outline hull() const {
        Outline points;
        for (const Strip& s : strips_)
            if (s.low.y <= s.high.y) points.insert(points.end(), {s.low, s.high});
        if (!points.empty()) points.insert(points.end(), {left_, right_});
        return convex_hull(std::move(points));
    }

  private:
    static constexpr std::size_t count = 512;
    struct Strip {
        Vec2d low{0, 1e300}, high{0, -1e300};
    };
    double from_, per_strip_;
    std::vector<Strip> strips_{count};
    Vec2d left_{1e300, 0}, right_{-1e300, 0};
};

/// Twice the area of a triangle, as a vector along its normal.
Vec3d area_vector(const Mesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Vec3d o(mesh.positions[a]);
    return cross(Vec3d(mesh.positions[b]) - o, Vec3d(mesh.positions[c]) - o);
}

Vec3d middle_of(const Mesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return (Vec3d(mesh.positions[a]) + Vec3d(mesh.positions[b]) + Vec3d(mesh.positions[c])) / 3.;
}

Vec3d middle_of_surface(const Mesh& mesh) {
    Vec3d sum;
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double a = length(area_vector(mesh, t));
        sum += middle_of(mesh, t) * a;
        area += a;
    }
    return area > 0 ? sum / area : Vec3d(mesh.bounds().center());
}

/// What a shape stands on if a direction is up.
struct Base {
    double share = 0;   ///< of the outline from above
    double margin = 0;  ///< how far the middle is from its border, in the outline's size

    bool is_firm() const { return share >= 0.2 && margin >= 0.04; }
};

Base base_of(const Mesh& mesh, const Vec3d& middle, SignedAxis up) {
    const Box3f box = mesh.bounds();
    const int a = up.axis, b = (a + 1) % 3, c = (a + 2) % 3;
    const double near = 0.01 * length(Vec3d(box.diagonal()));
    const double ground = up.sign > 0 ? box.lower[a] : -double(box.upper[a]);
    OutermostPoints all(box.lower[b], box.upper[b]), low(box.lower[b], box.upper[b]);
    for (const Mesh::Triangle& t : mesh.triangles)
        for (const std::uint32_t i : t) {
            const Point3f& p = mesh.positions[i];
            all.add({p[b], p[c]});
            if (up.sign * double(p[a]) <= ground + near) low.add({p[b], p[c]});
        }
    const Outline base = low.hull();
    const double whole = area_of(all.hull());
    if (!(whole > 0) || base.size() < 3) return {};
    return {area_of(base) / whole, depth_in(base, {middle[b], middle[c]}) / std::sqrt(whole)};
}

SignedAxis guess_up(const Mesh& mesh, SignedAxis usual) {
    const Vec3d middle = middle_of_surface(mesh);
    std::vector<std::pair<SignedAxis, Base>> ways{{usual, base_of(mesh, middle, usual)}};
    for (const SignedAxis up : {SignedAxis{1, 1}, {2, 1}, {0, 1}, {1, -1}, {2, -1}, {0, -1}})
        if (!(up == usual)) ways.emplace_back(up, base_of(mesh, middle, up));
    double best = 0;
    for (const auto& [up, base] : ways)
        if (base.is_firm()) best = std::max(best, base.share);
    const Base& now = ways[0].second;
    if (best == 0 || (now.margin > 0.02 && now.share >= 0.3 * best)) return usual;
    for (const auto& [up, base] : ways)
        if (base.is_firm() && base.share >= 0.5 * best) return up;
    return usual;
}

/// How much of the surface has its mirror image on the surface, up to a fiftieth of the size.
double mirrored(const Mesh& mesh, int axis) {
    auto shared = std::make_shared<Mesh>();
    shared->positions.reserve(mesh.positions.size() + 1);
    shared->positions = mesh.positions;
    shared->triangles = mesh.triangles;
    RayScene rays;
    rays.add(shared);
    rays.build();
    const AreaSampler sampler(mesh);
    const Box3f box = mesh.bounds();
    const float near = 0.02f * length(box.diagonal());
    constexpr int count = 512;
    int found = 0;
    for (int i = 0; i < count; ++i) {
        const auto fraction = [](double x) { return x - std::floor(x); };
        const double s = (i + 0.5) / count, t = fraction(0.5 + 0.5698402910 * i);
        const SurfacePlace at = sampler.at(s, t, sampler.first_triangle(s));
        const auto& [a, b, c] = mesh.triangles[at.triangle];
        Point3f p = mesh.positions[a] + (mesh.positions[b] - mesh.positions[a]) * float(at.u) +
                    (mesh.positions[c] - mesh.positions[a]) * float(at.v);
        p[axis] = box.lower[axis] + (box.upper[axis] - p[axis]);
        found += rays.closest(p, near).has_value();
    }
    return double(found) / count;
}

/// Curvature by area of the upper half, where it looks along `front` over where it looks back.
double detail_ahead(const Mesh& mesh, SignedAxis up, SignedAxis front) {
    const Box3f box = mesh.bounds();
    const Vec3d center(box.center());
    const int side = 3 - up.axis - front.axis;
    const std::vector<SideIndex> neighbours = side_neighbours(mesh);
    double area[2] = {}, curvature[2] = {};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d normal = area_vector(mesh, t), from_center = middle_of(mesh, t) - center;
        const double ahead = front.sign * from_center[front.axis], size = length(normal);
        if (up.sign * from_center[up.axis] < 0 || std::abs(from_center[side]) > std::abs(ahead) ||
            !(size > 0))
            continue;
        const bool is_ahead = ahead > 0;
        area[is_ahead] += 0.5 * size;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const SideIndex other = neighbours[3 * t + k];
            if (other == kNoSide) continue;
            const Vec3d beyond = area_vector(mesh, other / 3);
            const double sizes = size * length(beyond);
            if (!(sizes > 0)) continue;
            const Vec3d edge = Vec3d(mesh.positions[mesh.triangles[t][(k + 1) % 3]]) -
                               Vec3d(mesh.positions[mesh.triangles[t][k]]);
            curvature[is_ahead] +=
                length(edge) * std::acos(std::clamp(dot(normal, beyond) / sizes, -1., 1.));
        }
    }
    if (!(area[0] > 0 && area[1] > 0 && curvature[0] > 0 && curvature[1] > 0)) return 1;
    return curvature[1] / area[1] / (curvature[0] / area[0]);
}

SignedAxis guess_front(const Mesh& mesh, SignedAxis up) {
    constexpr double much = 1.6, very_much = 2, mirror = 0.95, no_mirror = 0.9;
    const SignedAxis usual = usual_front(up);
    const int side = 3 - up.axis - usual.axis;
    const SignedAxis back{usual.axis, -usual.sign};
    if (const double detail = detail_ahead(mesh, up, usual); detail * much <= 1)
        return mirrored(mesh, side) >= mirror ? back : usual;
    const double aside = detail_ahead(mesh, up, {side, 1});
    if (aside < very_much && aside * very_much > 1) return usual;
    return mirrored(mesh, usual.axis) >= mirror && mirrored(mesh, side) < no_mirror
               ? SignedAxis{side, aside > 1 ? 1 : -1}
               : usual;
}

}  // namespace

std::string name_of(SignedAxis direction) {
    return {direction.sign > 0 ? '+' : '-', "xyz"[direction.axis]};
}

std::optional<SignedAxis> find_signed_axis(std::string_view word) {
    const int sign = word.starts_with('-') ? -1 : 1;
    if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
    if (word.size() != 1) return {};
    const std::size_t axis = std::string_view("xyzXYZ").find(word[0]);
    if (axis == std::string_view::npos) return {};
    return SignedAxis{int(axis % 3), sign};
}

Vec3f MeshPose::turn(const Vec3f& v) const {
    // The third axis of the right-handed frame is up x front; of axes, one entry is not zero.
    const int side = 3 - up.axis - front.axis;
    const int cyclic = (up.axis + 1) % 3 == front.axis ? 1 : -1;
    const auto along = [&](int axis, int sign) { return sign > 0 ? v[axis] : -v[axis]; };
    return {along(side, cyclic * up.sign * front.sign), along(up.axis, up.sign),
            along(front.axis, front.sign)};
}

SignedAxis usual_front(SignedAxis up) {
    if (up.axis == 1) return {2, up.sign};
    if (up.axis == 2) return {1, -up.sign};
    return {2, 1};
}

MeshPose guess_pose(const Mesh& mesh, SignedAxis usual_up, std::optional<SignedAxis> given_up) {
    MeshPose pose;
    pose.up = given_up.value_or(usual_up);
    pose.front = usual_front(pose.up);
    if (mesh.triangles.empty() || !(length(mesh.bounds().diagonal()) > 0.f)) return pose;
    if (!given_up) pose.up = guess_up(mesh, usual_up);
    pose.up_by_shape = !given_up && !(pose.up == usual_up);
    const SignedAxis usual = usual_front(pose.up);
    pose.front = guess_front(mesh, pose.up);
    pose.front_by_shape = !(pose.front == usual);
    return pose;
}

}  // namespace nacre
