// Ears and hair of the built-in sculpture.
#include "nacre/geometry/figure_parts.h"
#include "nacre/geometry/sdf.h"

namespace nacre::figure {
using namespace sdf;

// A thin dish drawn in its own plane: q.x to the back, q.y up, q.z out of the head. The outline is
// a distance within that plane; the rim (helix) follows one of its level lines.
float ears(const Point3f& h) {
    static const Turn out = Turn::degrees(40), lean = Turn::degrees(14);
    const Vec3f root{69, -12, 3};
    // Turned about the vertical, the back edge stands out of the head; then the tip leans out.
    const Point3f turned = turn_z(turn_y(mirror_x(h) - root, out), lean);
    const Point3f q{-turned.z - 14.f, turned.y, turned.x};
    const float reach = length(q - Vec3f(10, 18, 0)) - 62.f;
    if (reach > 12.f) return reach;  // far from the skin of the ear: any bound will do

    const Point3f flat{q.x, q.y, 0};
    const float outline = bezier_tube(flat, {-5, -27, 0}, {0, 30, 0}, {30, 70, 0}, 8, 20, 0.8f);
    const float dish = 0.006f * square(q.x) - 0.0035f * square(q.y - 5.f);
    const float bowl = 11.f * brush(flat, {-1, -7, 0}, {10, 14, 1});  // before the ear's hole
    const float w = q.z - dish + bowl;                                // height over the sheet
    float d = std::hypot(std::max(outline + 0.6f, 0.f), w) - 1.1f;

    const Point3f on_sheet{q.x, q.y, w};
    const float rim_fade = smoothstep(-17, -3, q.x + 0.3f * std::abs(q.y - 6.f));
    const float rim_radius = mix(0.8f, 2.3f, rim_fade) - 1.1f * smoothstep(25, 65, q.y);
    const float rim = std::hypot(outline + 2.2f, w - 1.6f * rim_fade) - rim_radius;
    const float rim_root =
        bezier_tube(on_sheet, {-13, 24, 0}, {-16, 2, 1}, {0, -4, 0}, 2, 2.2f, 0.5f);
    const float antihelix =
        bezier_tube(on_sheet, {1, -21, 0.5f}, {20, -5, 3}, {9, 34, 0.5f}, 2.4f, 3.4f, 0.3f);
    const float tragus = ellipsoid(q - Vec3f(-14, -9, 0), {3.5f, 6, 4});
    const float attachment = capsule(q, {-15, 16, -7}, {-13, -16, -7}, 6);
    d = smooth_union(d, std::min(rim, rim_root), 3);
    d = smooth_union(d, antihelix, 4);
    d = smooth_union(d, attachment, 7);
    return smooth_union(d, tragus, 5);
}

namespace {

// Positive where hair grows: behind the line from the forehead to the ears, above the nape, and not
// around the root of the ear.
float hairline(const Point3f& m) {
    const float front = 0.58f * (m.y - 76.f) - 0.81f * (m.z - 69.f) +
                        7.f * brush(m, {38, 70, 50}, {22, 30, 40});  // it recedes at the temples
    const float nape = 0.92f * (m.y + 62.f) - 0.38f * (m.z + 90.f);
    const float ear = length(m - Vec3f(80, -2, 3)) - 37.f;
    return smooth_union(smooth_union(front, nape, 14), ear, 16);  // the least of the three
}

}  // namespace

float hair(const Point3f& h) {
    const Point3f m = mirror_x(h);
    const float scalp = ellipsoid(m - Vec3f(0, 29, -19), {76, 88, 98});
    if (scalp > 70.f) return scalp - 20.f;  // 20 > the knot's and the locks' height

    const float growth = hairline(m);
    if (growth < -4.f) return 0.8f * (scalp + 4.6f);  // bare skin lies outside this

    // Polar coordinates about the axis from the face to the knot. Locks run along the meridians
    // from the face to the knot and swing from side to side on the way.
    const Vec3f r = m - Vec3f(0, 22, -16);
    const float across = std::atan2(r.x, r.y), along = std::atan2(std::hypot(r.x, r.y), r.z);
    const float swung = across + 0.16f * std::sin(6.5f * along);
    const float relief =
        (4.5f * rounded_wave(9.f * swung) + 0.9f * rounded_wave(27.f * swung)) * std::sin(along);
    const float height = mix(-10, 9, smoothstep(-4, 14, growth)) + relief;
    const float locks = 0.8f * (scalp - height);  // the relief is steeper than a distance may be

    const Vec3f k = h - Vec3f(0, 24, -120);
    const float coil = rounded_wave(0.14f * std::hypot(k.x, k.y) + 0.5f * std::atan2(k.x, k.y));
    const float knot = 0.8f * (ellipsoid(k, {38, 38, 30}) - 4.f * coil);
    return smooth_union(locks, knot, 5);
}

}  // namespace nacre::figure
