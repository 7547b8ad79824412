#pragma once
// Model 12, highlight of a light at the eye (Warnock 1969).
//
//   J. E. Warnock 1969, A Hidden Surface Algorithm for Computer Generated Halftone Pictures,
//   University of Utah TR 4-15; that the formula is from there is handed down, not verified.
//   I_s = <N, L>^m / |V|
//
// Parameter: m >= 0. It holds for L = V only: the light stands at the eye (the integrator `legacy`
// puts it there). No I_L. Not a BRDF because of |V|.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& warnock_specular_description() {
    static const Description description{
        .number = 12,
        .name = "warnock_specular",
        .aliases = {"12"},
        .title = "Highlight of a light at the eye",
        .authors = "J. E. Warnock",
        .year = 1969,
        .source =
            "A Hidden Surface Algorithm for Computer Generated Halftone Pictures, University of "
            "Utah TR 4-15 (attribution not verified)",
        .formula = "I_s = <N, L>^m / |V|, L = V",
        .part = Part::specular,
        .parameters = {highlight_exponent()},
        .uses_viewer_distance = true,
        .uses_light = false,
        .properties = "not a BRDF: depends on |V|",
    };
    return description;
}

template <class D, class P = D>
struct WarnockSpecular {
    static const Description& describe() { return warnock_specular_description(); }

    D m;

    template <class R>
    static WarnockSpecular from(const R& r) {
        return {r.number(0)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        using std::pow;
        return P(1.f) * (lit(at.wi) * pow(clamped(at.wi.z), m) / at.viewer_distance);
    }
};

}  // namespace nacre::illumination
