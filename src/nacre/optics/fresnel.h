#pragma once
// Reflection and refraction at one smooth interface: Fresnel's equations and Snell's law.
//
// Conventions. cos_i in [0, 1] is the cosine between the normal and the direction on the side that
// the light comes from. `eta` is the relative index n_t / n_i, the far side over the near one:
// light that enters glass has eta 1.5, light that leaves it 1 / 1.5. Reflectances are shares of
// power; amplitudes are named so. Everything is a template over its number types (direction and
// index may differ: one direction, four wavelengths) and branches on no value.
#include <cmath>
#include <type_traits>

#include "nacre/math/lanes.h"
#include "nacre/math/vec.h"

namespace nacre {

namespace fresnel_detail {

/// Square root, 0 (with derivative 0) for arguments that are not positive.
template <class T>
T clamped_sqrt(T x) {
    using std::sqrt;
    const auto positive = x > T(0);
    return select(positive, sqrt(select(positive, x, T(1))), T(0));
}

// Keeps 0/0 at grazing incidence between equal media at 0; far below any cosine that matters.
inline constexpr double tiny = 1e-30;

}  // namespace fresnel_detail

/// A quantity for light polarised perpendicular (s) and parallel (p) to the plane of incidence.
template <class T>
struct Polarised {
    T s, p;
    /// Natural light: both halves alike.
    T mean() const { return T(0.5) * (s + p); }
};

/// Cosine on the far side by Snell's law; 0 under total reflection.
template <class C, class E>
auto refracted_cosine(C cos_i, E eta) {
    using T = std::decay_t<decltype(cos_i * eta)>;
    const T c = cos_i, e = eta;
    return T(fresnel_detail::clamped_sqrt(T(e * e - (T(1) - c * c))) / e);
}

/// Amplitude reflection coefficients of a dielectric,
///   r_s = (c - g) / (c + g),   r_p = (eta^2 c - g) / (eta^2 c + g),   g^2 = eta^2 - 1 + c^2
/// (g = eta cos_t). Under total reflection, where they are complex of modulus 1, both are 1.
template <class C, class E>
auto fresnel_amplitudes(C cos_i, E eta) {
    using T = std::decay_t<decltype(cos_i * eta)>;
    const T c = cos_i, e2 = T(eta) * T(eta), g2 = e2 - (T(1) - c * c);
    const T g = fresnel_detail::clamped_sqrt(g2), tiny(fresnel_detail::tiny);
    const auto total = g2 < T(0);
    return Polarised<T>{select(total, T(1), T((c - g) / (c + g + tiny))),
                        select(total, T(1), T((e2 * c - g) / (e2 * c + g + tiny)))};
}

/// Reflectance of a dielectric for each polarisation; 1 under total reflection.
template <class C, class E>
auto fresnel_dielectric_polarised(C cos_i, E eta) {
    const auto r = fresnel_amplitudes(cos_i, eta);
    return std::decay_t<decltype(r)>{r.s * r.s, r.p * r.p};
}

/// Reflectance of a dielectric for natural light.
template <class C, class E>
auto fresnel_dielectric(C cos_i, E eta) {
    return fresnel_dielectric_polarised(cos_i, eta).mean();
}

/// Reflectance of a conductor of relative index n + i k, k >= 0, for each polarisation. With
/// eps = (n + i k)^2 and sqrt(eps - sin^2) = a + i b,
///   R_s = |c - (a + i b)|^2 / |c + (a + i b)|^2,   R_p = |eps c - (a + i b)|^2 / |eps c + ...|^2.
/// a and b follow from a^2 - b^2 = n^2 - k^2 - sin^2 and a b = n k: the larger by its square, the
/// other by division, so that neither loses digits. With k = 0 this is the dielectric.
template <class C, class N>
auto fresnel_conductor_polarised(C cos_i, N n_, N k_) {
    using std::sqrt;
    using T = std::decay_t<decltype(cos_i * n_)>;
    const T c = cos_i, n = n_, k = k_, tiny(fresnel_detail::tiny);
    const T nk = n * k, u = n * n - k * k, q = u - (T(1) - c * c);
    const T magnitude = fresnel_detail::clamped_sqrt(T(q * q + T(4) * nk * nk));
    const auto positive = q > T(0);
    const T larger =
        fresnel_detail::clamped_sqrt(T(T(0.5) * (magnitude + select(positive, q, T(-q)))));
    const T smaller = nk / (larger + tiny);
    const T a = select(positive, larger, smaller), b = select(positive, smaller, larger);
    const auto ratio = [&](T re, T im, T a_, T b_) {
        const T minus = (re - a_) * (re - a_) + (im - b_) * (im - b_);
        const T plus = (re + a_) * (re + a_) + (im + b_) * (im + b_);
        return T(minus / (plus + tiny));
    };
    return Polarised<T>{ratio(c, T(0), a, b), ratio(T(u * c), T(T(2) * nk * c), a, b)};
}

/// Reflectance of a conductor for natural light.
template <class C, class N>
auto fresnel_conductor(C cos_i, N n, N k) {
    return fresnel_conductor_polarised(cos_i, n, k).mean();
}

/// Schlick 1994: F0 + (1 - F0) (1 - cos)^5. Off by up to 0.06 of the dielectric of index 1.33 and
/// 0.18 of iron, near 84 degrees.
template <class C, class F>
auto fresnel_schlick(C cos_i, F f0) {
    using T = std::decay_t<decltype(cos_i * f0)>;
    const T m = T(1) - T(cos_i), m2 = m * m, r0 = f0;
    return T(r0 + (T(1) - r0) * (m2 * m2 * m));
}

/// Reflectance at normal incidence of relative index eta, and the index > 1 of a reflectance in
/// [0, 1).
template <class T>
T normal_reflectance(T eta) {
    const T r = (eta - T(1)) / (eta + T(1));
    return r * r;
}
template <class T>
T index_of_normal_reflectance(T f0) {
    const T r = fresnel_detail::clamped_sqrt(f0);
    return (T(1) + r) / (T(1) - r);
}

/// Refracted direction of `w`, which points away from the surface on the side of the unit normal n
/// (dot(w, n) >= 0); the result points away from the surface on the far side. The zero vector under
/// total reflection.
template <class T>
Vec3<T> refract(const Vec3<T>& w, const Vec3<T>& n, T eta) {
    const T c = dot(w, n), g2 = eta * eta - (T(1) - c * c);
    const T cos_t = fresnel_detail::clamped_sqrt(g2) / eta;
    const Vec3<T> t = n * (c / eta - cos_t) - w * (T(1) / eta);
    const auto passes = g2 > T(0);
    return {select(passes, t.x, T(0)), select(passes, t.y, T(0)), select(passes, t.z, T(0))};
}

}  // namespace nacre
