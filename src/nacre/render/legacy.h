#pragma once
// Shading by the illumination models 1-23 (room `illumination`), as their papers did: the first
// surface that a camera ray meets is shaded by the lights, and nothing else is simulated.
//
//   I = I_a + sum over lights (I_d + I_s),   (1 - k_t) I + k_t I_behind at transparent surfaces
//
// |V| is the length of the way from the camera, |L| that to the light. Every light adds its part;
// of an area light one point is drawn a sample. Shadows are optional: most of the papers had none.
//
// I_L. Of models with a law of distance of their own it is the light's radiant intensity; light
// from infinity counts as being so far away that only its irradiance remains, and is not attenuated
// by the factor of model 11. Of the others it is, by choice, the radiant intensity as well (as
// published: brightness does not depend on |L|) or the irradiance at the point. In the pi
// convention it is all over pi. Models without I_L (4, 5, 12) take every light as alike; model 12
// knows one light only, at the eye.
//
// Transparent are surfaces whose material transmits light or lets it pass (dielectric,
// thindielectric, mask, null ...), if a transparency model was named. The ray goes on straight
// behind them, or with `refraction` by Snell's law (mirrored where that reflects totally), the
// first lane's index deciding where they differ. Shadow rays keep k_t of transparent surfaces.
//
// Surfaces seen from behind are shaded as if their other side were the front. The material's
// colour, pi times its BRDF at normal incidence and viewing but at most 1, scales I_a and I_d.
#include "nacre/render/integrator.h"
#include "nacre/scene/legacy_settings.h"

namespace nacre {

class LegacyShading : public Integrator {
  public:
    /// Throws InputError if the scene's integrator names no model.
    explicit LegacyShading(const Scene& scene);

    Spectral radiance(const Ray& ray, Sampler& sampler, const Wavelengths& wavelengths,
                      RayCounts& counts) const override;

  private:
    struct WayToLight;
    bool is_transparent(const ShapeBinding& shape) const;
    Spectral transmittance(const Vec3f& wo, const Wavelengths& w) const;
    Spectral visibility(const SurfacePoint& from, const LightSample& light, const Wavelengths& w,
                        RayCounts& counts) const;
    float unblocked(const SurfacePoint& at, const Framef& frame, Sampler& sampler,
                    RayCounts& counts) const;
    Spectral shade(const SurfacePoint& at, const Framef& frame, const Vec3f& to_viewer,
                   float viewer_distance, Sampler& sampler, const Wavelengths& w,
                   RayCounts& counts) const;

    const Scene& scene_;
    std::shared_ptr<const LegacySettings> settings_;
    const LegacyModel *ambient_, *diffuse_, *specular_, *transparency_;
};

}  // namespace nacre
