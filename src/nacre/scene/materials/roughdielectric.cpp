// <bsdf type="roughdielectric">: a rough boundary between two clear media.
//
//   int_ior (bk7), ext_ior (air)          one index for all wavelengths; see index.h
//   distribution, alpha, sample_visible   see microfacet.h
//   specular_reflectance, specular_transmittance (1)   factors without physical meaning
#include "nacre/reflectance/rough_dielectric.h"
#include "nacre/scene/materials/index.h"
#include "nacre/scene/materials/microfacet.h"

namespace nacre {
namespace {

template <class Distribution>
class RoughDielectricBsdf final : public Bsdf {
  public:
    using Model = RoughDielectric<float, Spectral, Distribution>;
    explicit RoughDielectricBsdf(const Model& model) : model_(model) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        return model_.eval(wi, wo) * std::abs(wi.z);
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override { return model_.pdf(wi, wo); }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        if (wo.z == 0.f) return std::nullopt;
        BsdfSample s;
        s.wi = model_.sample(wo, u1, u2);
        if (s.wi.z == 0.f) return std::nullopt;
        s.pdf = model_.pdf(s.wi, wo);
        if (!(s.pdf > 0.f)) return std::nullopt;
        s.weight = model_.eval(s.wi, wo) * (std::abs(s.wi.z) / s.pdf);
        if (s.wi.z * wo.z < 0.f) s.eta = wo.z > 0.f ? model_.eta : 1.f / model_.eta;
        return s;
    }

  private:
    Model model_;
};

template <class Distribution>
class RoughDielectricMaterial final : public Material {
  public:
    RoughDielectricMaterial(float eta, Roughness roughness, TexturePtr reflectance,
                            TexturePtr transmittance)
        : eta_(eta),
          roughness_(std::move(roughness)),
          reflectance_(std::move(reflectance)),
          transmittance_(std::move(transmittance)) {}

    unsigned flags() const override { return reflects | transmits | has_smooth; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        using Model = RoughDielectric<float, Spectral, Distribution>;
        return scratch.make<RoughDielectricBsdf<Distribution>>(
            Model{roughness_.at<Distribution>(point.uv), eta_, reflectance_->eval(point.uv, w),
                  transmittance_->eval(point.uv, w), roughness_.sampling});
    }
    float rough_boundary_eta() const override {
        const auto is = [](const Texture& t, float value) {
            return t.max() == value && t.mean() == value;
        };
        const bool even = is(*roughness_.alpha_u, roughness_.alpha_u->max()) &&
                          is(*roughness_.alpha_v, roughness_.alpha_v->max());
        return even && is(*reflectance_, 1.f) && is(*transmittance_, 1.f) ? eta_ : 0.f;
    }
    float facet_eta() const override { return eta_; }
    bool is_spectral() const override {
        return reflectance_->is_spectral() || transmittance_->is_spectral();
    }

  private:
    float eta_;
    Roughness roughness_;
    TexturePtr reflectance_, transmittance_;
};

}  // namespace

MaterialPtr make_roughdielectric(const SceneNode& node, BuildContext& context) {
    const float eta = get_relative_index(node, "bk7");
    if (eta == 1.f)
        node.fail(
            fmt::format("'int_ior' and 'ext_ior' of {} are equal, so there is no boundary; "
                        "use <bsdf type=\"null\">",
                        node.describe()));
    Roughness roughness = get_roughness(node, context);
    TexturePtr reflectance = get_reflectance(node, "specular_reflectance", 1.f, context);
    TexturePtr transmittance = get_reflectance(node, "specular_transmittance", 1.f, context);
    if (roughness.ggx)
        return std::make_shared<RoughDielectricMaterial<Ggx<float>>>(
            eta, std::move(roughness), std::move(reflectance), std::move(transmittance));
    return std::make_shared<RoughDielectricMaterial<Beckmann<float>>>(
        eta, std::move(roughness), std::move(reflectance), std::move(transmittance));
}

}  // namespace nacre
