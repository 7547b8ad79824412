// Lights that no ray can meet by chance: points, spots and beams of parallel light.
#include <numbers>

#include "nacre/scene/lights/types.h"
#include "nacre/spectrum/color.h"

namespace nacre {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// What all of them share: nothing can be met, only drawn.
class DeltaLight : public Light {
  public:
    DeltaLight(SpectrumPtr emission) : emission_(std::move(emission)) {}

    float pdf(const Point3f&, const Vec3f&, const SurfacePoint*) const final { return 0.f; }
    Spectral radiance(const SurfacePoint*, const Vec3f&, const Wavelengths&) const final {
        return Spectral(0.f);
    }
    bool is_delta() const final { return true; }
    bool is_spectral() const final { return emission_->is_spectral(); }

  protected:
    float emission_luminance() const { return luminance(emission_->rgb()); }

    SpectrumPtr emission_;  ///< intensity of points and spots, irradiance of directional lights
};

/// The same intensity in all directions.
class PointLight : public DeltaLight {
  public:
    PointLight(SpectrumPtr intensity, const Point3f& position)
        : DeltaLight(std::move(intensity)), position_(position) {}

    LightSample sample(const Point3f& from, Vec2f, const Wavelengths& w) const override {
        const Vec3f d = position_ - from;
        const float d2 = length_squared(d);
        const float distance = std::sqrt(d2);
        if (!(distance > 0.f)) return {};
        const Vec3f wi = d * (1.f / distance);
        return {wi, distance, emission_->eval(w) * (1.f / d2), 1.f, true};
    }
    float power() const override { return 4.f * pi * emission_luminance(); }
    Box3f bounds() const final { return {position_, position_}; }

  private:
    Point3f position_;
};

/// A point light in a cone about the local +z axis: full intensity up to the beam width, falling
/// linearly in the angle to nothing at the cutoff.
class SpotLight final : public PointLight {
  public:
    SpotLight(SpectrumPtr intensity, const Transform& to_world, float cutoff, float beam)
        : PointLight(std::move(intensity), to_world.point({0.f, 0.f, 0.f})),
          to_local_(to_world.inverse()),
          cutoff_(cutoff),
          cos_cutoff_(std::cos(cutoff)),
          cos_beam_(std::cos(beam)),
          per_angle_(cutoff > beam ? 1.f / (cutoff - beam) : 0.f) {}

    LightSample sample(const Point3f& from, Vec2f u, const Wavelengths& w) const override {
        LightSample s = PointLight::sample(from, u, w);
        const float f = s.pdf > 0.f ? falloff(s.wi * -1.f) : 0.f;
        if (f == 0.f) return {};
        s.radiance *= f;
        return s;
    }
    /// Exact for a cone whose rim is halfway down the slope.
    float power() const override {
        return 2.f * pi * (1.f - 0.5f * (cos_cutoff_ + cos_beam_)) * emission_luminance();
    }

  private:
    float falloff(const Vec3f& direction) const {
        const float cosine = normalize(to_local_.vector(direction)).z;
        if (cosine <= cos_cutoff_) return 0.f;
        if (cosine >= cos_beam_) return 1.f;
        return (cutoff_ - std::acos(cosine)) * per_angle_;
    }

    Transform to_local_;
    float cutoff_, cos_cutoff_, cos_beam_, per_angle_;
};

/// Parallel light through the whole scene; `emission_` is the irradiance of a surface that faces
/// it.
class DirectionalLight final : public DeltaLight {
  public:
    DirectionalLight(SpectrumPtr irradiance, const Vec3f& direction, float scene_radius)
        : DeltaLight(std::move(irradiance)), to_light_(-direction), scene_radius_(scene_radius) {}

    LightSample sample(const Point3f&, Vec2f, const Wavelengths& w) const override {
        return {to_light_, 1e30f, emission_->eval(w), 1.f, true};
    }
    float power() const override {
        return pi * scene_radius_ * scene_radius_ * emission_luminance();
    }
    Box3f bounds() const override { return {}; }

  private:
    Vec3f to_light_;
    float scene_radius_;
};

/// Angle in degrees within (low, high], in radians.
float get_angle(const SceneNode& node, std::string_view name, double otherwise, double high) {
    const double degrees = node.get_float(name, otherwise);
    if (!(degrees >= 0.0 && degrees <= high))
        node.fail_at(
            name, fmt::format("{} must lie between 0 and {} degrees; got {}", name, high, degrees));
    return static_cast<float>(degrees * std::numbers::pi / 180.0);
}

}  // namespace

LightPtr make_point_light(const SceneNode& node, BuildContext&) {
    if (node.has("position") && node.has("to_world"))
        node.fail_at("position", "give either position or to_world, not both");
    const Point3f position = node.has("position")
                                 ? Point3f(node.get_vector("position", {}))
                                 : node.get_transform("to_world").point({0.f, 0.f, 0.f});
    return std::make_shared<PointLight>(
        get_spectrum(node, "intensity", ColorRole::illuminant, default_emission()), position);
}

LightPtr make_spot_light(const SceneNode& node, BuildContext&) {
    const double cutoff = node.get_float("cutoff_angle", 20.0);
    const float cutoff_radians = get_angle(node, "cutoff_angle", 20.0, 180.0);
    const float beam_radians = get_angle(node, "beam_width", 0.75 * cutoff, cutoff);
    return std::make_shared<SpotLight>(
        get_spectrum(node, "intensity", ColorRole::illuminant, default_emission()),
        node.get_transform("to_world"), cutoff_radians, beam_radians);
}

LightPtr make_directional_light(const SceneNode& node, BuildContext& context) {
    if (node.has("direction") && node.has("to_world"))
        node.fail_at("direction", "give either direction or to_world, not both");
    const Vec3d given = node.has("direction")
                            ? node.get_vector("direction", {})
                            : Vec3d(node.get_transform("to_world").vector({0.f, 0.f, 1.f}));
    const double size = length(given);
    if (!(size > 0.0) || !std::isfinite(size))
        node.fail_at("direction", "direction must be a vector of finite length greater than 0");
    return std::make_shared<DirectionalLight>(
        get_spectrum(node, "irradiance", ColorRole::illuminant, default_emission()),
        Vec3f(given * (1.0 / size)), context.scene_radius);
}

}  // namespace nacre
