#pragma once
// Model 19, Cook and Torrance's facets with Hall's constant (Cook and Torrance 1982).
//
//   R. L. Cook, K. E. Torrance 1982, A Reflectance Model for Computer Graphics, ACM TOG 1(1).
//   R. Hall 1989, Illumination and Color in Computer Generated Imagery.
//   I_s = k_s D_BB G F / <N, V> I_L,   D_BB = exp(-tan^2/m^2) / (4 pi m^2 t^4),  t = <N, H>
//
// D_BB is a quarter of the normalised Beckmann density, so that over cos_i this is the modern
// F D G / (4 cos_i cos_o) exactly. F: of a dielectric at the facet. G: of V-shaped grooves or
// Sancer's (geometric_attenuation.h).
//
// Parameters: m > 0, sqrt(2) times the standard deviation of the slopes, or instead beta in (0, 90)
// degrees, where D is half of D(0) (0: m counts); n > 0; ks, 0..1; geometry (torrance_sparrow,
// sancer). A BRDF, reciprocal, conserves energy. For surfaces that are rough beside the wavelength,
// not for near mirrors.
//
// Errata: which constant the papers print is told differently; the forms with 1/pi, 4 m^2 and m^2
// in circulation differ by factors of 4 and pi.
#include "nacre/illumination/distribution_attenuation.h"
#include "nacre/illumination/geometric_attenuation.h"
#include "nacre/optics/fresnel.h"

namespace nacre::illumination {

inline const Description& cook_torrance_description() {
    static const Description description{
        .number = 19,
        .name = "cook_torrance",
        .aliases = {"19"},
        .title = "Cook-Torrance with Hall's constant",
        .authors = "R. L. Cook, K. E. Torrance; R. Hall",
        .year = 1982,
        .source = "A Reflectance Model for Computer Graphics, ACM TOG 1(1)",
        .formula = "I_s = k_s D_BB G F / <N, V> I_L, D_BB = exp(-tan^2/m^2) / (4 pi m^2 t^4)",
        .part = Part::specular,
        .parameters = {{.name = "m",
                        .meaning = "root mean square slope times sqrt(2)",
                        .high = infinite,
                        .above_low = true,
                        .otherwise = 0.3},
                       {.name = "beta",
                        .meaning = "angle at which D is half of D(0), in place of m; 0: m counts",
                        .unit = "degrees",
                        .high = 90.,
                        .below_high = true},
                       refractive_index(),
                       specular_coefficient(),
                       choice_parameter("geometry", "masking and shadowing",
                                        {{"torrance_sparrow", "of V-shaped grooves"},
                                         {"sancer", "of a random surface"}})},
        .is_brdf = true,
        .properties = "reciprocal; conserves energy",
        .errata = "m = (1 + sqrt(tan beta)) / (2 sqrt(pi)) does not make D(beta) half of D(0)",
    };
    return description;
}

template <class D, class P = D>
struct CookTorrance {
    static const Description& describe() { return cook_torrance_description(); }

    D m;
    D beta;  ///< degrees; 0: m counts
    P n, ks;
    int geometry;  ///< position of the choice

    template <class R>
    static CookTorrance from(const R& r) {
        return {r.number(0), r.number(1), r.spectrum(2), r.spectrum(3), r.choice(4)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        const Vec3<D> h = half_vector(at.wi, at.wo);
        const auto given = beta > D(0);
        const D slope =
            select(given, beckmann_slope_of_beta(radians(select(given, beta, D(1)))), m);
        const D g = geometry == 0 ? geometric_torrance_sparrow(at.wi, at.wo, h)
                                  : geometric_sancer(at.wi, at.wo, slope);
        const Product<D, P> f = fresnel_dielectric(clamped(dot(at.wo, h)), n);
        const D d = distribution_hall_beckmann(h, slope);
        return ks * f * at.light * (above(at.wi, at.wo) * d * g / at_least(at.wo.z, 1e-8));
    }
};

}  // namespace nacre::illumination
