#pragma once
// Vectors of two and three components over any number type T: float for rendering, double for
// reference values, a pack of lanes for bulk evaluation, a dual number for derivatives. Nothing
// here branches on a value.
#include <cmath>
#include <cstddef>

namespace nacre {

template <class T>
struct Vec2 {
    T x{}, y{};
    friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr Vec2 operator*(Vec2 a, T s) { return {a.x * s, a.y * s}; }
    friend constexpr Vec2 operator*(T s, Vec2 a) { return a * s; }
    friend constexpr bool operator==(Vec2 a, Vec2 b) = default;
};

template <class T>
struct Vec3 {
    T x{}, y{}, z{};

    constexpr Vec3() = default;
    constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    template <class U>
    explicit constexpr Vec3(const Vec3<U>& v) : x(T(v.x)), y(T(v.y)), z(T(v.z)) {}

    constexpr T& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
    constexpr const T& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }

    friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend constexpr Vec3 operator*(const Vec3& a, const Vec3& b) {
        return {a.x * b.x, a.y * b.y, a.z * b.z};
    }
    friend constexpr Vec3 operator*(const Vec3& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Vec3 operator*(T s, const Vec3& a) { return a * s; }
    friend constexpr Vec3 operator/(const Vec3& a, T s) { return a * (T(1) / s); }
    friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
    constexpr Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
    constexpr Vec3& operator-=(const Vec3& b) { return *this = *this - b; }
    constexpr Vec3& operator*=(T s) { return *this = *this * s; }
    friend constexpr bool operator==(const Vec3& a, const Vec3& b) = default;
};

using Vec2f = Vec2<float>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
/// A point in space. The same type as a vector; the name tells the reader which is meant.
using Point3f = Vec3f;

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
constexpr T length_squared(const Vec3<T>& a) {
    return dot(a, a);
}
template <class T>
T length(const Vec3<T>& a) {
    using std::sqrt;
    return sqrt(dot(a, a));
}
/// Unit vector along `a`, which must not be zero.
template <class T>
Vec3<T> normalize(const Vec3<T>& a) {
    return a * (T(1) / length(a));
}
/// `w` mirrored about the unit vector `n`; both point away from the surface.
template <class T>
constexpr Vec3<T> reflect(const Vec3<T>& w, const Vec3<T>& n) {
    return n * (T(2) * dot(w, n)) - w;
}

}  // namespace nacre
