#pragma once
// Model 20, physical optics of a rough surface: specular cone and directional diffuse reflection
// (He, Torrance, Sillion, Greenberg 1991; listed as Torrance and Greenberg 1991).
//
//   X. D. He, K. E. Torrance, F. X. Sillion, D. P. Greenberg 1991, A Comprehensive Physical Model
//   for Light Reflection, SIGGRAPH, eq. 65-84, unpolarised; R. Hall 1989 for the notation.
//   I_s  = I_ss + I_sd,   v = wi + wo,   k = 2 pi / lambda
//   I_ss = k_ss F exp(-g) S I_L       where the angle between V and R is at most gamma, else 0
//   I_sd = k_sd F G D S / (pi <N, V>) I_L
//   G = (v.v / v_z)^2
//   D = (pi tau / (2 lambda))^2 sum_{j>=1} g^j e^-g / (j! j) exp(-(k tau v_xy)^2 / (4 j))
//   g = (k sigma v_z)^2,   sigma^2 = sigma_0^2 / (1 + x^2),
//   x exp(x^2/2) = (K(wi) + K(wo)) / sqrt(8 pi),   K = tan(theta) erfc(tau cot(theta) / (2
//   sigma_0)) S: Smith's self-shadowing for m = 2 sigma_0 / tau (geometric_attenuation.h)
//
// F is that of a conductor of index n + i k (relative to air) at half the angle between L and V;
// G is the paper's ratio of polarisation vectors, which reduces to this. For the uniform diffuse
// part models 3 and 6 are added.
//
// Parameters: sigma0 > 0, standard deviation of heights, and tau > 0, correlation length, both in
// micrometres; n > 0 and k >= 0, which may vary with wavelength; kss, ksd, 0..1; gamma, 0..90
// degrees, half-angle of the specular cone (the papers' Dirac delta has no width). Wavelengths in
// nanometres, of the light. The directional diffuse part is a reciprocal BRDF over cos_i that
// conserves energy to 2e-4; the cone is not one of bounded albedo.
//
// Errata: the condition of the cone is printed as <V, R> <= gamma; it is the angle that must be at
// most gamma. See geometric_attenuation.h for S.
#include "nacre/illumination/geometric_attenuation.h"
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/poisson_sum.h"

namespace nacre::illumination {

inline const Description& he_torrance_description() {
    static const Description description{
        .number = 20,
        .name = "he_torrance",
        .aliases = {"20"},
        .title = "He-Torrance: specular cone and directional diffuse reflection",
        .authors = "X. D. He, K. E. Torrance, F. X. Sillion, D. P. Greenberg",
        .year = 1991,
        .source = "A Comprehensive Physical Model for Light Reflection, SIGGRAPH 91",
        .formula =
            "I_s = (k_ss F exp(-g) S [angle(V, R) <= gamma] + k_sd F G D S / (pi <N, V>)) I_L",
        .part = Part::specular,
        .parameters = {{.name = "sigma0",
                        .meaning = "standard deviation of the surface's heights",
                        .unit = "micrometres",
                        .high = infinite,
                        .above_low = true,
                        .otherwise = 0.18},
                       {.name = "tau",
                        .meaning = "correlation length of the heights",
                        .unit = "micrometres",
                        .high = infinite,
                        .above_low = true,
                        .otherwise = 3.},
                       refractive_index(),
                       {.name = "k",
                        .meaning = "index of absorption",
                        .kind = ParameterKind::spectrum,
                        .high = infinite},
                       {.name = "kss",
                        .meaning = "coefficient of the specular cone",
                        .kind = ParameterKind::spectrum,
                        .high = 1.,
                        .otherwise = 1.},
                       {.name = "ksd",
                        .meaning = "coefficient of directional diffuse reflection",
                        .kind = ParameterKind::spectrum,
                        .high = 1.,
                        .otherwise = 1.},
                       {.name = "gamma",
                        .meaning = "half-angle of the specular cone",
                        .unit = "degrees",
                        .high = 90.,
                        .otherwise = 3.}},
        .is_brdf = true,
        .properties =
            "directional diffuse part reciprocal, conserves energy to 2e-4; cone unbounded",
        .errata = "the condition of the cone is printed as <V, R> <= gamma"};
    return description;
}

template <class D, class P = D>
struct HeTorrance {
    static const Description& describe() { return he_torrance_description(); }

    D sigma0, tau;  ///< micrometres
    P n, k, kss, ksd;
    D gamma;  ///< degrees

    template <class R>
    static HeTorrance from(const R& r) {
        return {r.number(0),   r.number(1),   r.spectrum(2), r.spectrum(3),
                r.spectrum(4), r.spectrum(5), r.number(6)};
    }

    Product<D, P> intensity(const Lighting<D, P>& at) const {
        using std::cos, std::exp;
        const Vec3<D>&wi = at.wi, &wo = at.wo;
        const Vec3<D> v = wi + wo;
        const D vz = at_least(v.z, 1e-8), slope = D(2) * sigma0 / tau;
        const P wave_number = P(2. * std::numbers::pi * 1e3) / at.wavelength;

        const P f = fresnel_conductor(clamped(dot(wo, half_vector(wi, wo))), n, k);
        const D s =
            above(wi, wo) * self_shadowing_smith(wi, slope) * self_shadowing_smith(wo, slope);
        const P phase = wave_number * (effective_deviation(wi, wo) * vz), g = phase * phase;
        const D in_cone = select(mirror_cosine(wi, wo) >= cos(radians(gamma)), D(1), D(0));

        const P width = wave_number * tau, width2 = width * width;
        const P q = width2 * (D(0.25) * (v.x * v.x + v.y * v.y));
        const P d = width2 * P(1. / 16.) * poisson_sum(g, q);
        const D ratio = dot(v, v) / vz, facing = D(std::numbers::pi) * at_least(wo.z, 1e-8);

        const P specular = kss * exp(-g) * in_cone;
        const P directional = ksd * d * (ratio * ratio / facing);
        return f * at.light * (specular + directional) * s;
    }

    /// sigma, micrometres: the deviation of heights that both directions see.
    D effective_deviation(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::erfc, std::exp, std::log, std::sqrt;
        const auto hidden = [&](const Vec3<D>& w) {
            const D a = slope_ratio(w, D(D(2) * sigma0 / tau));
            return D(tau / (D(2) * sigma0) / a * erfc(a));
        };
        const D f = (hidden(wi) + hidden(wo)) / D(std::sqrt(8. * std::numbers::pi));
        // Newton's method on x exp(x^2/2) = f, which is convex: from above the root (f itself, or
        // where the exponential alone would do for f > 1) it comes down without overshooting.
        const D root = sqrt(D(2) * log(select(f > D(1), f, D(1))));
        D x = select(f > D(1), select(root > D(1), root, D(1)), f);
        for (int step = 0; step < 12; ++step) {
            const D e = exp(D(0.5) * x * x);
            x -= (x * e - f) / ((D(1) + x * x) * e);
        }
        return sigma0 / sqrt(D(1) + x * x);
    }
};

}  // namespace nacre::illumination
