#pragma once
// Signed distance: shapes and the operations that join them. Negative inside, positive outside,
// lengths in whatever unit the caller works in (the built-in figure: mm).
//
// "Exact" shapes return the Euclidean distance; "bound" shapes keep the zero set and the sign, and
// their gradient is of order one but not one. Joins keep a 1-Lipschitz bound 1-Lipschitz. The
// derivations are the classical ones: J. C. Hart, "Sphere Tracing" (1996), and I. Quilez,
// "Distance functions" (iquilezles.org), whose formulas for the round cone, the quadratic Bezier
// curve, the ellipsoid bound and the polynomial smooth minimum are used here.
#include <algorithm>
#include <cmath>

#include "nacre/math/vec.h"

namespace nacre::sdf {

inline float square(float x) { return x * x; }
/// 0 below `a`, 1 above `b`, the cubic with zero end slopes between them.
inline float smoothstep(float a, float b, float x) {
    const float t = std::clamp((x - a) / (b - a), 0.f, 1.f);
    return t * t * (3.f - 2.f * t);
}
inline float mix(float a, float b, float t) { return a + (b - a) * t; }

// --- Shapes
// ---------------------------------------------------------------------------------------

/// Ball of radius `r` about the origin. Exact.
inline float sphere(const Point3f& p, float r) { return length(p) - r; }

/// Ellipsoid with semi-axes `r` about the origin: first-order bound |q|(|q|-1)/|grad|, good near
/// the surface and never of the wrong sign.
inline float ellipsoid(const Point3f& p, const Vec3f& r) {
    const Vec3f q{p.x / r.x, p.y / r.y, p.z / r.z};
    const Vec3f g{q.x / r.x, q.y / r.y, q.z / r.z};
    const float k0 = length(q), k1 = length(g);
    const float smallest = std::min({r.x, r.y, r.z});
    return k1 < 1e-6f ? -smallest : k0 * (k0 - 1.f) / k1;
}

/// All points within `r` of the segment ab. Exact.
inline float capsule(const Point3f& p, const Point3f& a, const Point3f& b, float r) {
    const Vec3f pa = p - a, ba = b - a;
    const float t = std::clamp(dot(pa, ba) / dot(ba, ba), 0.f, 1.f);
    return length(pa - ba * t) - r;
}

/// Convex hull of the ball (a, ra) and the ball (b, rb), |ab| > |ra - rb|. Exact.
inline float round_cone(const Point3f& p, const Point3f& a, const Point3f& b, float ra, float rb) {
    const Vec3f ba = b - a, pa = p - a;
    const float l2 = dot(ba, ba), dr = ra - rb, slant2 = l2 - dr * dr;
    const float along = dot(pa, ba);  // l times the coordinate on the axis
    const Vec3f radial = pa * l2 - ba * along;
    const float x2 = dot(radial, radial);
    const float behind = along * along * l2, ahead = square(along - l2) * l2;
    const float k = std::copysign(1.f, dr) * dr * dr * x2;
    const float beyond = along - l2;
    if (std::copysign(1.f, beyond) * slant2 * ahead > k) return length(p - b) - rb;
    if (std::copysign(1.f, along) * slant2 * behind < k) return length(pa) - ra;
    return (std::sqrt(x2 * slant2 / l2) + along * dr) / l2 - ra;
}

/// Ring about the y axis: circle of radius `major` in the xz plane, thickened by `minor`. Exact.
inline float torus(const Point3f& p, float major, float minor) {
    return std::hypot(std::hypot(p.x, p.z) - major, p.y) - minor;
}

/// Box with half sides `half`, its edges rounded by `r` (the rounded box still fits in `half`).
/// Exact.
inline float rounded_box(const Point3f& p, const Vec3f& half, float r) {
    const Vec3f q{std::abs(p.x) - half.x + r, std::abs(p.y) - half.y + r,
                  std::abs(p.z) - half.z + r};
    const Vec3f out{std::max(q.x, 0.f), std::max(q.y, 0.f), std::max(q.z, 0.f)};
    return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.f) - r;
}

