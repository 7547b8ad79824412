// <bsdf type="mask">: a material that is there with the share `opacity` (0.5; a number or texture
// within [0, 1]) and lets light pass straight on with the rest. With `cutoff` (within [0, 1]) it is
// there wholly where `opacity` is at least that, and elsewhere not at all (nacre's, as glTF's
// MASK).
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class Masked final : public Material {
  public:
    Masked(MaterialPtr material, TexturePtr opacity, std::optional<float> cutoff)
        : material_(std::move(material)), opacity_(std::move(opacity)), cutoff_(cutoff) {}

    unsigned flags() const override { return material_->flags() | has_null; }
    Spectral eval(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                  const Wavelengths& w) const override {
        return opacity(at) * material_->eval(at, wo, wi, w);
    }
    float pdf(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
              const Wavelengths& w) const override {
        return opacity(at) * material_->pdf(at, wo, wi, w);
    }
    std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float u1,
                                         Vec2f u2, const Wavelengths& w) const override {
        const float there = opacity(at);
        if (u1 < there) {
            // The quotient of floats may round up to one.
            const float u = std::min(u1 / there, 0x1.fffffep-1f);
            auto s = material_->sample(at, wo, u, u2, w);
            if (s) s->pdf *= there;
            return s;
        }
        MaterialSample s;
        s.wi = -wo;
        s.weight = Spectral(1.f);
        s.pdf = 1.f - there;
        s.delta = s.null = true;
        return s;
    }
    Spectral null_transmission(const SurfacePoint& at, const Vec3f& wo,
                               const Wavelengths& w) const override {
        return 1.f - opacity(at) * (1.f - material_->null_transmission(at, wo, w));
    }
    bool is_lambertian() const override { return material_->is_lambertian(); }
    bool is_spectral() const override { return material_->is_spectral(); }

  private:
    float opacity(const SurfacePoint& at) const {
        const float value = opacity_->eval_scalar(at.uv);
        if (cutoff_) return value >= *cutoff_ ? 1.f : 0.f;
        return std::clamp(value, 0.f, 1.f);
    }

    MaterialPtr material_;
    TexturePtr opacity_;
    std::optional<float> cutoff_;
};

}  // namespace

MaterialPtr make_mask(const SceneNode& node, BuildContext& context) {
    std::optional<float> cutoff;
    if (node.has("cutoff")) cutoff = float(node.get_float_in("cutoff", 0.5, 0, 1));
    return std::make_shared<Masked>(nested_materials(node, 1, 1, context).front(),
                                    get_reflectance(node, "opacity", 0.5f, context), cutoff);
}

}  // namespace nacre
