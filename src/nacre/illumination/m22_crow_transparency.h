#pragma once
// Model 22, transparency that falls towards the silhouette (Crow 1978).
//
//   F. C. Crow 1978, Shaded Computer Graphics in the Entertainment Industry, Computer 11(3), after
//   M. E. Newell, R. G. Newell, T. L. Sancha 1972, A Solution to the Hidden Surface Problem, ACM
//   National Conference.
//   k_t = (k_max - k_min) (1 - (1 - |<N, V>|)^p) + k_min,   blended as in model 21
//
// A thin shell is longer to cross where it is seen at a slant. Parameters: kmin, kmax, 0..1, shares
// that pass at the silhouette and face on; p > 0, usually 2 to 3. Not a BRDF.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& crow_transparency_description() {
    static const Description description{
        .number = 22,
        .name = "crow_transparency",
        .aliases = {"22"},
        .title = "Transparency falling towards the silhouette",
        .authors = "F. C. Crow",
        .year = 1978,
        .source = "Shaded Computer Graphics in the Entertainment Industry, Computer 11(3)",
        .formula = "k_t = (k_max - k_min) (1 - (1 - |<N, V>|)^p) + k_min",
        .part = Part::transparency,
        .parameters = {{.name = "kmin",
                        .meaning = "share that passes at the silhouette",
                        .kind = ParameterKind::spectrum,
                        .high = 1.,
                        .otherwise = 0.1},
                       {.name = "kmax",
                        .meaning = "share that passes face on",
                        .kind = ParameterKind::spectrum,
                        .high = 1.,
                        .otherwise = 0.9},
                       {.name = "p",
                        .meaning = "exponent of the transition",
                        .high = infinite,
                        .above_low = true,
                        .otherwise = 2.5}},
        .uses_light = false,
        .properties = "not a BRDF: a weight of what lies behind",
        .errata = "the text refers to model 20 for the blending; model 21 is meant",
    };
    return description;
}

template <class D, class P = D>
struct CrowTransparency {
    static const Description& describe() { return crow_transparency_description(); }

    P kmin, kmax;
    D p;

    template <class R>
    static CrowTransparency from(const R& r) {
        return {r.spectrum(0), r.spectrum(1), r.number(2)};
    }
    Product<D, P> transmittance(const Vec3<D>& wo) const {
        using std::abs, std::pow;
        const D facing = D(1) - pow(clamped(D(D(1) - abs(wo.z))), p);
        return (kmax - kmin) * facing + kmin;
    }
};

}  // namespace nacre::illumination
