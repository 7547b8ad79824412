#pragma once
// Model 14, Phong's highlight fading with the viewer's distance (Foley and van Dam 1984).
//
//   J. D. Foley, A. van Dam 1984, Fundamentals of Interactive Computer Graphics (year not
//   verified). I_s = k_s <R, V>^m I_L / (|V| + d_k)
//
// Parameters: ks, 0..1; m >= 0; dk > 0, in units of length. Not a BRDF because of |V|; else
// model 13.
#include "nacre/illumination/m13_phong.h"

namespace nacre::illumination {

inline const Description& foley_van_dam_phong_description() {
    static const Description description{
        .number = 14,
        .name = "foley_van_dam_phong",
        .aliases = {"14"},
        .title = "Phong, fading linearly with viewer distance",
        .authors = "J. D. Foley, A. van Dam",
        .year = 1984,
        .source = "Fundamentals of Interactive Computer Graphics",
        .formula = "I_s = k_s <R, V>^m I_L / (|V| + d_k)",
        .part = Part::specular,
        .parameters = {specular_coefficient(), highlight_exponent(), distance_constant()},
        .uses_viewer_distance = true,
        .properties = "not a BRDF: depends on |V|",
    };
    return description;
}

template <class D, class P = D>
struct FoleyVanDamPhong {
    static const Description& describe() { return foley_van_dam_phong_description(); }

    P ks;
    D m, dk;

    template <class R>
    static FoleyVanDamPhong from(const R& r) {
        return {r.spectrum(0), r.number(1), r.number(2)};
    }
    Product<D, P> intensity(const Lighting<D, P>& at) const {
        return Phong<D, P>{ks, m}.intensity(at) * (D(1) / (at.viewer_distance + dk));
    }
};

}  // namespace nacre::illumination