/// Upright cylinder about the y axis, |y| <= half_height, its rims rounded by `r`. Exact.
inline float rounded_cylinder(const Point3f& p, float radius, float half_height, float r) {
    const float dx = std::hypot(p.x, p.z) - radius + r, dy = std::abs(p.y) - half_height + r;
    return std::hypot(std::max(dx, 0.f), std::max(dy, 0.f)) + std::min(std::max(dx, dy), 0.f) - r;
}

/// Nearest point of a curve: its distance and its parameter in [0, 1].
struct CurvePoint {
    float distance, t;
};

/// Quadratic Bezier curve with control points a, b, c, not on one line. Exact: the stationary
/// points of the squared distance are the roots of a cubic (Cardano).
CurvePoint bezier(const Point3f& p, const Point3f& a, const Point3f& b, const Point3f& c);

/// The curve thickened by a radius that goes from `ra` over `rb` (middle) to `rc`, quadratically.
/// Bound.
inline float bezier_tube(const Point3f& p, const Point3f& a, const Point3f& b, const Point3f& c,
                         float ra, float rb, float rc) {
    const auto [d, t] = bezier(p, a, b, c);
    const float s = 1.f - t;
    return d - (ra * s * (s - t) + 4.f * rb * s * t + rc * t * (t - s));
}

// --- Joins
// ----------------------------------------------------------------------------------------

/// Union whose seam is filled over a band of width `k` (the difference of the distances at which
/// the filling ends), with two continuous derivatives; it adds at most k/6.
inline float smooth_union(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.f) / k;
    return std::min(a, b) - h * h * h * k * (1.f / 6.f);
}
inline float smooth_intersection(float a, float b, float k) { return -smooth_union(-a, -b, k); }
/// `a` without `b`.
inline float smooth_subtraction(float a, float b, float k) { return -smooth_union(-a, b, k); }

/// A modeller's brush: exp(-|(p - center) / radii|^2), in (0, 1]. Subtract `amount * brush(..)`
/// from a distance to raise the surface by about `amount` there, add it to press it in. The slope
/// it adds is at most 0.86 amount / smallest radius.
inline float brush(const Point3f& p, const Point3f& center, const Vec3f& radii) {
    const Vec3f q{(p.x - center.x) / radii.x, (p.y - center.y) / radii.y,
                  (p.z - center.z) / radii.z};
    const float e = dot(q, q);
    return e > 12.f ? 0.f : std::exp(-e);  // e^-12 of a millimetre is below a float's last place
}

/// |sin(phase)| with its cusps rounded so that a mesh can follow them: 0.17 in the grooves, 1 on
/// the backs.
inline float rounded_wave(float phase) {
    return std::sqrt(0.97f * square(std::sin(phase)) + 0.03f);
}

// --- Frames
// ---------------------------------------------------------------------------------------

/// Position in the plane turned by the angle whose sine and cosine are given.
struct Turn {
    float c = 1.f, s = 0.f;
    static Turn degrees(float angle) {
        const float radians = angle * 0.017453292519943295f;
        return {std::cos(radians), std::sin(radians)};
    }
};
inline Point3f turn_x(const Point3f& p, Turn t) {
    return {p.x, t.c * p.y - t.s * p.z, t.s * p.y + t.c * p.z};
}
inline Point3f turn_y(const Point3f& p, Turn t) {
    return {t.c * p.x + t.s * p.z, p.y, t.c * p.z - t.s * p.x};
}
inline Point3f turn_z(const Point3f& p, Turn t) {
    return {t.c * p.x - t.s * p.y, t.s * p.x + t.c * p.y, p.z};
}
/// The mirror image with x >= 0: what is modelled on the right appears on the left as well.
inline Point3f mirror_x(const Point3f& p) { return {std::abs(p.x), p.y, p.z}; }

}  // namespace nacre::sdf
