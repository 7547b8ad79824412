// <bsdf type="mask">: a material that is there with the share `opacity` (0.5; a number or texture
// within [0, 1]) and lets light pass straight on with the rest. With `cutoff` (within [0, 1]) it is
// there wholly where `opacity` is at least that, and elsewhere not at all (nacre's, as glTF's
// MASK).
#include "nacre/scene/materials/nested.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class MaskedBsdf final : public Bsdf {
  public:
    MaskedBsdf(const NestedBsdf& inner, float opacity) : inner_(inner), opacity_(opacity) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        return opacity_ * inner_->eval(wi, wo);
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        return opacity_ * inner_->pdf(wi, wo);
    }
    BsdfValue eval_pdf(const Vec3f& wi, const Vec3f& wo) const override {
        const BsdfValue value = inner_->eval_pdf(wi, wo);
        return {opacity_ * value.f, opacity_ * value.pdf};
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        if (u1 < opacity_) {
            // The quotient of floats may round up to one.
            const float u = std::min(u1 / opacity_, 0x1.fffffep-1f);
            auto s = inner_->sample(wo, u, u2);
            if (s) s->pdf *= opacity_;
            return s;
        }
        BsdfSample s;
        s.wi = -wo;
        s.weight = Spectral(1.f);
        s.pdf = 1.f - opacity_;
        s.delta = s.null = true;
        return s;
    }
    Spectral null_transmission(const Vec3f& wo) const override {
        return 1.f - opacity_ * (1.f - inner_.null_transmission(wo));
    }

  private:
    NestedBsdf inner_;
    float opacity_;
};

class Masked final : public Material {
  public:
    Masked(MaterialPtr material, TexturePtr opacity, std::optional<float> cutoff)
        : material_(std::move(material)), opacity_(std::move(opacity)), cutoff_(cutoff) {}

    unsigned flags() const override { return material_->flags() | has_null; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<MaskedBsdf>(NestedBsdf(*material_, point, w, scratch), opacity(point));
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
