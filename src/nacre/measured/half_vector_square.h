#pragma once
// Half vectors on the unit square, as Dupuy and Jakob 2018 (rgl_brdf.h) lay them out: x = sqrt(2
// theta_h / pi), fine about the normal where highlights are, and y = phi_h / 2 pi + 1/2. In single
// precision; directions are unit vectors.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "nacre/math/fast.h"
#include "nacre/math/fast_atan2.h"
#include "nacre/math/vec.h"

namespace nacre {

/// Right near the normal as well, where z has no digits left.
inline float sin_theta_of(const Vec3f& w) { return std::sqrt(w.x * w.x + w.y * w.y); }

struct Polar {
    float theta, phi;  ///< radians; phi in [-pi, pi]
};
/// Of two unit vectors at once.
inline std::array<Polar, 2> polar_of(const Vec3f& a, const Vec3f& b) {
    const Lanes<float, 4> angles =
        fast_atan2(Lanes<float, 4>(sin_theta_of(a), a.y, sin_theta_of(b), b.y),
                   Lanes<float, 4>(a.z, a.x, b.z, b.x));
    return {Polar{angles[0], angles[1]}, Polar{angles[2], angles[3]}};
}

/// The half vector at (x, y) of the square that is turned by `phi`.
inline Vec3f square_vector(float x, float y, float phi) {
    const Vec2f polar = fast_unit_circle(0.25f * x * x);
    const float turns = y + 0.5f + phi * (0.5f * std::numbers::inv_pi_v<float>);
    const Vec2f around = fast_unit_circle(turns - std::floor(turns));
    return {polar.y * around.x, polar.y * around.y, polar.x};
}

inline float square_x(float theta) { return std::sqrt(theta * (2.f / std::numbers::pi_v<float>)); }
/// Of any azimuth, in [0, 1).
inline float square_y(float phi) {
    constexpr float pi = std::numbers::pi_v<float>;
    const float turns = (phi + pi) / (2.f * pi);
    return turns - std::floor(turns);
}

/// The solid angle of the direction that w becomes by reflection at half vectors of a piece of the
/// square, over its area: 4 (w h) dh. Not 0 at x = 0, so that densities stay finite.
inline float reflected_solid_angle(float x, float sin_theta_h, float w_h) {
    constexpr float pi = std::numbers::pi_v<float>;
    return std::max(2.f * pi * pi * x * sin_theta_h, 1e-6f) * 4.f * w_h;
}

}  // namespace nacre
