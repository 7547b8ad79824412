#pragma once
// What an illumination model knows of one light at one surface point, and what the models share.
//
// A model is a struct template over its number types, one model a file (m01_... to m23_...):
//
//   template <class D, class P = D>      // D: directions and lengths; P: what varies by wavelength
//   struct Name {
//       static constexpr const Description& description;
//       ...                                                    // parameters
//       template <class R> static Name from(const R& values);  // in the order of the description
//       Product<D, P> intensity(const Lighting<D, P>& at) const;         // models 1-20
//       Product<D, P> transmittance(const Vec3<D>& wo) const;            // models 21-23
//   };
//
// Directions are unit vectors in the local frame (z = normal), wi to the light, wo to the viewer.
// Unless a model says otherwise, scalar products are clamped at 0. Nothing branches on values.
#include "nacre/illumination/description.h"
#include "nacre/reflectance/model.h"

namespace nacre::illumination {

template <class D, class P = D>
struct Lighting {
    Vec3<D> wi, wo;                                   ///< L and V
    P light = P(1.f);                                 ///< I_L, see light_convention.h
    P ambient = P(0.f);                               ///< I, of the whole scene
    D light_distance = D(1), viewer_distance = D(1);  ///< |L| and |V|
    D solid_angle = D(1);                             ///< d omega of the light, sr
    P wavelength = P(550.f);                          ///< nm
};

/// [x]+
template <class D>
D clamped(D x) {
    return select(x > D(0), x, D(0));
}

/// <R, V> with R the light's direction mirrored about the normal; not clamped.
template <class D>
D mirror_cosine(const Vec3<D>& wi, const Vec3<D>& wo) {
    return wi.z * wo.z - wi.x * wo.x - wi.y * wo.y;
}

/// 1 where the light is above the horizon, else 0.
template <class D>
D lit(const Vec3<D>& wi) {
    return select(wi.z > D(0), D(1), D(0));
}

template <class D>
D radians(D degrees) {
    return degrees * D(std::numbers::pi / 180.);
}

}  // namespace nacre::illumination
