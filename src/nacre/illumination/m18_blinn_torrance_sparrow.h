#pragma once
// Model 18, Torrance and Sparrow's facets for computer graphics (Blinn 1977).
//
//   J. F. Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH.
//   K. E. Torrance, E. M. Sparrow 1967, Theory for Off-Specular Reflection from Roughened Surfaces,
//   JOSA 57(9).
//   I_s = k_s D G F / <N, V> I_L
//
// D: one of three distributions with peak 1 (distribution_attenuation.h), all of them one half at
// the angle beta from the normal; G: of V-shaped grooves (geometric_attenuation.h); F: of a
// dielectric at the facet.
//
// Parameters: distribution (phong, torrance_sparrow, trowbridge_reitz); beta in (0, 90) degrees; n
// > 0; ks, 0..1. A BRDF: f = k_s D G F / (cos_i cos_o), reciprocal, not normalised: it conserves
// energy for k_s <= 1 / (4 N), where N, the integral of D cos over the hemisphere, is 2 pi / (Ns +
// 2) for Phong's and pi C2^2 for Trowbridge and Reitz's distribution.
//
// Errata: see distribution_attenuation.h.
#include "nacre/illumination/distribution_attenuation.h"
#include "nacre/illumination/geometric_attenuation.h"
#include "nacre/optics/fresnel.h"

namespace nacre::illumination {

inline const Description& blinn_torrance_sparrow_description() {
    static const Description description{
        .number = 18,
        .name = "blinn_torrance_sparrow",
        .aliases = {"18"},
        .title = "Blinn's facets after Torrance and Sparrow",
        .authors = "J. F. Blinn",
        .year = 1977,
        .source = "Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 77",
        .formula = "I_s = k_s D G F / <N, V> I_L",
        .part = Part::specular,
        .parameters = {choice_parameter("distribution", "of the facets",
                                        {{"phong", "a power of the cosine"},
                                         {"torrance_sparrow", "a Gaussian of the angle"},
                                         {"trowbridge_reitz", "of ellipsoids"}}),
                       {.name = "beta",
                        .meaning = "angle at which D is one half",
                        .unit = "degrees",
                        .high = 90.,
                        .above_low = true,
                        .below_high = true,
                        .otherwise = 15.},
                       refractive_index(),
                       specular_coefficient()},
        .is_brdf = true,
        .properties = "reciprocal; conserves energy for k_s <= 1 / (4 integral of D cos)",
        .errata = "Trowbridge and Reitz's distribution is printed without its outer square",
    };
    return description;
}

template <class D, class P = D>
struct BlinnTorranceSparrow {
    static const Description& describe() { return blinn_torrance_sparrow_description(); }

    int distribution;  ///< position of the choice
    D beta;            ///< degrees
    P n, ks;

    template <class R>
    static BlinnTorranceSparrow from(const R& r) {
        return {r.choice(0), r.number(1), r.spectrum(2), r.spectrum(3)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        const Vec3<D> h = half_vector(at.wi, at.wo);
        const D g = geometric_torrance_sparrow(at.wi, at.wo, h) / at_least(at.wo.z, 1e-8);
        const Product<D, P> f = fresnel_dielectric(clamped(dot(at.wo, h)), n);
        return ks * f * at.light * (above(at.wi, at.wo) * facets(h) * g);
    }
    /// D, at most 1.
    D facets(const Vec3<D>& h) const {
        const D b = radians(beta);
        if (distribution == 0) return distribution_phong(h, phong_exponent_of_beta(b));
        if (distribution == 1) return distribution_torrance_sparrow(h, torrance_sparrow_of_beta(b));
        return distribution_trowbridge_reitz(h, trowbridge_reitz_of_beta(b));
    }
};

}  // namespace nacre::illumination
