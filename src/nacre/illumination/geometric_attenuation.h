#pragma once
// G_att and S_att: the share of facets that others neither shadow from the light nor mask from the
// viewer.
#include "nacre/illumination/lighting.h"
#include "nacre/reflectance/microfacet.h"

namespace nacre::illumination {

/// G of the V-shaped grooves of K. Torrance, E. Sparrow 1967, Theory for Off-Specular Reflection
/// from Roughened Surfaces, JOSA 57(9), in the form of Blinn 1977:
///   min(1, 2 (n.h) (n.v) / (v.h), 2 (n.h) (n.l) / (v.h)).
template <class D>
D geometric_torrance_sparrow(const Vec3<D>& wi, const Vec3<D>& wo, const Vec3<D>& h) {
    const D s = D(2) * h.z / at_least(dot(wo, h), 1e-12);
    const D a = s * clamped(wi.z), b = s * clamped(wo.z);
    const D less = select(a < b, a, b);
    return select(less < D(1), less, D(1));
}

/// cot(theta) / m, bounded where it no longer matters.
template <class D>
D slope_ratio(const Vec3<D>& w, D m) {
    using std::sqrt;
    const D a = w.z / (m * sqrt(at_least(D(w.x * w.x + w.y * w.y), 1e-30)));
    return select(a < D(1e-12), D(1e-12), select(a > D(1e4), D(1e4), a));
}

/// G of P. V. Sancer 1969, Shadow-Corrected Electromagnetic Scattering from a Randomly Rough
/// Surface, IEEE TAP 17: 1 / (1 + Lambda_i + Lambda_o), today known as Smith's height-correlated
/// form, with Lambda = exp(-a^2) / (2 a sqrt(pi)) - erfc(a) / 2 and a = cot(theta) / m.
template <class D>
D geometric_sancer(const Vec3<D>& wi, const Vec3<D>& wo, D m) {
    const auto lambda = [&](const Vec3<D>& w) { return smith_beckmann_lambda(slope_ratio(w, m)); };
    return D(1) / (D(1) + lambda(wi) + lambda(wo));
}

/// S_att of B. G. Smith 1967, Geometrical Shadowing of a Random Rough Surface, IEEE TAP 15, for one
/// direction: (1 - erfc(a) / 2) / (1 + Lambda(a)), a = cot(theta) / m; of both, the product.
/// Errata: He et al. 1991 print Lambda without the factor exp(-a^2), and secondary literature makes
/// "Smith and Bruce" of Bruce G. Smith.
template <class D>
D self_shadowing_smith(const Vec3<D>& w, D m) {
    using std::erfc;
    const D a = slope_ratio(w, m);
    return (D(1) - D(0.5) * erfc(a)) / (D(1) + smith_beckmann_lambda(a));
}

}  // namespace nacre::illumination
