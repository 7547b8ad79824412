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
    Spectral eval(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                  const Wavelengths& w) const override {
        if (wo.z * wi.z < 0.f)
            return transmittance_->eval(at.uv, w) *
                   (scale_ * through(wo.z) * through(wi.z) * std::abs(wi.z));
        return reflection_ ? reflection_->eval(at, outside(wo, wo), outside(wo, wi), w)
                           : Spectral(0.f);
    }
    float pdf(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
              const Wavelengths& w) const override {
        const float t = share(at);
        if (wo.z * wi.z < 0.f) return t * std::numbers::inv_pi_v<float> * std::abs(wi.z);
        return reflection_ ? (1.f - t) * reflection_->pdf(at, outside(wo, wo), outside(wo, wi), w)
                           : 0.f;
    }
    std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float u1,
                                         Vec2f u2, const Wavelengths& w) const override {
        if (wo.z == 0.f) return std::nullopt;
        const float t = share(at);
        if (u1 < t) {
            MaterialSample s;
            s.wi = square_to_cosine_hemisphere(u2);
            if (wo.z > 0.f) s.wi.z = -s.wi.z;
            s.pdf = pdf(at, wo, s.wi, w);
            if (!(s.pdf > 0.f)) return std::nullopt;
            s.weight = eval(at, wo, s.wi, w) / s.pdf;
            return s;
        }
        const float u = std::min((u1 - t) / (1.f - t), 0x1.fffffep-1f);
        auto s = reflection_->sample(at, outside(wo, wo), u, u2, w);
        if (!s) return s;
        s->wi = outside(wo, s->wi);
        s->pdf *= 1.f - t;
        s->weight = s->weight / (1.f - t);
        return s;
    }
    bool is_spectral() const override {
        return transmittance_->is_spectral() || (reflection_ && reflection_->is_spectral());
    }

  private:
    /// `w` as it is seen from the side of `wo`.
    static Vec3f outside(const Vec3f& wo, const Vec3f& w) {
        return wo.z < 0.f ? Vec3f{w.x, w.y, -w.z} : w;
    }
    float through(float cosine) const {
        return 1.f - coat_ * fresnel_schlick(std::abs(cosine), f0_);
    }
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
