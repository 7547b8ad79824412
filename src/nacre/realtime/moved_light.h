#pragma once
// A light that frames show elsewhere than where its scene was built, for who drags it.
#include "nacre/geometry/transform.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// Turned, moved or made larger as a whole by a similarity, and brighter or darker.
class MovedLight final : public Light {
  public:
    /// `scene`, whose light it is, outlives it.
    MovedLight(LightPtr light, const Scene& scene, const Transform& to, double brightness);

    LightSample sample(const Point3f& from, Vec2f u, const Wavelengths& wavelengths) const override;
    float pdf(const Point3f& from, const Vec3f& wi, const SurfacePoint* on_light) const override;
    Spectral radiance(const SurfacePoint* on_light, const Vec3f& direction,
                      const Wavelengths& wavelengths) const override;
    /// Lamps have more of it the larger they are.
    float power() const override {
        return light_->power() * brightness_ * (is_delta() ? 1.f : scale_ * scale_);
    }
    bool is_infinite() const override { return light_->is_infinite(); }
    bool is_delta() const override { return light_->is_delta(); }
    bool is_uniform() const override { return light_->is_uniform(); }
    Box3f bounds() const override;
    bool is_spectral() const override { return light_->is_spectral(); }

    /// The normal of the lamp's surface at `p`, which was drawn along `wi` from `distance`
    /// away; 0: it has none, or is a ball.
    Vec3f surface_normal(const Point3f& p, const Vec3f& wi, float distance) const;

  private:
    LightPtr light_;
    const Scene& scene_;
    Transform to_, back_;
    float scale_, brightness_;
};

/// The normal of a lamp's surface in a scene's rays at `p`, which was drawn along `wi` from
/// `distance` away; 0 if the light is no shape's, or a ball's.
Vec3f lamp_normal(const Scene& scene, const Light& light, const Point3f& p, const Vec3f& wi,
                  float distance);

}  // namespace nacre
