#pragma once
// Model 21, a thin surface that lets a share of light pass.
//
//   M. E. Newell, R. G. Newell, T. L. Sancha 1972, A Solution to the Hidden Surface Problem, ACM
//   National Conference; as written by Foley et al. 1990.
//   I = (1 - k_t) I_r + k_t I_t
//
// I_r is what the surface itself shows, I_t what lies straight behind it. Parameter: kt, 0..1, the
// share of light that passes. Not a BRDF.
//
// Errata: printed with I_r and I_t exchanged, which makes k_t the opacity.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& linear_transparency_description() {
    static const Description description{
        .number = 21,
        .name = "linear_transparency",
        .aliases = {"21"},
        .title = "Linear transparency",
        .authors = "M. E. Newell, R. G. Newell, T. L. Sancha",
        .year = 1972,
        .source = "A Solution to the Hidden Surface Problem, ACM National Conference",
        .formula = "I = (1 - k_t) I_r + k_t I_t",
        .part = Part::transparency,
        .parameters = {{.name = "kt",
                        .meaning = "share of light that passes",
                        .kind = ParameterKind::spectrum,
                        .high = 1.,
                        .otherwise = 0.5}},
        .uses_light = false,
        .properties = "not a BRDF: a weight of what lies behind",
        .errata = "printed with I_r and I_t exchanged",
    };
    return description;
}

template <class D, class P = D>
struct LinearTransparency {
    static const Description& describe() { return linear_transparency_description(); }

    P kt;

    template <class R>
    static LinearTransparency from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> transmittance(const Vec3<D>&) const { return kt * D(1); }
};

/// What the viewer sees of a transparent surface: `own` is I_r, `behind` I_t.
template <class P>
P blend(P transmittance, P own, P behind) {
    return (P(1.f) - transmittance) * own + transmittance * behind;
}

}  // namespace nacre::illumination
