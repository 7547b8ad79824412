#pragma once
// Model 2, ambient light behind obstacles (Cook and Torrance 1981).
//
//   R. L. Cook, K. E. Torrance 1981, A Reflectance Model for Computer Graphics, SIGGRAPH.
//   I_a = k_a f I
//
// Parameters: ka, 0..1; f, 0..1, the fraction of the hemisphere above the point that is not
// blocked, (1/pi) times the integral of cos over the free directions: today's ambient occlusion.
// The paper does not say how to find it; the integrator `legacy` casts rays for it unless f is
// given. Not a BRDF.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& cook_torrance_ambient_description() {
    static const Description description{
        .number = 2,
        .name = "cook_torrance_ambient",
        .aliases = {"2"},
        .title = "Ambient light behind obstacles",
        .authors = "R. L. Cook, K. E. Torrance",
        .year = 1981,
        .source = "A Reflectance Model for Computer Graphics, SIGGRAPH 81",
        .formula = "I_a = k_a f I",
        .part = Part::ambient,
        .parameters = {ambient_coefficient(),
                       {.name = "f",
                        .meaning = "fraction of the hemisphere that is not blocked",
                        .high = 1.,
                        .otherwise = 1.}},
        .uses_light = false,
        .properties = "not a BRDF: no direction of incidence",
    };
    return description;
}

template <class D, class P = D>
struct CookTorranceAmbient {
    static const Description& describe() { return cook_torrance_ambient_description(); }

    P ka;
    D f;

    template <class R>
    static CookTorranceAmbient from(const R& r) {
        return {r.spectrum(0), r.number(1)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const { return ka * f * at.ambient; }
};

}  // namespace nacre::illumination
