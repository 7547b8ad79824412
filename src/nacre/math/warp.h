#pragma once
// Maps from the unit square to the domains that light is sampled on. Each keeps area ratios, and
// neighbouring points stay neighbours, so that stratification survives.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/vec.h"

namespace nacre {

/// Uniform point of the unit disk. Shirley and Chiu 1997, A Low Distortion Map Between Disk and
/// Square, Journal of Graphics Tools 2(3).
template <class T>
Vec2<T> square_to_disk(Vec2<T> u) {
    using std::cos, std::sin;
    const T x = T(2) * u.x - T(1), y = T(2) * u.y - T(1);
    if (x == T(0) && y == T(0)) return {};
    const bool wide = x * x > y * y;
    const T quarter = T(std::numbers::pi / 4);
    const T r = wide ? x : y;
    const T phi = wide ? quarter * (y / x) : T(std::numbers::pi / 2) - quarter * (x / y);
    return {r * cos(phi), r * sin(phi)};
}

/// Direction about +z with density cos(theta) / pi.
template <class T>
Vec3<T> square_to_cosine_hemisphere(Vec2<T> u) {
    using std::sqrt;
    const Vec2<T> p = square_to_disk(u);
    return {p.x, p.y, sqrt(std::max(T(0), T(1) - p.x * p.x - p.y * p.y))};
}

}  // namespace nacre
