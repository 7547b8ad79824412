#pragma once
// Model 1, ambient light (Bouknight 1970): a floor under the brightness for all the indirect light
// that is not simulated.
//
//   W. J. Bouknight 1970, A Procedure for Generation of Three-Dimensional Half-Toned Computer
//   Graphics Presentations, CACM 13(9).
//   I_a = k_a I
//
// Parameter: ka, 0..1. I is the ambient light of the scene. It has no direction, so this is no
// BRDF.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& bouknight_ambient_description() {
    static const Description description{
        .number = 1,
        .name = "bouknight_ambient",
        .aliases = {"1"},
        .title = "Ambient light",
        .authors = "W. J. Bouknight",
        .year = 1970,
        .source =
            "A Procedure for Generation of Three-Dimensional Half-Toned Computer Graphics "
            "Presentations, CACM 13(9)",
        .formula = "I_a = k_a I",
        .part = Part::ambient,
        .parameters = {ambient_coefficient()},
        .uses_light = false,
        .properties = "not a BRDF: no direction of incidence",
    };
    return description;
}

template <class D, class P = D>
struct BouknightAmbient {
    static const Description& describe() { return bouknight_ambient_description(); }

    P ka;

    template <class R>
    static BouknightAmbient from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const { return at.ambient * ka; }
};

}  // namespace nacre::illumination
