#include "nacre/geometry/sdf.h"

#include <numbers>

namespace nacre::sdf {

CurvePoint bezier(const Point3f& p, const Point3f& a, const Point3f& b, const Point3f& c) {
    // B(t) = a + 2 t e + t^2 f; (B - p).B' = 0 is t^3 + 3 kx t^2 + .. in the monic form below.
    const Vec3f e = b - a, f = a - 2.f * b + c, d = a - p;
    const float scale = 1.f / dot(f, f);
    const float kx = scale * dot(e, f);
    const float ky = scale * (2.f * dot(e, e) + dot(d, f)) / 3.f;
    const float kz = scale * dot(d, e);
    const auto squared = [&](float t) { return length_squared(d + (2.f * e + f * t) * t); };

    const float q = ky - kx * kx, r = kx * (3.f * ky - 2.f * kx * kx) - kz;  // depressed: s^3+3qs-r
    const float discriminant = r * r + 4.f * q * q * q;
    if (discriminant >= 0.f) {  // one real root
        const float root = std::sqrt(discriminant);
        const float s = std::cbrt(0.5f * (r + root)) + std::cbrt(0.5f * (r - root));
        const float t = std::clamp(s - kx, 0.f, 1.f);
        return {std::sqrt(squared(t)), t};
    }
    // Three real roots; the middle one is a maximum of the distance.
    const float m = std::sqrt(-q);
    const float angle = std::acos(std::clamp(r / (-2.f * q * m), -1.f, 1.f)) / 3.f;
    const float cosine = std::cos(angle), sine = std::sin(angle) * std::numbers::sqrt3_v<float>;
    const float t0 = std::clamp(2.f * m * cosine - kx, 0.f, 1.f);
    const float t1 = std::clamp(-m * (cosine + sine) - kx, 0.f, 1.f);
    const float d0 = squared(t0), d1 = squared(t1);
    return d0 < d1 ? CurvePoint{std::sqrt(d0), t0} : CurvePoint{std::sqrt(d1), t1};
}

}  // namespace nacre::sdf
