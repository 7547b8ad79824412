// <bsdf type="blendbsdf">: a mixture of two materials, as Mitsuba's.
//
//   weight  (0.5)   share of the second, a number or texture within [0, 1]
//   two nested <bsdf>
#include "nacre/scene/materials/nested.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class BlendBsdf final : public Bsdf {
  public:
    BlendBsdf(const NestedBsdf& first, const NestedBsdf& second, float weight)
        : first_(first), second_(second), t_(weight) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        return (1.f - t_) * first_->eval(wi, wo) + t_ * second_->eval(wi, wo);
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        return (1.f - t_) * first_->pdf(wi, wo) + t_ * second_->pdf(wi, wo);
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        const bool second = u1 < t_;
        const float share = second ? t_ : 1.f - t_;
        // The quotient of floats may round up to one.
        const float u = std::min((second ? u1 : u1 - t_) / share, 0x1.fffffep-1f);
        auto s = (second ? second_ : first_)->sample(wo, u, u2);
        if (!s) return s;
        if (s->delta) {
            s->pdf *= share;  // its weight is power over probability: the share is in both
            return s;
        }
        return drawn_by_all(*this, *s, wo);
    }
    Spectral null_transmission(const Vec3f& wo) const override {
        return (1.f - t_) * first_.null_transmission(wo) + t_ * second_.null_transmission(wo);
    }

  private:
    NestedBsdf first_, second_;
    float t_;
};

class Blend final : public Material {
  public:
    Blend(MaterialPtr first, MaterialPtr second, TexturePtr weight)
        : first_(std::move(first)), second_(std::move(second)), weight_(std::move(weight)) {}

    unsigned flags() const override { return first_->flags() | second_->flags(); }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<BlendBsdf>(NestedBsdf(*first_, point, w, scratch),
                                       NestedBsdf(*second_, point, w, scratch),
                                       std::clamp(weight_->eval_scalar(point.uv), 0.f, 1.f));
    }
    bool is_lambertian() const override {
        return first_->is_lambertian() && second_->is_lambertian();
    }
    bool is_spectral() const override { return first_->is_spectral() || second_->is_spectral(); }

  private:
    MaterialPtr first_, second_;
    TexturePtr weight_;
};

}  // namespace

MaterialPtr make_blendbsdf(const SceneNode& node, BuildContext& context) {
    const auto nested = nested_materials(node, 2, 2, context);
    return std::make_shared<Blend>(nested[0], nested[1],
                                   get_reflectance(node, "weight", 0.5f, context));
}

}  // namespace nacre
