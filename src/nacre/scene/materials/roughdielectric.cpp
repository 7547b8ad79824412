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
class RoughDielectricMaterial final : public Material {
  public:
    RoughDielectricMaterial(float eta, Roughness roughness, TexturePtr reflectance,
                            TexturePtr transmittance)
        : eta_(eta),
          roughness_(std::move(roughness)),
          reflectance_(std::move(reflectance)),
          transmittance_(std::move(transmittance)) {}

    unsigned flags() const override { return reflects | transmits | has_smooth; }
    Spectral eval(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                  const Wavelengths& w) const override {
        return model(at, w).eval(wi, wo) * std::abs(wi.z);
    }
    float pdf(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
              const Wavelengths& w) const override {
        return model(at, w).pdf(wi, wo);
    }
    std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float u1,
                                         Vec2f u2, const Wavelengths& w) const override {
        if (wo.z == 0.f) return std::nullopt;
        const auto m = model(at, w);
        MaterialSample s;
        s.wi = m.sample(wo, u1, u2);
        if (s.wi.z == 0.f) return std::nullopt;
        s.pdf = m.pdf(s.wi, wo);
        if (!(s.pdf > 0.f)) return std::nullopt;
        s.weight = m.eval(s.wi, wo) * (std::abs(s.wi.z) / s.pdf);
        if (s.wi.z * wo.z < 0.f) s.eta = wo.z > 0.f ? eta_ : 1.f / eta_;
        return s;
    }
    float rough_boundary_eta() const override {
        const auto is = [](const Texture& t, float value) {
            return t.max() == value && t.mean() == value;
        };
        const bool even = is(*roughness_.alpha_u, roughness_.alpha_u->max()) &&
                          is(*roughness_.alpha_v, roughness_.alpha_v->max());
        return even && is(*reflectance_, 1.f) && is(*transmittance_, 1.f) ? eta_ : 0.f;
    }
    bool is_spectral() const override {
        return reflectance_->is_spectral() || transmittance_->is_spectral();
    }

  private:
    RoughDielectric<float, Spectral, Distribution> model(const SurfacePoint& at,
                                                         const Wavelengths& w) const {
        return {roughness_.at<Distribution>(at.uv), eta_, reflectance_->eval(at.uv, w),
                transmittance_->eval(at.uv, w), roughness_.sampling};
    }

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
