// <bsdf type="sumbsdf">: the sum of what two materials or more reflect, as fits of several lobes
// give (nacre fit).
//
//   weight1, weight2, ...  (1)   factor of each, a number, colour or texture within [0, 1]
//   two to nine nested <bsdf>
//
// Whether the sum reflects more than it receives is for its author to see to; blendbsdf cannot.
#include "nacre/scene/materials/nested.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

constexpr std::size_t most_parts = 9;

class SumBsdf final : public Bsdf {
  public:
    void add(const NestedBsdf& part, const Spectral& weight) {
        parts_[count_].emplace(part);
        weight_[count_] = weight;
        share_[count_] = std::max(max_lane(weight), 0.f);
        ++count_;
    }
    /// After the last part.
    void finish() {
        float sum = 0.f;
        for (std::size_t i = 0; i < count_; ++i) sum += share_[i];
        for (std::size_t i = 0; i < count_; ++i) share_[i] = sum > 0.f ? share_[i] / sum : 0.f;
    }

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        Spectral f(0.f);
        for (std::size_t i = 0; i < count_; ++i) f += weight_[i] * part(i)->eval(wi, wo);
        return f;
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        float p = 0.f;
        for (std::size_t i = 0; i < count_; ++i)
            if (share_[i] > 0.f) p += share_[i] * part(i)->pdf(wi, wo);
        return p;
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        std::size_t i = 0;
        while (i + 1 < count_ && !(u1 < share_[i])) u1 -= share_[i++];
        if (!(share_[i] > 0.f)) return std::nullopt;
        // The quotient of floats may round up to one.
        auto s = part(i)->sample(wo, std::min(u1 / share_[i], 0x1.fffffep-1f), u2);
        if (!s) return s;
        if (s->delta) {
            s->weight *= weight_[i] / share_[i];
            s->pdf *= share_[i];
            return s;
        }
        return drawn_by_all(*this, *s, wo);
    }
    Spectral null_transmission(const Vec3f& wo) const override {
        Spectral t(0.f);
        for (std::size_t i = 0; i < count_; ++i) t += weight_[i] * part(i).null_transmission(wo);
        return t;
    }

  private:
    const NestedBsdf& part(std::size_t i) const { return *parts_[i]; }

    std::optional<NestedBsdf> parts_[most_parts];
    Spectral weight_[most_parts];
    float share_[most_parts] = {};  ///< of the samples
    std::size_t count_ = 0;
};

class Sum final : public Material {
  public:
    Sum(std::vector<MaterialPtr> parts, std::vector<TexturePtr> weights)
        : parts_(std::move(parts)), weights_(std::move(weights)) {}

    unsigned flags() const override {
        unsigned all = 0;
        for (const MaterialPtr& m : parts_) all |= m->flags();
        return all;
    }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        SumBsdf& sum = scratch.make<SumBsdf>();
        for (std::size_t i = 0; i < parts_.size(); ++i)
            sum.add(NestedBsdf(*parts_[i], point, w, scratch), weights_[i]->eval(point.uv, w));
        sum.finish();
        return sum;
    }
    bool is_lambertian() const override {
        return std::ranges::all_of(parts_, [](const auto& m) { return m->is_lambertian(); });
    }
    bool is_spectral() const override {
        return std::ranges::any_of(parts_, [](const auto& m) { return m->is_spectral(); }) ||
               std::ranges::any_of(weights_, [](const auto& t) { return t->is_spectral(); });
    }

  private:
    std::vector<MaterialPtr> parts_;
    std::vector<TexturePtr> weights_;
};

}  // namespace

MaterialPtr make_sumbsdf(const SceneNode& node, BuildContext& context) {
    auto parts = nested_materials(node, 2, most_parts, context);
    std::vector<TexturePtr> weights;
    for (std::size_t i = 1; i <= parts.size(); ++i)
        weights.push_back(get_reflectance(node, fmt::format("weight{}", i), 1.f, context));
    return std::make_shared<Sum>(std::move(parts), std::move(weights));
}

}  // namespace nacre
