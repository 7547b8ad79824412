// What carries the head of the built-in sculpture.
#include "nacre/geometry/figure_parts.h"
#include "nacre/geometry/sdf.h"

namespace nacre::figure {
using namespace sdf;

namespace {

// A robe over shoulders and breast: the body thickened below a hanging neckline, with folds that
// hang as the neckline does.
float robe(float body, const Point3f& p) {
    const float hang = p.y - 0.0040f * square(p.x);  // constant along a fold
    const float cloth = smoothstep(86, 82, hang);
    if (cloth == 0.f) return body;
    const float fold = rounded_wave(0.21f * hang + 0.5f * std::sin(0.035f * p.x));
    const float roll = brush({hang, 0, 0}, {81, 0, 0}, {3.5f, 1, 1});  // the hem
    return 0.9f * (body - cloth * (2.2f + 4.2f * fold * smoothstep(82, 64, hang) + 1.6f * roll));
}

}  // namespace

float torso(const Point3f& p) {
    if (p.y > 300.f) return p.y - 278.f;  // above the neck, further off than any joint is wide

    // Mirrored with a rounded edge, so that no crease runs down the breastbone.
    const Point3f m{std::hypot(p.x, 12.f), p.y, p.z};
    float d = round_cone(p, {0, 235, -24}, {0, 95, -40}, 42, 50);  // neck

    // The muscles from behind the ears to the breastbone follow the turn of the head.
    static const Point3f left = from_head({42, -52, -24}), right = from_head({-42, -52, -24});
    const float muscles = std::min(round_cone(p, left, {8, 108, 16}, 9, 6),
                                   round_cone(p, right, {-8, 108, 16}, 9, 6));
    d = smooth_union(d, muscles, 14);

    float chest = ellipsoid(p - Vec3f(0, 40, -34), {128, 78, 70});
    const float shoulder = round_cone(m, {30, 148, -58}, {130, 70, -42}, 20, 38);
    const float collarbone = bezier_tube(m, {9, 104, 24}, {56, 110, 26}, {120, 106, -24}, 4, 3, 5);
    const float breast = ellipsoid(m - Vec3f(46, 62, -4), {64, 50, 40});
    chest = smooth_union(chest, shoulder, 36);
    chest = smooth_union(chest, collarbone, 18);
    chest = smooth_union(chest, breast, 30);
    d = smooth_union(d, chest, 34);
    d += 4.f * brush(p, {0, 110, 22}, {8, 10, 14});  // hollow of the throat

    d = robe(d, p);

    // The cut, round below and flat at the arms: an upright cylinder that ends in half an egg.
    const Point3f cut{p.x, std::min(p.y - 132.f, 0.f), p.z + 30.f};
    return smooth_intersection(d, ellipsoid(cut, {128, 102, 110}), 5);
}

float base(const Point3f& p) {
    const float plate = rounded_cylinder(p - Vec3f(0, 9, 0), 62, 9, 3);
    const float stem = rounded_cylinder(p - Vec3f(0, 34, -8), 28, 34, 3);
    // The joint's filling must not reach below the ground.
    return smooth_intersection(smooth_union(plate, stem, 16), -p.y, 2);
}

float collar(const Point3f& p) {
    if (p.y > 240.f) return p.y - 220.f;

    const float behind = -38.f - p.z;  // the axis stands at z = -38, the neck's
    const float radius = std::hypot(p.x, behind), angle = std::atan2(std::abs(p.x), behind);
    const float rise = p.y - 100.f;
    const float pleat = 4.5f * smoothstep(0, 90, rise) * std::cos(15.f * angle);
    // A trumpet, with its top edge falling from the nape to the shoulders in front.
    const float trumpet = 60.f + 0.36f * rise + 0.0018f * rise * std::abs(rise) + pleat;
    const float sheet = 0.75f * (radius - trumpet);
    const float top = mix(212, 90, smoothstep(0.4f, 2.3f, angle)) + 0.5f * pleat;
    const float hem = std::max(0.85f * (p.y - top), 60.f - p.y);
    const float thin = std::hypot(std::max(hem, 0.f), sheet) - 1.1f;
    return smooth_union(thin, std::hypot(hem + 1.5f, sheet) - 1.9f, 2);
}

}  // namespace nacre::figure
