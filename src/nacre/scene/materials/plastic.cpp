// <bsdf type="plastic"> and <bsdf type="roughplastic">: a matt base below a clear boundary, smooth
// or rough; black from the inside.
//
//   diffuse_reflectance (0.5)
//   nonlinear (false)               whether colours saturate by scattering between base and boundary
//   int_ior (polypropylene), ext_ior (air)   one index for all wavelengths; see index.h
//   specular_reflectance (1)        a factor without physical meaning
//   distribution, alpha, sample_visible      roughplastic only, alpha a number; see microfacet.h
//
// Samples are shared between mirror and base by the boundary's reflectance and the mean
// reflectances of both.
#include "nacre/optics/fresnel_moments.h"
#include "nacre/reflectance/rough_plastic.h"
#include "nacre/scene/materials/index.h"
#include "nacre/scene/materials/microfacet.h"

namespace nacre {
namespace {

struct PlasticParameters {
    float eta;
    bool nonlinear;
    TexturePtr diffuse, specular;
    float specular_weight;  ///< mean specular reflectance over the sum of both means

    PlasticParameters(const SceneNode& node, BuildContext& context)
        : eta(get_relative_index(node, "polypropylene")),
          nonlinear(node.get_bool("nonlinear", false)),
          diffuse(get_reflectance(node, "diffuse_reflectance", 0.5f, context)),
          specular(get_reflectance(node, "specular_reflectance", 1.f, context)) {
        const float s = specular->mean(), d = diffuse->mean();
        specular_weight = s + d > 0.f ? s / (s + d) : 0.f;
    }
    bool is_spectral() const { return diffuse->is_spectral() || specular->is_spectral(); }
};

class PlasticBsdf final : public Bsdf {
  public:
    PlasticBsdf(const PlasticParameters& parameters, float internal, Vec2f uv, const Wavelengths& w)
        : p_(parameters),
          base_{p_.diffuse->eval(uv, w), p_.eta, internal, p_.nonlinear},
          uv_(uv),
          w_(w) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        return base_.eval(wi, wo) * wi.z;
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        return wo.z > 0.f ? base_.pdf(wi, wo) * (1.f - mirror_probability(wo)) : 0.f;
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        if (!(wo.z > 0.f)) return std::nullopt;
        const float mirror = mirror_probability(wo);
        BsdfSample s;
        if (u1 < mirror) {
            s.wi = {-wo.x, -wo.y, wo.z};
            s.pdf = mirror;
            s.delta = true;
            s.weight = p_.specular->eval(uv_, w_) * (fresnel_dielectric(wo.z, p_.eta) / mirror);
            return s;
        }
        s.wi = base_.sample(wo, u2);
        s.pdf = base_.pdf(s.wi, wo) * (1.f - mirror);
        if (!(s.pdf > 0.f)) return std::nullopt;
        s.weight = base_.eval(s.wi, wo) * (s.wi.z / s.pdf);
        return s;
    }

  private:
    float mirror_probability(const Vec3f& wo) const {
        const float f = fresnel_dielectric(wo.z, p_.eta);
        const float mirror = f * p_.specular_weight, matt = (1.f - f) * (1.f - p_.specular_weight);
        return mirror + matt > 0.f ? mirror / (mirror + matt) : 0.f;
    }

    const PlasticParameters& p_;
    Plastic<float, Spectral> base_;
    Vec2f uv_;
    Wavelengths w_;
};

class PlasticMaterial final : public Material {
  public:
    explicit PlasticMaterial(PlasticParameters parameters)
        : p_(std::move(parameters)),
          internal_(static_cast<float>(diffuse_reflectance_internal(p_.eta))) {}

    unsigned flags() const override { return reflects | has_smooth | has_delta; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<PlasticBsdf>(p_, internal_, point.uv, w);
    }
    bool is_spectral() const override { return p_.is_spectral(); }

  private:
    PlasticParameters p_;
    float internal_;
};

template <class Distribution>
class RoughPlasticMaterial final : public Material {
  public:
    RoughPlasticMaterial(PlasticParameters parameters, Roughness roughness, RoughBoundary boundary)
        : p_(std::move(parameters)), roughness_(std::move(roughness)), boundary_(boundary) {}

    unsigned flags() const override { return reflects | has_smooth; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        using Model = RoughPlastic<Spectral, Distribution>;
        return scratch.make<RoughReflectionBsdf<Model>>(
            Model{roughness_.at<Distribution>(point.uv),
                  {p_.diffuse->eval(point.uv, w), p_.eta, boundary_.internal, p_.nonlinear},
                  p_.specular->eval(point.uv, w),
                  &boundary_,
                  p_.specular_weight,
                  roughness_.sampling});
    }
    bool is_spectral() const override { return p_.is_spectral(); }

  private:
    PlasticParameters p_;
    Roughness roughness_;
    RoughBoundary boundary_;
};

}  // namespace

MaterialPtr make_plastic(const SceneNode& node, BuildContext& context) {
    return std::make_shared<PlasticMaterial>(PlasticParameters(node, context));
}

MaterialPtr make_roughplastic(const SceneNode& node, BuildContext& context) {
    PlasticParameters parameters(node, context);
    for (const char* name : {"alpha_u", "alpha_v"})
        if (node.has(name))
            node.fail_at(name, fmt::format("{} is isotropic; give 'alpha'", node.describe()));
    if (node.child("alpha", "texture"))
        node.fail_at("alpha", fmt::format("'alpha' of {} must be a number: its boundary is "
                                          "tabulated for one roughness",
                                          node.describe()));
    Roughness roughness = get_roughness(node, context);
    const double alpha = std::max(roughness.alpha_u->eval_scalar({}), 1e-4f);
    if (roughness.ggx) {
        const RoughBoundary boundary(Ggx<double>{alpha, alpha}, parameters.eta);
        return std::make_shared<RoughPlasticMaterial<Ggx<float>>>(std::move(parameters),
                                                                  std::move(roughness), boundary);
    }
    const RoughBoundary boundary(Beckmann<double>{alpha, alpha}, parameters.eta);
    return std::make_shared<RoughPlasticMaterial<Beckmann<float>>>(std::move(parameters),
                                                                   std::move(roughness), boundary);
}

}  // namespace nacre
