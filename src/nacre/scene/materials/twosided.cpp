// <bsdf type="twosided">: a material that is black from the inside, made to look the same from both
// sides; of two nested materials the second is on the inside.
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

Vec3f mirrored(const Vec3f& w) { return {w.x, w.y, -w.z}; }

class TwoSided final : public Material {
  public:
    TwoSided(MaterialPtr front, MaterialPtr back)
        : front_(std::move(front)), back_(std::move(back)) {}

    unsigned flags() const override { return front_->flags() | back_->flags(); }
    Spectral eval(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
                  const Wavelengths& w) const override {
        return wo.z < 0.f ? back_->eval(at, mirrored(wo), mirrored(wi), w)
                          : front_->eval(at, wo, wi, w);
    }
    float pdf(const SurfacePoint& at, const Vec3f& wo, const Vec3f& wi,
              const Wavelengths& w) const override {
        return wo.z < 0.f ? back_->pdf(at, mirrored(wo), mirrored(wi), w)
                          : front_->pdf(at, wo, wi, w);
    }
    std::optional<MaterialSample> sample(const SurfacePoint& at, const Vec3f& wo, float u1,
                                         Vec2f u2, const Wavelengths& w) const override {
        if (!(wo.z < 0.f)) return front_->sample(at, wo, u1, u2, w);
        auto s = back_->sample(at, mirrored(wo), u1, u2, w);
        if (s) s->wi = mirrored(s->wi);
        return s;
    }
    bool is_lambertian() const override {
        return front_->is_lambertian() && back_->is_lambertian();
    }
    bool is_spectral() const override { return front_->is_spectral() || back_->is_spectral(); }

  private:
    MaterialPtr front_, back_;
};

}  // namespace

MaterialPtr make_twosided(const SceneNode& node, BuildContext& context) {
    const auto nested = nested_materials(node, 1, 2, context);
    for (std::size_t i = 0; i < nested.size(); ++i)
        if (nested[i]->flags() & (transmits | has_null)) {
            const SceneNode& inner = *node.children_of("bsdf")[i]->node;
            inner.fail(
                fmt::format("{} lets light through and so has two sides already; it cannot "
                            "be nested in {}",
                            inner.describe(), node.describe()));
        }
    return std::make_shared<TwoSided>(nested.front(), nested.back());
}

}  // namespace nacre
