// Light from infinitely far away in every direction alike.
#include <numbers>

#include "nacre/math/sampling.h"
#include "nacre/scene/lights/types.h"
#include "nacre/spectrum/color.h"

namespace nacre {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// The same radiance from everywhere. Directions are drawn uniformly over the sphere: the light
/// does not know the surface that asks.
class ConstantLight final : public Light {
  public:
    ConstantLight(SpectrumPtr radiance, float scene_radius)
        : radiance_(std::move(radiance)), scene_radius_(scene_radius) {}

    LightSample sample(const Point3f&, Vec2f u, const Wavelengths& w) const override {
        return {square_to_sphere(u), 1e30f, radiance_->eval(w), sphere_pdf<float>()};
    }
    float pdf(const Point3f&, const Vec3f&, const SurfacePoint*) const override {
        return sphere_pdf<float>();
    }
    Spectral radiance(const SurfacePoint*, const Vec3f&, const Wavelengths& w) const override {
        return radiance_->eval(w);
    }
    /// What enters the bounding sphere: pi L through its surface of 4 pi r^2.
    float power() const override {
        return 4.f * pi * pi * scene_radius_ * scene_radius_ * luminance(radiance_->rgb());
    }
    bool is_infinite() const override { return true; }
    bool is_uniform() const override { return true; }
    Box3f bounds() const override { return {}; }
    bool is_spectral() const override { return radiance_->is_spectral(); }

  private:
    SpectrumPtr radiance_;
    float scene_radius_;
};

}  // namespace

LightPtr make_constant_light(const SceneNode& node, BuildContext& context) {
    return std::make_shared<ConstantLight>(
        get_spectrum(node, "radiance", ColorRole::illuminant, default_emission()),
        context.scene_radius);
}

}  // namespace nacre
