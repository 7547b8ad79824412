#pragma once
// Model 15, highlight by the half vector (Blinn 1977).
//
//   J. F. Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH.
//   I_s = k_s <H, N>^m I_L,   H = (L + V) / |L + V|
//
// Parameters: ks, 0..1; m >= 0; an exponent m makes about the highlight of Phong's m / 4. Over
// cos_i it is a BRDF, but not a reciprocal one, and its albedo is unbounded at grazing.
//
// Errata: H is printed as (L + V) / 2, whose length is the cosine of half the angle between L and V
// and which darkens the lobe; it must be normalised.
#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

inline const Description& blinn_phong_description() {
    static const Description description{
        .number = 15,
        .name = "blinn_phong",
        .aliases = {"15"},
        .title = "Blinn-Phong",
        .authors = "J. F. Blinn",
        .year = 1977,
        .source = "Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 77",
        .formula = "I_s = k_s <H, N>^m I_L, H = (L + V) / |L + V|",
        .part = Part::specular,
        .parameters = {specular_coefficient(), highlight_exponent()},
        .is_brdf = true,
        .properties = "not reciprocal; albedo unbounded at grazing",
        .errata = "H is printed as (L + V) / 2, without normalisation",
    };
    return description;
}

template <class D, class P = D>
struct BlinnPhong {
    static const Description& describe() { return blinn_phong_description(); }

    P ks;
    D m;

    template <class R>
    static BlinnPhong from(const R& r) {
        return {r.spectrum(0), r.number(1)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        using std::pow;
        return ks * at.light * (lit(at.wi) * pow(clamped(half_vector(at.wi, at.wo).z), m));
    }
};

}  // namespace nacre::illumination
