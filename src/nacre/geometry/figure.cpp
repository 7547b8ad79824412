#include "nacre/geometry/figure.h"

#include <fmt/format.h>

#include "nacre/geometry/figure_parts.h"
#include "nacre/geometry/sdf.h"
#include "nacre/geometry/surface_nets.h"
#include "nacre/math/error.h"

namespace nacre {
namespace figure {
using namespace sdf;

float torso(const Point3f& p) {
    const Point3f m{std::hypot(p.x, 12.f), p.y, p.z};  // mirrored without a crease
    float d = round_cone(p, {0, 235, -24}, {0, 95, -40}, 42, 50);  // neck
    const float mastoid = round_cone(p, {46, 248, -40}, {8, 108, 16}, 9, 6);
    const float mastoid_right = round_cone(p, {-56, 248, -16}, {-8, 108, 16}, 9, 6);
    d = smooth_union(d, std::min(mastoid, mastoid_right), 14);
    float chest = ellipsoid(p - Vec3f(0, 40, -34), {128, 78, 70});
    chest = smooth_union(chest, round_cone(m, {30, 148, -58}, {130, 70, -42}, 20, 38), 36);
    chest = smooth_union(chest,
                         bezier_tube(m, {9, 104, 24}, {56, 110, 26}, {120, 106, -24}, 4, 3, 5), 18);
    chest = smooth_union(chest, ellipsoid(m - Vec3f(46, 62, -4), {64, 50, 40}), 30);
    d = smooth_union(d, chest, 34);
    d += 4 * brush(p, {0, 110, 22}, {8, 10, 14});
    // The cut of a bust: round below, straight at the arms.
    d = smooth_intersection(d, ellipsoid(p - Vec3f(0, 165, -30), {132, 132, 112}), 4);
    float base = rounded_cylinder(p - Vec3f(0, 8, 0), 62, 8, 3);
    base = smooth_union(base, rounded_cylinder(p - Vec3f(0, 30, -8), 30, 30, 3), 14);
    return smooth_union(d, base, 6);
}

float collar(const Point3f& p) {
    const Vec3f axis{0, 0, -38};
    const float x = p.x - axis.x, z = p.z - axis.z;
    const float radius = std::hypot(x, z), angle = std::atan2(std::abs(x), -z);  // 0 behind
    const float rise = p.y - 100.f;
    const float pleat = 4.5f * smoothstep(0, 90, rise) * std::cos(13.f * angle);
    const float open = 58.f + 0.32f * rise + 0.0018f * rise * std::abs(rise) + pleat;
    const float s = (radius - open) * 0.8f;
    const float hem = std::max((p.y - mix(205, 88, smoothstep(0.35f, 2.1f, angle))) * 0.85f, 60.f - p.y);
    const float sheet = std::hypot(std::max(hem, 0.f), s) - 1.1f;
    return smooth_union(sheet, std::hypot(hem + 1.5f, s) - 1.9f, 2);
}

}  // namespace figure

float figure_distance(const Point3f& p) {
    using namespace sdf;
    static const Turn yaw = Turn::degrees(14), nod = Turn::degrees(-3);
    const Vec3f pivot{0, 232, -20};
    const Point3f local = turn_x(turn_y(p - pivot, Turn{yaw.c, -yaw.s}), nod);
    const Point3f h = local - Vec3f(0, 62, 20);
    float d = smooth_union(figure::face(h), figure::torso(p), 16);
    d = smooth_union(d, figure::ear(h), 5);
    d = smooth_union(d, figure::collar(p), 5);
    return smooth_union(d, figure::hair(h), 2);
}

Box3f figure_box() { return {{-150, -6, -190}, {150, 450, 130}}; }

Mesh make_figure(float resolution_mm) {
    if (!(resolution_mm >= 0.2f && resolution_mm <= 8.f))
        throw InputError(fmt::format(
            "figure: a resolution of {:.4g} mm is not possible; give 0.2 to 8 mm", resolution_mm));
    Mesh mesh = surface_nets(figure_distance, {figure_box(), resolution_mm, 1.5f});
    mesh.name = "figure";
    return mesh;
}

}  // namespace nacre
