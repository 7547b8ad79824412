#pragma once
// Model 8, diffuse reflection with the inverse square of the whole way (van Dam 1984).
//
//   J. D. Foley, A. van Dam 1984, Fundamentals of Interactive Computer Graphics.
//   I_d = k_d <N, L> I_L / (|L| + |V|)^2
//
// Parameter: kd, 0..1. I_L is the light's radiant intensity. What a mirror would do: the way from
// the light by the surface to the viewer is taken as one. Not a BRDF because of |V|.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& van_dam_diffuse_description() {
    static const Description description{
        .number = 8,
        .name = "van_dam_diffuse",
        .aliases = {"8"},
        .title = "Diffuse reflection with the inverse square of the whole way",
        .authors = "J. D. Foley, A. van Dam",
        .year = 1984,
        .source = "Fundamentals of Interactive Computer Graphics",
        .formula = "I_d = k_d <N, L> I_L / (|L| + |V|)^2",
        .part = Part::diffuse,
        .parameters = {diffuse_coefficient()},
        .light_distance = LightDistance::inverse_square,
        .uses_viewer_distance = true,
        .properties = "not a BRDF: depends on |V|",
    };
    return description;
}

template <class D, class P = D>
struct VanDamDiffuse {
    static const Description& describe() { return van_dam_diffuse_description(); }

    P kd;

    template <class R>
    static VanDamDiffuse from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        const D way = at.light_distance + at.viewer_distance;
        return kd * at.light * (clamped(at.wi.z) / (way * way));
    }
};

}  // namespace nacre::illumination
