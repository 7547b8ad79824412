// Ears and hair of the built-in sculpture.
#include "nacre/geometry/figure_parts.h"
#include "nacre/geometry/sdf.h"

namespace nacre::figure {
using namespace sdf;

// A thin dish drawn in its own plane: u to the back, v up, w away from the head. Its outline is a
// two-dimensional distance, of which the rim (helix) is a level line.
float ear(const Point3f& p) {
    static const Turn out = Turn::degrees(44), lean = Turn::degrees(14);
    const Vec3f root{70, -12, 2};
    // Turned about the vertical, the back edge stands out of the head; then the tip leans out.
    const Point3f h = turn_z(turn_y(mirror_x(p) - root, out), lean);
    const Point3f q{-h.z - 14.f, h.y, h.x};
    const float reach = length(q - Vec3f(12, 18, 0)) - 66.f;
    if (reach > 12.f) return reach;

    const Point3f flat{q.x, q.y, 0};
    const float outline = smooth_union(round_cone(flat, {-3, -27, 0}, {1, 2, 0}, 7.5f, 16),
                                       round_cone(flat, {3, 8, 0}, {30, 62, 0}, 17, 1.5f), 10);
    const float bend = -9.f * brush(flat, {-2, -6, 0}, {10, 12, 1}) - 0.0045f * square(q.y - 10.f) +
                       0.004f * square(q.x);
    const float w = q.z - bend;
    float d = std::hypot(std::max(outline + 0.6f, 0.f), w) - 1.1f;
    const float fade =
        smoothstep(-16, -6, q.x + 0.5f * q.y);  // no rim where the ear meets the cheek
    d = smooth_union(d, std::hypot(outline + 2.f, w - 1.4f * fade) - mix(1.f, 2.2f, fade), 2.5f);
    d = smooth_union(
        d, bezier_tube({q.x, q.y, w}, {1, -22, 1}, {13, -4, 1.5f}, {11, 24, 1}, 2, 2.4f, 1.2f),
        4);                                                                     // antihelix
    d = smooth_union(d, ellipsoid(q - Vec3f(-13, -7, 0), {3.5f, 5.5f, 4}), 4);  // tragus
    return d;
}

float hair(const Point3f& p) {
    const Point3f m = mirror_x(p);
    const float base = ellipsoid(m - Vec3f(0, 29, -19), {76, 88, 98});
    if (base > 70.f) return base - 20.f;

    // Polar coordinates about the axis from the face to the knot: locks are meridians.
    const Vec3f knot{0, 22, -122};
    const Vec3f r = m - Vec3f(0, 22, -16);
    const float around = std::atan2(r.x, r.y);
    const float along = std::atan2(std::hypot(r.x, r.y), r.z);
    const float swing = 0.16f * std::sin(6.5f * along);
    const float lock = std::abs(std::sin(9.f * (around + swing)));
    const float strand = std::abs(std::sin(27.f * (around + swing)));
    const float relief = (3.6f * std::sqrt(lock) + 0.9f * strand) * std::sin(along);

    const float front =
        0.58f * (m.y - 76.f) - 0.81f * (m.z - 69.f) + 7.f * brush(m, {38, 70, 50}, {22, 30, 40});
    const float nape = 0.92f * (m.y + 62.f) - 0.38f * (m.z + 90.f);
    const float inside = smooth_intersection(-front, -nape, 14);
    const float thick = mix(-8, 9, smoothstep(4, -14, inside));
    float d = 0.8f * (base - thick - relief);

    const Vec3f k = m - knot;
    const float turn = std::atan2(p.x, p.y - knot.y), radius = std::hypot(k.x, k.y);
    const float coil = std::abs(std::sin(0.16f * radius + 0.5f * turn));
    const float knob = ellipsoid(k, {36, 36, 28}) - 2.5f * std::sqrt(coil + 0.02f);
    return smooth_union(d, 0.8f * knob, 5);
}

}  // namespace nacre::figure
