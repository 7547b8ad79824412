#pragma once
// Random directions and points beyond those of warp.h, and the densities of both: maps from the
// unit square, each continuous (so that stratified points stay stratified) and area preserving.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/math/vec.h"
#include "nacre/math/warp.h"

namespace nacre {

/// Density of square_to_disk over area, and of square_to_cosine_hemisphere over solid angle.
template <class T>
constexpr T disk_pdf() {
    return T(std::numbers::inv_pi);
}
template <class T>
T cosine_hemisphere_pdf(T cos_theta) {
    return std::max(T(0), cos_theta) * T(std::numbers::inv_pi);
}

/// Uniform direction within the cone cos(theta) >= cos_max about +z. u.x runs over the cosine
/// (Archimedes: equal heights, equal areas); 1 - cos is formed directly so that narrow cones keep
/// their digits.
template <class T>
Vec3<T> square_to_cone(Vec2<T> u, T cos_max) {
    using std::cos, std::sin, std::sqrt;
    const T drop = u.x * (T(1) - cos_max);  // 1 - cos(theta)
    const T s = sqrt(std::max(T(0), drop * (T(2) - drop)));
    const T phi = T(2 * std::numbers::pi) * u.y;
    return {s * cos(phi), s * sin(phi), T(1) - drop};
}
template <class T>
T cone_pdf(T cos_max) {
    return T(1) / (T(2 * std::numbers::pi) * (T(1) - cos_max));
}

/// Uniform direction on the sphere, and on the upper hemisphere.
template <class T>
Vec3<T> square_to_sphere(Vec2<T> u) {
    return square_to_cone(u, T(-1));
}
template <class T>
constexpr T sphere_pdf() {
    return T(0.25 * std::numbers::inv_pi);
}
template <class T>
Vec3<T> square_to_hemisphere(Vec2<T> u) {
    return square_to_cone(u, T(0));
}
template <class T>
constexpr T hemisphere_pdf() {
    return T(0.5 * std::numbers::inv_pi);
}

/// Barycentric coordinates (of the second and third corner) of a uniform point of a triangle,
/// density 1 / area. Heitz 2019, A Low-Distortion Map Between Triangle and Square.
template <class T>
Vec2<T> square_to_triangle(Vec2<T> u) {
    const bool upper = u.y > u.x;
    const T a = upper ? T(0.5) * u.x : u.x - T(0.5) * u.y;
    const T b = upper ? u.y - T(0.5) * u.x : T(0.5) * u.y;
    return {a, b};
}

}  // namespace nacre
