#pragma once
// Model 9, diffuse reflection with the inverse squares of both distances.
//
//   I_d = k_d <N, L> I_L / (|L|^2 |V|^2)
//
// Parameter: kd, 0..1. I_L is the light's radiant intensity. Not a BRDF because of |V|.
//
// Errata: argued for by reflected light fading with the square of the viewer's distance. The power
// that a pixel receives from a point does, but the radiance, which is what a picture shows, does
// not.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& two_inverse_squares_description() {
    static const Description description{
        .number = 9,
        .name = "two_inverse_squares",
        .aliases = {"9"},
        .title = "Diffuse reflection with the inverse squares of both distances",
        .authors = "A. Formella, D. Fellner",
        .year = 2004,
        .source = "Berechnungsmodelle, lecture notes, TU Braunschweig",
        .formula = "I_d = k_d <N, L> I_L / (|L|^2 |V|^2)",
        .part = Part::diffuse,
        .parameters = {diffuse_coefficient()},
        .light_distance = LightDistance::inverse_square,
        .uses_viewer_distance = true,
        .properties = "not a BRDF: depends on |V|",
        .errata = "radiance does not change with the viewer's distance",
    };
    return description;
}

template <class D, class P = D>
struct TwoInverseSquares {
    static const Description& describe() { return two_inverse_squares_description(); }

    P kd;

    template <class R>
    static TwoInverseSquares from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        const D product = at.light_distance * at.viewer_distance;
        return kd * at.light * (clamped(at.wi.z) / (product * product));
    }
};

}  // namespace nacre::illumination
