#pragma once
// Model 5, diffuse reflection that fades with the fourth power of the viewer's distance (Romney
// 1969).
//
//   G. W. Romney 1969, Computer Assisted Assembly and Rendering of Solids, PhD thesis, University
//   of Utah. I_d = k <N, L>^2 / |V|^4
//
// Parameter: kd >= 0, written k by Romney, of any size since |V|^4 is large. No I_L: every light is
// alike. The square draws surfaces from behind, too. Not a BRDF because of |V|; the part that
// depends on directions alone, k cos_i, is not reciprocal and has the albedo pi k cos_i.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& romney_description() {
    static const Description description{
        .number = 5,
        .name = "romney",
        .aliases = {"5"},
        .title = "Diffuse reflection, fading with the fourth power of viewer distance",
        .authors = "G. W. Romney",
        .year = 1969,
        .source =
            "Computer Assisted Assembly and Rendering of Solids, PhD thesis, University of Utah",
        .formula = "I_d = k <N, L>^2 / |V|^4",
        .part = Part::diffuse,
        .parameters = {{.name = "kd",
                        .meaning = "gain, k in the thesis",
                        .kind = ParameterKind::spectrum,
                        .unit = "length^4",
                        .high = infinite,
                        .otherwise = 1.}},
        .uses_viewer_distance = true,
        .uses_light = false,
        .properties = "not a BRDF: depends on |V|",
    };
    return description;
}

template <class D, class P = D>
struct Romney {
    static const Description& describe() { return romney_description(); }

    P kd;

    template <class R>
    static Romney from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        const D v2 = at.viewer_distance * at.viewer_distance;
        return kd * (at.wi.z * at.wi.z / (v2 * v2));
    }
};

}  // namespace nacre::illumination
