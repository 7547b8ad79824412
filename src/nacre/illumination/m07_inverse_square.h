#pragma once
// Model 7, diffuse reflection with the inverse square law: model 6 for a small sphere of
// cross-section 1 far away, so that d_omega = 1 / |L|^2.
//
//   I_d = k_d <N, L> I_L / |L|^2
//
// Parameter: kd, 0..1. I_L is the light's radiant intensity. A BRDF (that of model 3) times the
// light's falloff. For light from infinity, where the formula has no value, its limit at constant
// irradiance is model 3. Reciprocal; conserves energy in the pi convention.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& inverse_square_description() {
    static const Description description{
        .number = 7,
        .name = "inverse_square",
        .aliases = {"7"},
        .title = "Diffuse reflection with the inverse square law",
        .authors = "after R. L. Cook, K. E. Torrance",
        .year = 1981,
        .source = "model 6 for a small sphere far away",
        .formula = "I_d = k_d <N, L> I_L / |L|^2",
        .part = Part::diffuse,
        .parameters = {diffuse_coefficient()},
        .light_distance = LightDistance::inverse_square,
        .is_brdf = true,
        .properties = "reciprocal; conserves energy in the pi convention",
    };
    return description;
}

template <class D, class P = D>
struct InverseSquare {
    static const Description& describe() { return inverse_square_description(); }

    P kd;

    template <class R>
    static InverseSquare from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        return kd * at.light * (clamped(at.wi.z) / (at.light_distance * at.light_distance));
    }
};

}  // namespace nacre::illumination
