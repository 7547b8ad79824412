#pragma once
// Cheap transcendental functions for inner loops: float accuracy (a few ulp), no special cases.
// The polynomials are weighted minimax fits (Lawson iteration) whose largest relative error is
// given with each.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "nacre/math/vec.h"

namespace nacre {

/// Natural logarithm of a positive normal number; relative error below 3e-7. Exponent plus a
/// polynomial for the mantissa brought into [sqrt(1/2), sqrt(2)).
inline float fast_log(float x) {
    constexpr std::uint32_t sqrt_half = 0x3f3504f3u;
    const std::uint32_t shifted = std::bit_cast<std::uint32_t>(x) - sqrt_half;
    const auto exponent = static_cast<std::int32_t>(shifted) >> 23;
    const float t = std::bit_cast<float>((shifted & 0x007fffffu) + sqrt_half) - 1.f;
    float p = 0.0872235522f;  // log(1+t)/t, 2.6e-8
    for (const float c : {-0.143668428f, 0.149522662f, -0.165623933f, 0.199568331f, -0.250020742f,
                          0.333341867f, -0.499999881f, 1.f})
        p = std::fma(p, t, c);
    return std::fma(t, p, static_cast<float>(exponent) * 0.693147181f);
}

/// (cos, sin) of 2 pi u for u in [0, 1]; absolute error below 2e-7. The angle is brought into the
/// eighth of a turn around the nearest quarter, and the quarter turn is undone by swapping and
/// changing signs.
inline Vec2f fast_unit_circle(float u) {
    const float quarter = std::nearbyint(4.f * u);
    const float r = u - 0.25f * quarter;
    const float r2 = r * r;
    // sin(2 pi r) / r, 3.3e-9, and cos(2 pi r), 6e-11.
    const float s =
        r * std::fma(std::fma(std::fma(-75.3935623f, r2, 81.5923538f), r2, -41.3416634f), r2,
                     6.28318548f);
    const float c =
        std::fma(std::fma(std::fma(std::fma(59.2028008f, r2, -85.4422989f), r2, 64.9393082f), r2,
                          -19.7392082f),
                 r2, 1.f);
    const auto turns = static_cast<std::int32_t>(quarter);
    const float x = turns & 1 ? s : c, y = turns & 1 ? c : s;
    return {(turns + 1) & 2 ? -x : x, turns & 2 ? -y : y};
}

/// Uniform direction on the sphere from two uniform numbers.
inline Vec3f fast_uniform_sphere(Vec2f u) {
    const float z = 1.f - 2.f * u.x;
    const float r = std::sqrt(std::max(0.f, 1.f - z * z));
    const Vec2f c = fast_unit_circle(u.y);
    return {r * c.x, r * c.y, z};
}

}  // namespace nacre
