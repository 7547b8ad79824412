// <bsdf type="conductor"> and <bsdf type="roughconductor">: metals, smooth and rough; black from
// the inside.
//
//   material (none), or eta (0) and k (1)   see microfacet.h
//   specular_reflectance (1)                a factor without physical meaning
//   distribution, alpha, sample_visible     roughconductor only; see microfacet.h
#include "nacre/reflectance/rough_conductor.h"
#include "nacre/scene/materials/microfacet.h"

namespace nacre {
namespace {

class Conductor final : public Material {
  public:
    Conductor(MetalIndex index, TexturePtr reflectance)
        : index_(std::move(index)), reflectance_(std::move(reflectance)) {}

    unsigned flags() const override { return reflects | has_delta; }
    Spectral eval(const SurfacePoint&, const Vec3f&, const Vec3f&,
                  const Wavelengths&) const override {
        return Spectral(0.f);
    }
    float pdf(const SurfacePoint&, const Vec3f&, const Vec3f&, const Wavelengths&) const override {
        return 0.f;
    }
    std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float, Vec2f,
                                         const Wavelengths& w) const override {
        if (!(wo.z > 0.f)) return std::nullopt;
        MaterialSample s;
        s.wi = {-wo.x, -wo.y, wo.z};
        s.pdf = 1.f;
        s.delta = true;
        s.weight = reflectance_->eval(at.uv, w) *
                   fresnel_conductor(wo.z, index_.eta->eval(at.uv, w), index_.k->eval(at.uv, w));
        return s;
    }
    bool is_spectral() const override {
        return index_.eta->is_spectral() || index_.k->is_spectral() || reflectance_->is_spectral();
    }

  private:
    MetalIndex index_;
    TexturePtr reflectance_;
};

template <class Distribution>
class RoughConductorMaterial final : public Material {
  public:
    RoughConductorMaterial(Roughness roughness, MetalIndex index, TexturePtr reflectance)
        : roughness_(std::move(roughness)),
          index_(std::move(index)),
          reflectance_(std::move(reflectance)) {}

    unsigned flags() const override { return reflects | has_smooth; }
    Spectral eval(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                  const Wavelengths& w) const override {
        return model(at, w).eval(wi, wo) * wi.z;
    }
    float pdf(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
              const Wavelengths& w) const override {
        return model(at, w).pdf(wi, wo);
    }
    std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float, Vec2f u2,
                                         const Wavelengths& w) const override {
        if (!(wo.z > 0.f)) return std::nullopt;
        const auto m = model(at, w);
        MaterialSample s;
        s.wi = m.sample(wo, u2);
        s.pdf = m.pdf(s.wi, wo);
        if (!(s.pdf > 0.f)) return std::nullopt;
        s.weight = m.eval(s.wi, wo) * (s.wi.z / s.pdf);
        return s;
    }
    bool is_spectral() const override {
        return index_.eta->is_spectral() || index_.k->is_spectral() || reflectance_->is_spectral();
    }

  private:
    RoughConductor<float, Spectral, Distribution> model(const SurfacePoint& at,
                                                        const Wavelengths& w) const {
        return {roughness_.at<Distribution>(at.uv), index_.eta->eval(at.uv, w),
                index_.k->eval(at.uv, w), reflectance_->eval(at.uv, w), roughness_.sampling};
    }

    Roughness roughness_;
    MetalIndex index_;
    TexturePtr reflectance_;
};

}  // namespace

MaterialPtr make_conductor(const SceneNode& node, BuildContext& context) {
    return std::make_shared<Conductor>(get_metal(node, context),
                                       get_reflectance(node, "specular_reflectance", 1.f, context));
}

MaterialPtr make_roughconductor(const SceneNode& node, BuildContext& context) {
    Roughness roughness = get_roughness(node, context);
    MetalIndex index = get_metal(node, context);
    TexturePtr reflectance = get_reflectance(node, "specular_reflectance", 1.f, context);
    if (roughness.ggx)
        return std::make_shared<RoughConductorMaterial<Ggx<float>>>(
            std::move(roughness), std::move(index), std::move(reflectance));
    return std::make_shared<RoughConductorMaterial<Beckmann<float>>>(
        std::move(roughness), std::move(index), std::move(reflectance));
}

}  // namespace nacre
