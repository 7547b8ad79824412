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

class ConductorBsdf final : public DeltaBsdf {
  public:
    ConductorBsdf(const MetalIndex& index, const Texture& reflectance, Vec2f uv,
                  const Wavelengths& w)
        : index_(index), reflectance_(reflectance), uv_(uv), w_(w) {}

    std::optional<BsdfSample> sample(const Vec3f& wo, float, Vec2f) const override {
        if (!(wo.z > 0.f)) return std::nullopt;
        BsdfSample s;
        s.wi = {-wo.x, -wo.y, wo.z};
        s.pdf = 1.f;
        s.delta = true;
        s.weight = reflectance_.eval(uv_, w_) *
                   fresnel_conductor(wo.z, index_.eta->eval(uv_, w_), index_.k->eval(uv_, w_));
        return s;
    }

  private:
    const MetalIndex& index_;
    const Texture& reflectance_;
    Vec2f uv_;
    Wavelengths w_;
};

class Conductor final : public Material {
  public:
    Conductor(MetalIndex index, TexturePtr reflectance)
        : index_(std::move(index)), reflectance_(std::move(reflectance)) {}

    unsigned flags() const override { return reflects | has_delta; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<ConductorBsdf>(index_, *reflectance_, point.uv, w);
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
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        using Model = RoughConductor<float, Spectral, Distribution>;
        const Vec2f uv = point.uv;
        return scratch.make<RoughReflectionBsdf<Model>>(
            Model{roughness_.at<Distribution>(uv), index_.eta->eval(uv, w), index_.k->eval(uv, w),
                  reflectance_->eval(uv, w), roughness_.sampling});
    }
    bool is_spectral() const override {
        return index_.eta->is_spectral() || index_.k->is_spectral() || reflectance_->is_spectral();
    }

  private:
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
