#pragma once
// Model 10, diffuse reflection that fades linearly with the viewer's distance (Foley and van Dam
// 1984).
//
//   J. D. Foley, A. van Dam 1984, Fundamentals of Interactive Computer Graphics.
//   I_d = k_d <N, L> I_L / (|V| + d_k)
//
// Parameters: kd, 0..1; dk > 0, in units of length, which sets how near the viewer is. Softer than
// the inverse square, which looked too hard, and finite at |V| = 0. Not a BRDF because of |V|.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& foley_van_dam_diffuse_description() {
    static const Description description{
        .number = 10,
        .name = "foley_van_dam_diffuse",
        .aliases = {"10"},
        .title = "Diffuse reflection, fading linearly with viewer distance",
        .authors = "J. D. Foley, A. van Dam",
        .year = 1984,
        .source = "Fundamentals of Interactive Computer Graphics",
        .formula = "I_d = k_d <N, L> I_L / (|V| + d_k)",
        .part = Part::diffuse,
        .parameters = {diffuse_coefficient(), distance_constant()},
        .uses_viewer_distance = true,
        .properties = "not a BRDF: depends on |V|",
    };
    return description;
}

template <class D, class P = D>
struct FoleyVanDamDiffuse {
    static const Description& describe() { return foley_van_dam_diffuse_description(); }

    P kd;
    D dk;

    template <class R>
    static FoleyVanDamDiffuse from(const R& r) {
        return {r.spectrum(0), r.number(1)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        return kd * at.light * (clamped(at.wi.z) / (at.viewer_distance + dk));
    }
};

}  // namespace nacre::illumination
