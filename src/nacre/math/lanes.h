#pragma once
// Packs of numbers that are computed on together ("lanes"). nacre's models are written once over a
// number type and run on float, double, Lanes<float, 4> (a path's four wavelengths), Lanes<float,
// 16> or Lanes<float, 8> (bulk evaluation over directions) and dual numbers. Values are never
// branched on: `select` chooses a lane at a time.
//
// Built on the compiler's vector extension, so arithmetic needs no header of its own; exp, log,
// pow, sin and cos of packs are in lanes_math.h.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace nacre {

template <class T, int N>
struct Mask;

/// N numbers of type T (float or double), N a power of two.
template <class T, int N>
struct Lanes {
    using value_type = T;
    static constexpr int size = N;
    typedef T Native __attribute__((vector_size(sizeof(T) * N)));
    Native v;

    Lanes() : v(Native{} + T(0)) {}
    Lanes(T s) : v(Native{} + s) {}  // NOLINT: a number stands for N equal ones
    template <class U>
    requires(std::is_arithmetic_v<U> && !std::is_same_v<U, T>) Lanes(U s)
        : Lanes(T(s)) {}  // NOLINT
    template <class... U>
    requires(sizeof...(U) == N && N > 1) Lanes(U... values) : v{T(values)...} {}

    static Lanes from(Native n) {
        Lanes r;
        r.v = n;
        return r;
    }
    static Lanes load(const T* p) {
        Lanes r;
        __builtin_memcpy(&r.v, p, sizeof r.v);
        return r;
    }
    void store(T* p) const { __builtin_memcpy(p, &v, sizeof v); }

    T operator[](int i) const { return v[i]; }
    void set(int i, T value) { v[i] = value; }

    friend Lanes operator+(Lanes a, Lanes b) { return from(a.v + b.v); }
    friend Lanes operator-(Lanes a, Lanes b) { return from(a.v - b.v); }
    friend Lanes operator*(Lanes a, Lanes b) { return from(a.v * b.v); }
    friend Lanes operator/(Lanes a, Lanes b) { return from(a.v / b.v); }
    friend Lanes operator-(Lanes a) { return from(-a.v); }
    Lanes& operator+=(Lanes b) { return *this = *this + b; }
    Lanes& operator-=(Lanes b) { return *this = *this - b; }
    Lanes& operator*=(Lanes b) { return *this = *this * b; }
    Lanes& operator/=(Lanes b) { return *this = *this / b; }

    friend Mask<T, N> operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
    friend Mask<T, N> operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
    friend Mask<T, N> operator<=(Lanes a, Lanes b) { return {a.v <= b.v}; }
    friend Mask<T, N> operator>=(Lanes a, Lanes b) { return {a.v >= b.v}; }
    friend Mask<T, N> operator==(Lanes a, Lanes b) { return {a.v == b.v}; }
    friend Mask<T, N> operator!=(Lanes a, Lanes b) { return {a.v != b.v}; }
};

/// The outcome of a comparison, a lane at a time.
template <class T, int N>
struct Mask {
    using Int = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    typedef Int Native __attribute__((vector_size(sizeof(T) * N)));
    Native v;

    bool operator[](int i) const { return v[i] != 0; }
    friend Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
    friend Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
    friend Mask operator!(Mask a) { return {~a.v}; }
};

template <class T, int N>
bool any(Mask<T, N> m) {
    for (int i = 0; i < N; ++i)
        if (m[i]) return true;
    return false;
}
template <class T, int N>
bool all(Mask<T, N> m) {
    return !any(!m);
}
template <class T, int N>
Lanes<T, N> select(Mask<T, N> m, Lanes<T, N> yes, Lanes<T, N> no) {
    return Lanes<T, N>::from(m.v ? yes.v : no.v);
}
/// The same spelling for plain numbers, so that one source serves both.
template <class T>
requires(!std::is_class_v<T> || !requires { T::size; }) T select(bool m, T yes, T no) {
    return m ? yes : no;
}
inline bool any(bool m) { return m; }
inline bool all(bool m) { return m; }

template <class T, int N>
Lanes<T, N> min(Lanes<T, N> a, Lanes<T, N> b) {
    return select(a < b, a, b);
}
template <class T, int N>
Lanes<T, N> max(Lanes<T, N> a, Lanes<T, N> b) {
    return select(a > b, a, b);
}
template <class T, int N>
Lanes<T, N> abs(Lanes<T, N> a) {
    return max(a, -a);
}
template <class T, int N>
Lanes<T, N> sqrt(Lanes<T, N> a) {
    Lanes<T, N> r;
    for (int i = 0; i < N; ++i) r.v[i] = std::sqrt(a.v[i]);
    return r;
}
/// Sum, largest and smallest of the lanes.
template <class T, int N>
T sum(Lanes<T, N> a) {
    T r = a[0];
    for (int i = 1; i < N; ++i) r += a[i];
    return r;
}
template <class T, int N>
T max_lane(Lanes<T, N> a) {
    T r = a[0];
    for (int i = 1; i < N; ++i) r = std::max(r, a[i]);
    return r;
}
template <class T, int N>
T min_lane(Lanes<T, N> a) {
    T r = a[0];
    for (int i = 1; i < N; ++i) r = std::min(r, a[i]);
    return r;
}

/// A quantity at the four wavelengths that a path carries (in RGB-band mode: red, green, blue and
/// an unused lane).
using Spectral = Lanes<float, 4>;

}  // namespace nacre
