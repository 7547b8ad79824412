#pragma once
// Model 6, diffuse reflection by the solid angle of the light (Cook and Torrance 1981).
//
//   R. L. Cook, K. E. Torrance 1981, A Reflectance Model for Computer Graphics, SIGGRAPH.
//   I_d = k_d <N, L> d_omega I_L
//
// Parameter: kd, 0..1. I_L is the radiance of the light, d_omega the solid angle that it fills, so
// this is exact for small lights. A BRDF: f = k_d (physical) or k_d / pi (pi convention).
// Reciprocal; conserves energy in the pi convention.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& cook_torrance_diffuse_description() {
    static const Description description{
        .number = 6,
        .name = "cook_torrance_diffuse",
        .aliases = {"6"},
        .title = "Diffuse reflection by the solid angle of the light",
        .authors = "R. L. Cook, K. E. Torrance",
        .year = 1981,
        .source = "A Reflectance Model for Computer Graphics, SIGGRAPH 81",
        .formula = "I_d = k_d <N, L> d_omega I_L",
        .part = Part::diffuse,
        .parameters = {diffuse_coefficient()},
        .light_distance = LightDistance::inverse_square,
        .is_brdf = true,
        .properties = "reciprocal; conserves energy in the pi convention",
    };
    return description;
}

template <class D, class P = D>
struct CookTorranceDiffuse {
    static const Description& describe() { return cook_torrance_diffuse_description(); }

    P kd;

    template <class R>
    static CookTorranceDiffuse from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        return kd * (clamped(at.wi.z) * at.solid_angle) * at.light;
    }
};

}  // namespace nacre::illumination
