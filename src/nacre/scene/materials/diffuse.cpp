// <bsdf type="diffuse">: reflectance (0.5). Lambert's law on the outside, black on the inside.
#include "nacre/reflectance/lambert.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class Diffuse final : public Material {
  public:
    explicit Diffuse(TexturePtr reflectance) : reflectance_(std::move(reflectance)) {}

    unsigned flags() const override { return reflects | has_smooth; }
    Spectral eval(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                  const Wavelengths& w) const override {
        const Lambert<float, Spectral> model{reflectance_->eval(at.uv, w)};
        return model.eval(wi, wo) * wi.z;
    }
    float pdf(const SurfacePoint&, const Vec3f& wo, const Vec3f& wi,
              const Wavelengths&) const override {
        return Lambert<float>{}.pdf(wi, wo);
    }
    std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float, Vec2f u2,
                                         const Wavelengths& w) const override {
        const Lambert<float> model{};
        MaterialSample s;
        s.wi = model.sample(wo, u2);
        s.pdf = model.pdf(s.wi, wo);
        if (!(s.pdf > 0.f)) return std::nullopt;
        s.weight = reflectance_->eval(at.uv, w);
        return s;
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
