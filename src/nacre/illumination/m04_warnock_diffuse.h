#pragma once
// Model 4, diffuse reflection that fades with the distance to the viewer (Warnock 1969).
//
//   J. E. Warnock 1969, A Hidden Surface Algorithm for Computer Generated Halftone Pictures,
//   University of Utah TR 4-15.
//   I_d = |<N, L>| / |V|
//
// No parameters and no I_L: every light is alike. The absolute value draws surfaces from behind,
// too. Not a BRDF because of |V|; the part that depends on directions alone is a constant one.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& warnock_diffuse_description() {
    static const Description description{
        .number = 4,
        .name = "warnock_diffuse",
        .aliases = {"4"},
        .title = "Diffuse reflection, fading with viewer distance",
        .authors = "J. E. Warnock",
        .year = 1969,
        .source =
            "A Hidden Surface Algorithm for Computer Generated Halftone Pictures, University of "
            "Utah TR 4-15",
        .formula = "I_d = |<N, L>| / |V|",
        .part = Part::diffuse,
        .parameters = {},
        .uses_viewer_distance = true,
        .uses_light = false,
        .properties = "not a BRDF: depends on |V|",
    };
    return description;
}

template <class D, class P = D>
struct WarnockDiffuse {
    static const Description& describe() { return warnock_diffuse_description(); }

    template <class R>
    static WarnockDiffuse from(const R&) {
        return {};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        using std::abs;
        return P(1.f) * (abs(at.wi.z) / at.viewer_distance);
    }
};

}  // namespace nacre::illumination
