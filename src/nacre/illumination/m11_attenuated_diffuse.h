#pragma once
// Model 11, diffuse reflection with an attenuation factor (Foley, van Dam, Feiner, Hughes 1990).
//
//   J. D. Foley et al. 1990, Computer Graphics: Principles and Practice, section 16.1.2.
//   I_d = k_d d_att <N, L> I_L,   d_att = min(1, 1 / (c1 + c2 |L| + c3 |L|^2))
//
// Parameters: kd, 0..1; c1, c2 (1/length), c3 (1/length^2) >= 0. I_L is the light's radiant
// intensity. Light from infinity is not attenuated by c2 and c3. A BRDF (that of model 3) times the
// light's falloff. Reciprocal; conserves energy in the pi convention.
#include "nacre/illumination/distance_attenuation.h"

namespace nacre::illumination {

inline const Description& attenuated_diffuse_description() {
    static const Description description{
        .number = 11,
        .name = "attenuated_diffuse",
        .aliases = {"11"},
        .title = "Diffuse reflection with an attenuation factor",
        .authors = "J. D. Foley, A. van Dam, S. K. Feiner, J. F. Hughes",
        .year = 1990,
        .source = "Computer Graphics: Principles and Practice, section 16.1.2",
        .formula = "I_d = k_d d_att <N, L> I_L, d_att = min(1, 1 / (c1 + c2 |L| + c3 |L|^2))",
        .part = Part::diffuse,
        .parameters =
            {diffuse_coefficient(),
             {.name = "c1", .meaning = "constant attenuation", .high = infinite, .otherwise = 1.},
             {.name = "c2", .meaning = "linear attenuation", .unit = "1/length", .high = infinite},
             {.name = "c3",
              .meaning = "quadratic attenuation",
              .unit = "1/length^2",
              .high = infinite}},
        .light_distance = LightDistance::attenuated,
        .is_brdf = true,
        .properties = "reciprocal; conserves energy in the pi convention",
    };
    return description;
}

template <class D, class P = D>
struct AttenuatedDiffuse {
    static const Description& describe() { return attenuated_diffuse_description(); }

    P kd;
    D c1, c2, c3;

    template <class R>
    static AttenuatedDiffuse from(const R& r) {
        return {r.spectrum(0), r.number(1), r.number(2), r.number(3)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        return kd * at.light *
               (clamped(at.wi.z) * distance_attenuation(at.light_distance, c1, c2, c3));
    }
};

}  // namespace nacre::illumination
