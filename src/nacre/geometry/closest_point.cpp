#include "nacre/geometry/closest_point.h"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

// Parameter in [0, 1] of the point of segment o + s e nearest to o + f.
double on_segment(const Vec3d& f, const Vec3d& e) {
    const double ee = dot(e, e);
    return ee > 0 ? std::clamp(dot(f, e) / ee, 0.0, 1.0) : 0.0;
}

}  // namespace

AnalyticHit closest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d ab = b - a, ac = c - a, ap = p - a, n = cross(ab, ac);
    const double nn = dot(n, n);
    if (nn > 0) {
        // The foot of the perpendicular, if it lies inside.
        const double v = dot(cross(ap, ac), n) / nn, w = dot(cross(ab, ap), n) / nn;
        if (v >= 0 && w >= 0 && v + w <= 1)
            return {std::abs(dot(ap, n)) / std::sqrt(nn), static_cast<float>(v),
                    static_cast<float>(w)};
    }
    // Otherwise the nearest point lies on one of the sides.
    const double s = on_segment(ap, ab), t = on_segment(ap, ac), r = on_segment(p - b, c - b);
    const double ds = length_squared(ap - ab * s), dt = length_squared(ap - ac * t);
    const double dr = length_squared(p - b - (c - b) * r);
    if (ds <= dt && ds <= dr) return {std::sqrt(ds), static_cast<float>(s), 0.f};
    if (dt <= dr) return {std::sqrt(dt), 0.f, static_cast<float>(t)};
    return {std::sqrt(dr), static_cast<float>(1 - r), static_cast<float>(r)};
}

}  // namespace nacre
