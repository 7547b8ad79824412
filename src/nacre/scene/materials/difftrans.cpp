// <bsdf type="difftrans">: a surface that passes light on to its other side in all directions
// alike, such as a leaf or paper.
//
//   transmittance  (0.5)    share that is passed on, a colour or texture within [0, 1]
//   coat, f0       (0, 0.04)  weight and normal reflectance of a boundary above, through which the
//                           passed light goes: Schlick's reflectance, coupled as in P. Shirley et
//                           al. 1997 (reflectance/metallic_roughness.h)
//   a nested <bsdf>         what it reflects, the same from both sides; none: nothing
//
// BTDF: transmittance/pi (1 - F(wi.z)) (1 - F(wo.z)) / (1 - coat (f0 + (1 - f0)/21)).
#include <numbers>

#include "nacre/math/warp.h"
#include "nacre/optics/fresnel.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

/// `w` as it is seen from the side of `wo`.
Vec3f outside(const Vec3f& wo, const Vec3f& w) { return wo.z < 0.f ? Vec3f{w.x, w.y, -w.z} : w; }

class DiffuseTransmitterBsdf final : public Bsdf {
  public:
    /// `reflection` may be null. `share` is the probability to pass on.
    DiffuseTransmitterBsdf(Spectral transmittance, float scale, float coat, float f0, float share,
                           const Bsdf* reflection)
        : transmittance_(transmittance),
          reflection_(reflection),
          coat_(coat),
          f0_(f0),
          scale_(scale),
          share_(share) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        if (wo.z * wi.z < 0.f)
            return transmittance_ * (scale_ * through(wo.z) * through(wi.z) * std::abs(wi.z));
        return reflection_ ? reflection_->eval(outside(wo, wi), outside(wo, wo)) : Spectral(0.f);
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        if (wo.z * wi.z < 0.f) return share_ * std::numbers::inv_pi_v<float> * std::abs(wi.z);
        return reflection_ ? (1.f - share_) * reflection_->pdf(outside(wo, wi), outside(wo, wo))
                           : 0.f;
    }
    BsdfValue eval_pdf(const Vec3f& wi, const Vec3f& wo) const override {
        if (wo.z * wi.z < 0.f || !reflection_) return {eval(wi, wo), pdf(wi, wo)};
        const BsdfValue value = reflection_->eval_pdf(outside(wo, wi), outside(wo, wo));
        return {value.f, (1.f - share_) * value.pdf};
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        if (wo.z == 0.f) return std::nullopt;
        if (u1 < share_) {
            BsdfSample s;
            s.wi = square_to_cosine_hemisphere(u2);
            if (wo.z > 0.f) s.wi.z = -s.wi.z;
            s.pdf = pdf(s.wi, wo);
            if (!(s.pdf > 0.f)) return std::nullopt;
            s.weight = eval(s.wi, wo) / s.pdf;
            return s;
        }
        const float u = std::min((u1 - share_) / (1.f - share_), 0x1.fffffep-1f);
        auto s = reflection_->sample(outside(wo, wo), u, u2);
        if (!s) return s;
        s->wi = outside(wo, s->wi);
        s->pdf *= 1.f - share_;
        s->weight = s->weight / (1.f - share_);
        return s;
    }

  private:
    float through(float cosine) const {
        return 1.f - coat_ * fresnel_schlick(std::abs(cosine), f0_);
    }

    Spectral transmittance_;
    const Bsdf* reflection_;
    float coat_, f0_, scale_, share_;
};

class DiffuseTransmitter final : public Material {
  public:
    DiffuseTransmitter(TexturePtr transmittance, float coat, float f0, MaterialPtr reflection)
        : transmittance_(std::move(transmittance)),
          reflection_(std::move(reflection)),
          coat_(coat),
          f0_(f0),
          scale_(std::numbers::inv_pi_v<float> / (1.f - coat * (f0 + (1.f - f0) / 21.f))) {}

    unsigned flags() const override {
        return transmits | has_smooth | (reflection_ ? reflection_->flags() : 0u);
    }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<DiffuseTransmitterBsdf>(
            transmittance_->eval(point.uv, w), scale_, coat_, f0_, share(point),
            reflection_ ? &reflection_->at(point, w, scratch) : nullptr);
    }
    bool is_spectral() const override {
        return transmittance_->is_spectral() || (reflection_ && reflection_->is_spectral());
    }

  private:
    /// With which probability to pass on; both are tried wherever both may be.
    float share(const SurfacePoint& at) const {
        return reflection_ ? std::clamp(transmittance_->eval_scalar(at.uv), 0.1f, 0.9f) : 1.f;
    }

    TexturePtr transmittance_;
    MaterialPtr reflection_;
    float coat_, f0_, scale_;
};

}  // namespace

MaterialPtr make_difftrans(const SceneNode& node, BuildContext& context) {
    const auto nested = nested_materials(node, 0, 1, context);
    if (!nested.empty() && nested[0]->flags() & (transmits | has_null)) {
        const SceneNode& inner = *node.children_of("bsdf")[0]->node;
        inner.fail(fmt::format("{} lets light through by itself; {} takes a reflection",
                               inner.describe(), node.describe()));
    }
    return std::make_shared<DiffuseTransmitter>(
        get_reflectance(node, "transmittance", 0.5f, context),
        float(node.get_float_in("coat", 0, 0, 1)), float(node.get_float_in("f0", 0.04, 0, 0.99)),
        nested.empty() ? nullptr : nested.front());
}

}  // namespace nacre
