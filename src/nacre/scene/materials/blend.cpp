// <bsdf type="blendbsdf">: a mixture of two materials, as Mitsuba's.
//
//   weight  (0.5)   share of the second, a number or texture within [0, 1]
//   two nested <bsdf>
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class Blend final : public Material {
  public:
    Blend(MaterialPtr first, MaterialPtr second, TexturePtr weight)
        : first_(std::move(first)), second_(std::move(second)), weight_(std::move(weight)) {}

    unsigned flags() const override { return first_->flags() | second_->flags(); }
    Spectral eval(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                  const Wavelengths& w) const override {
        const float t = weight(at);
        return (1.f - t) * first_->eval(at, wo, wi, w) + t * second_->eval(at, wo, wi, w);
    }
    float pdf(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
              const Wavelengths& w) const override {
        const float t = weight(at);
        return (1.f - t) * first_->pdf(at, wo, wi, w) + t * second_->pdf(at, wo, wi, w);
    }
    std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float u1,
                                         Vec2f u2, const Wavelengths& w) const override {
        const float t = weight(at);
        const bool second = u1 < t;
        const float share = second ? t : 1.f - t;
        // The quotient of floats may round up to one.
        const float u = std::min((second ? u1 : u1 - t) / share, 0x1.fffffep-1f);
        auto s = (second ? *second_ : *first_).sample(at, wo, u, u2, w);
        if (!s) return s;
        if (s->delta) {
            s->pdf *= share;  // its weight is power over probability: the share is in both
            return s;
        }
        // A smooth direction may come from either; if it holds for one lane, so does its value.
        s->pdf = pdf(at, wo, s->wi, w);
        if (!(s->pdf > 0.f)) return std::nullopt;
        const Spectral f = eval(at, wo, s->wi, w) / s->pdf;
        s->weight = s->single_wavelength ? Spectral(f[0], 0.f, 0.f, 0.f) : f;
        return s;
    }
    Spectral null_transmission(const SurfacePoint& at, const Vec3f& wo,
                               const Wavelengths& w) const override {
        const float t = weight(at);
        return (1.f - t) * first_->null_transmission(at, wo, w) +
               t * second_->null_transmission(at, wo, w);
    }
    bool is_lambertian() const override {
        return first_->is_lambertian() && second_->is_lambertian();
    }
    bool is_spectral() const override { return first_->is_spectral() || second_->is_spectral(); }

  private:
    float weight(const SurfacePoint& at) const {
        return std::clamp(weight_->eval_scalar(at.uv), 0.f, 1.f);
    }

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
