#pragma once
// Model 17, a highlight over the whole sphere (Yang 1987; the source is handed down, not verified).
//
//   I_s = k_s ((<V, R> + 1) / 2)^m I_L
//
// <V, R> is not clamped here. Since (1 + cos x) / 2 = cos^2(x / 2) the lobe is that of the half
// angle: in the plane of incidence it is Blinn's with exponent 2 m. Parameters: ks, 0..1; m >= 0.
// Over cos_i it is a BRDF, but not a reciprocal one, and its albedo is unbounded at grazing.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& yang_description() {
    static const Description description{
        .number = 17,
        .name = "yang",
        .aliases = {"17"},
        .title = "Yang",
        .authors = "Yang",
        .year = 1987,
        .source = "source not verified",
        .formula = "I_s = k_s ((<V, R> + 1) / 2)^m I_L",
        .part = Part::specular,
        .parameters = {specular_coefficient(), highlight_exponent()},
        .is_brdf = true,
        .properties = "not reciprocal; albedo unbounded at grazing",
    };
    return description;
}

template <class D, class P = D>
struct Yang {
    static const Description& describe() { return yang_description(); }

    P ks;
    D m;

    template <class R>
    static Yang from(const R& r) {
        return {r.spectrum(0), r.number(1)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        using std::pow;
        const D base = D(0.5) * (mirror_cosine(at.wi, at.wo) + D(1));
        return ks * at.light * (lit(at.wi) * pow(clamped(base), m));
    }
};

}  // namespace nacre::illumination
