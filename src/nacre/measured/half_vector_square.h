#pragma once
// Half vectors on the unit square, as Dupuy and Jakob 2018 (rgl_brdf.h) lay them out: x = sqrt(2
// theta_h / pi), fine about the normal where highlights are, and y = phi_h / 2 pi + 1/2. In single
// precision; directions are unit vectors.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/vec.h"

namespace nacre {

/// Right near the normal as well, where z has no digits left.
inline float sin_theta_of(const Vec3f& w) { return std::sqrt(w.x * w.x + w.y * w.y); }

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
