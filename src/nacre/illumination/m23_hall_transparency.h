#pragma once
// Model 23, transparency of a plate by its index (Hall 1981).
//
//   R. Hall 1983, A Methodology for Realistic Image Synthesis, MS thesis, Cornell University.
//   k_t = (1 - R) / (1 + R),   R = ((n - 1) / (n + 1))^2,   blended as in model 21
//
// What a clear plate lets pass at normal incidence, all reflections between its two faces included:
// 2 n / (n^2 + 1). Parameter: n > 0, which may vary with wavelength. Light is bent by Snell's law
// and absorbed on its way (absorption_attenuation) where the renderer follows it. Not a BRDF.
//
// Errata: presented as if for one interface, which lets 4 n / (n + 1)^2 pass
// (interface_transmittance).
#include "nacre/illumination/lighting.h"
#include "nacre/optics/fresnel.h"

namespace nacre::illumination {

inline const Description& hall_transparency_description() {
    static const Description description{
        .number = 23,
        .name = "hall_transparency",
        .aliases = {"23"},
        .title = "Transparency of a plate",
        .authors = "R. Hall",
        .year = 1981,
        .source =
            "A Methodology for Realistic Image Synthesis, MS thesis, Cornell University, 1983",
        .formula = "k_t = (1 - R) / (1 + R), R = ((n - 1) / (n + 1))^2",
        .part = Part::transparency,
        .parameters = {refractive_index()},
        .uses_light = false,
        .properties = "not a BRDF: a weight of what lies behind",
        .errata = "holds for a plate, not for one interface",
    };
    return description;
}

template <class D, class P = D>
struct HallTransparency {
    static const Description& describe() { return hall_transparency_description(); }

    P n;

    template <class R>
    static HallTransparency from(const R& r) {
        return {r.spectrum(0)};
    }
    Product<D, P> transmittance(const Vec3<D>&) const {
        const P r = normal_reflectance(n);
        return (P(1.f) - r) / (P(1.f) + r) * D(1);
    }
};

/// Share of light that one clear interface lets pass at normal incidence, 4 n / (n + 1)^2.
template <class P>
P interface_transmittance(P n) {
    return P(4.f) * n / ((n + P(1.f)) * (n + P(1.f)));
}

}  // namespace nacre::illumination
