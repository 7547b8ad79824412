// <bsdf type="twosided">: a material that is black from the inside, made to look the same from both
// sides; of two nested materials the second is on the inside.
#include "nacre/scene/materials/nested.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

Vec3f mirrored(const Vec3f& w) { return {w.x, w.y, -w.z}; }

class TwoSidedBsdf final : public Bsdf {
  public:
    TwoSidedBsdf(const NestedBsdf& front, const NestedBsdf& back) : front_(front), back_(back) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        return wo.z < 0.f ? back_->eval(mirrored(wi), mirrored(wo)) : front_->eval(wi, wo);
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        return wo.z < 0.f ? back_->pdf(mirrored(wi), mirrored(wo)) : front_->pdf(wi, wo);
    }
    BsdfValue eval_pdf(const Vec3f& wi, const Vec3f& wo) const override {
        return wo.z < 0.f ? back_->eval_pdf(mirrored(wi), mirrored(wo)) : front_->eval_pdf(wi, wo);
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        if (!(wo.z < 0.f)) return front_->sample(wo, u1, u2);
        auto s = back_->sample(mirrored(wo), u1, u2);
        if (s) s->wi = mirrored(s->wi);
        return s;
    }

  private:
    NestedBsdf front_, back_;
};

class TwoSided final : public Material {
  public:
    TwoSided(MaterialPtr front, MaterialPtr back)
        : front_(std::move(front)), back_(std::move(back)) {}

    unsigned flags() const override { return front_->flags() | back_->flags(); }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        return scratch.make<TwoSidedBsdf>(NestedBsdf(*front_, point, w, scratch),
                                          NestedBsdf(*back_, point, w, scratch));
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
