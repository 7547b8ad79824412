#pragma once
// Model 13, Phong's highlight around the mirror direction (Phong 1975).
//
//   Bui Tuong Phong 1975, Illumination for Computer Generated Pictures, CACM 18(6).
//   I_s = k_s <R, V>^m I_L,   R = L mirrored about N
//
// Parameters: ks, 0..1, which Phong let depend on the angle of incidence; m >= 0, about 1 to 100
// and more. Over cos_i it is a BRDF, but not a reciprocal one, and its albedo is 2 pi k_s / (m + 2)
// at normal incidence and unbounded at grazing. The BRDFs named after Phong are in the room
// `reflectance`.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& phong_description() {
    static const Description description{
        .number = 13,
        .name = "phong",
        .aliases = {"13"},
        .title = "Phong",
        .authors = "Bui Tuong Phong",
        .year = 1975,
        .source = "Illumination for Computer Generated Pictures, CACM 18(6)",
        .formula = "I_s = k_s <R, V>^m I_L",
        .part = Part::specular,
        .parameters = {specular_coefficient(), highlight_exponent()},
        .is_brdf = true,
        .properties =
            "not reciprocal; albedo 2 pi k_s / (m + 2) at normal incidence, unbounded at grazing",
    };
    return description;
}

template <class D, class P = D>
struct Phong {
    static const Description& describe() { return phong_description(); }

    P ks;
    D m;

    template <class R>
    static Phong from(const R& r) {
        return {r.spectrum(0), r.number(1)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        using std::pow;
        const D lobe = lit(at.wi) * pow(clamped(mirror_cosine(at.wi, at.wo)), m);
        return ks * at.light * lobe;
    }
};

}  // namespace nacre::illumination
