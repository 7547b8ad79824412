#pragma once
// What the light intensity I_L of the illumination models is in radiometric terms.
//
// physical: I_L is the irradiance E of a surface that faces the light, so that I is the radiance
//   f cos_i E of the BRDF f = I / (I_L cos_i). A diffuse coefficient k_d = 1 then reflects pi times
//   more than came in.
// pi: E = pi I_L, as classic shading has it, f = I / (pi I_L cos_i): k_d is the albedo.
//
// Models with a law of distance of their own (LightDistance) take the light's radiant intensity
// E |L|^2 in place of E. The viewer's distance |V| has no place in radiometry: radiance does not
// change along a ray, and models that divide by it are not BRDFs.
#include <stdexcept>

#include "nacre/illumination/lighting.h"

namespace nacre::illumination {

enum class LightConvention { physical, pi };

/// I_L of a light that brings `irradiance` to a surface facing it.
template <class P>
P light_intensity(P irradiance, LightConvention convention) {
    return convention == LightConvention::pi ? P(irradiance * P(inv_pi)) : irradiance;
}

/// BRDF, sr^-1, of a model whose description says is_brdf: I / (I_L cos_i) at unit distances, over
/// pi in the pi convention; 0 below the horizon.
template <class Model, class D>
auto brdf(const Model& model, const Vec3<D>& wi, const Vec3<D>& wo, LightConvention convention) {
    if (!Model::describe().is_brdf)
        throw std::logic_error("the model depends on more than two directions");
    const auto intensity = model.intensity({.wi = wi, .wo = wo});
    const D share = convention == LightConvention::pi ? D(inv_pi) : D(1);
    return intensity * (share * above(wi, wo) / at_least(wi.z, 1e-12));
}

}  // namespace nacre::illumination
