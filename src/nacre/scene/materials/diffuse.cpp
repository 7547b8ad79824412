// <bsdf type="diffuse">: reflectance (0.5). Lambert's law on the outside, black on the inside.
#include "nacre/reflectance/lambert.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class DiffuseBsdf final : public Bsdf {
  public:
    explicit DiffuseBsdf(Spectral reflectance) : model_{reflectance} {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        return model_.eval(wi, wo) * wi.z;
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override { return model_.pdf(wi, wo); }
    BsdfValue eval_pdf(const Vec3f& wi, const Vec3f& wo) const override {
        return {model_.eval(wi, wo) * wi.z, model_.pdf(wi, wo)};
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float, Vec2f u2) const override {
        BsdfSample s;
        s.wi = model_.sample(wo, u2);
        s.pdf = model_.pdf(s.wi, wo);
        if (!(s.pdf > 0.f)) return std::nullopt;
        s.weight = model_.reflectance;
        return s;
    }

  private:
    Lambert<float, Spectral> model_;
};

class Diffuse final : public Material {
  public:
    explicit Diffuse(TexturePtr reflectance) : reflectance_(std::move(reflectance)) {}

    unsigned flags() const override { return reflects | has_smooth; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<DiffuseBsdf>(reflectance_->eval(point.uv, w));
    }
    bool is_lambertian() const override { return true; }
    bool is_spectral() const override { return reflectance_->is_spectral(); }

  private:
    TexturePtr reflectance_;
};

}  // namespace

MaterialPtr make_diffuse(const SceneNode& node, BuildContext& context) {
    return std::make_shared<Diffuse>(get_reflectance(node, "reflectance", 0.5f, context));
}

}  // namespace nacre
