#pragma once
// Model 3, diffuse reflection (Bouknight 1970): Lambert's law, without distances.
//
//   W. J. Bouknight 1970, A Procedure for Generation of Three-Dimensional Half-Toned Computer
//   Graphics Presentations, CACM 13(9).
//   I_d = k_d <N, L> I_L
//
// Parameter: kd, 0..1. A BRDF: f = k_d (physical) or k_d / pi (pi convention). Reciprocal;
// conserves energy in the pi convention. Several lights add up, in this model as in all that
// follow.
//
// Errata: Formella and Fellner print the general equation and that for point lights alike; the
// general one has one L for each light.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& bouknight_diffuse_description() {
    static const Description description{
        .number = 3,
        .name = "bouknight_diffuse",
        .aliases = {"3"},
        .title = "Diffuse reflection",
        .authors = "W. J. Bouknight",
        .year = 1970,
        .source =
            "A Procedure for Generation of Three-Dimensional Half-Toned Computer Graphics "
            "Presentations, CACM 13(9)",
        .formula = "I_d = k_d <N, L> I_L",
        .part = Part::diffuse,
        .parameters = {diffuse_coefficient()},
        .is_brdf = true,
        .properties = "reciprocal; conserves energy in the pi convention",
        .errata = "the general equation and that for point lights are printed alike",
    };
    return description;
}

template <class D, class P = D>
struct BouknightDiffuse {
    static const Description& describe() { return bouknight_diffuse_description(); }

    P kd;

    template <class R>
    static BouknightDiffuse from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        return kd * clamped(at.wi.z) * at.light;
    }
};

}  // namespace nacre::illumination
