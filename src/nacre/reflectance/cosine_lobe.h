#pragma once
// Powers of a cosine, the lobes of Phong, Blinn and Lafortune.
//
// The cosine of a narrow lobe is close to 1, where a rounding error e of it becomes the relative
// error n e of its n-th power. Written by the sine side (differences, tangents) the power keeps
// full precision, in single precision too.
#include "nacre/reflectance/model.h"

namespace nacre {

/// [a.b]+^n for unit vectors: 1 - a.b = |a - b|^2 / 2.
template <class D, class S>
Product<D, S> cosine_power(const Vec3<D>& a, const Vec3<D>& b, const S& n) {
    using std::exp, std::log1p;
    using T = Product<D, S>;
    const Vec3<D> d = a - b;
    const D versine = D(0.5) * dot(d, d);
    const D inside = select(versine < D(1), D(1), D(0));
    const D bounded = select(versine < D(1), versine, D(0));
    return T(inside) * exp(T(n * T(log1p(-bounded))));
}

/// cos^n of the angle between the sum of two directions and the normal: 1/cos^2 = 1 + tan^2.
template <class D, class S>
Product<D, S> half_cosine_power(const Vec3<D>& wi, const Vec3<D>& wo, const S& n) {
    using std::exp, std::log1p;
    using T = Product<D, S>;
    const Vec3<D> h = wi + wo;
    const D z2 = at_least(D(h.z * h.z), 1e-30);
    return exp(T(n * T(D(-0.5) * log1p((h.x * h.x + h.y * h.y) / z2))));
}

/// The constant that makes the albedo of half_cosine_power 1 at normal incidence, where it is
/// largest (F. Giesen 2009, Phong Normalization Factors).
template <class S>
S blinn_normalization(const S& n) {
    using std::exp;
    const S two_to = exp(S(n * S(-0.5 * std::numbers::ln2)));
    return (n + S(2.)) * (n + S(4.)) * S(0.125 * inv_pi) / (two_to + n);
}

/// Direction about the unit vector `axis` with density (n+1)/(2 pi) cos^n.
template <class D, class S>
Vec3<D> sample_cosine_power(const Vec3<D>& axis, S n, Vec2<D> u) {
    using std::cos, std::sin, std::sqrt, std::log, std::exp, std::expm1, std::abs, std::copysign;
    // cos = (1-u)^(1/(n+1)); 1 - cos^2 without cancellation.
    const D l = log(D(1) - u.x) / (n + D(1));
    const D c = exp(l), s = sqrt(-expm1(D(2) * l));
    const D phi = D(2 * std::numbers::pi) * u.y;
    // Frame about the axis: T. Duff et al. 2017, Building an Orthonormal Basis, Revisited, JCGT
    // 6(1).
    const D sign = copysign(D(1), axis.z);
    const D a = D(-1) / (sign + axis.z), b = axis.x * axis.y * a;
    const Vec3<D> x{D(1) + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
    const Vec3<D> y{b, sign + axis.y * axis.y * a, -axis.y};
    return x * (s * cos(phi)) + y * (s * sin(phi)) + axis * c;
}

}  // namespace nacre
