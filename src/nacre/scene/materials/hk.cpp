// <bsdf type="hk">: a flat layer that scatters light once. P. Hanrahan and W. Krueger 1993,
// Reflection from Layered Surfaces due to Subsurface Scattering, SIGGRAPH 93; the parameters are
// those of the plugin of that name in Mitsuba 0.6.
//
//   material (skin1)      a measured medium, or instead of it
//   sigma_s, sigma_a      scattering and absorption, mm^-1, or
//   sigma_t, albedo       extinction, mm^-1 (1), and single-scattering albedo (0.75)
//   thickness (1)         mm, whatever the scene's unit of length; may be infinite
//   <phase> (isotropic)
//   int_ior, ext_ior (vacuum)  equal: no boundaries; else smooth boundaries on both sides
//
// Reflects and transmits; what is not scattered goes straight on, so shadow rays pass. With
// boundaries the first surface mirrors too. Light that a boundary turns back inside is lost, as is
// light scattered more than once, so the layer is darker than a real one. See
// layers/hanrahan_krueger.h.
#include "nacre/layers/hanrahan_krueger.h"
#include "nacre/optics/phase.h"
#include "nacre/scene/materials/index.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

class HanrahanKruegerBsdf final : public Bsdf {
  public:
    using Slab = HanrahanKrueger<float, Spectral, PhaseFunction>;
    HanrahanKruegerBsdf(const Slab& slab, const Wavelengths& w) : slab_(slab), w_(w) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        return slab_.eval(wi, wo) * std::abs(wi.z);
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        return choose(wo).scattered * slab_.pdf(wi, wo);
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        const Choice choice = choose(wo);
        BsdfSample s;
        if (u1 < choice.scattered) {
            s.wi = slab_.sample(wo, u2);
            s.pdf = choice.scattered * slab_.pdf(s.wi, wo);
            if (!(s.pdf > 0.f)) return std::nullopt;
            s.weight = slab_.eval(s.wi, wo) * (std::abs(s.wi.z) / s.pdf);
            return s;
        }
        s.delta = true;
        if (u1 < choice.scattered + choice.passed) {
            s.wi = -wo;
            s.pdf = choice.passed;
            s.weight = slab_.unscattered(wo.z) / s.pdf;
            s.null = true;
            return s;
        }
        if (!(choice.mirrored > 0.f)) return std::nullopt;
        s.wi = {-wo.x, -wo.y, wo.z};
        s.pdf = choice.mirrored;
        s.weight = Spectral(slab_.specular(wo.z) / s.pdf);
        return s;
    }
    Spectral null_transmission(const Vec3f& wo) const override { return slab_.unscattered(wo.z); }

  private:
    /// Probabilities of what `sample` draws; they sum to 1 unless nothing comes back at all.
    struct Choice {
        float scattered, passed, mirrored;
    };
    /// In proportion to the power of each part; for the scattered part an upper bound, all that is
    /// scattered at least once.
    Choice choose(const Vec3f& wo) const {
        const float mirrored = slab_.specular(wo.z), enters = 1.f - mirrored;
        const Spectral through = slab_.unscattered(wo.z);
        const float passed = mean(through, w_);
        const float scattered = mean(slab_.albedo * (Spectral(enters) - through), w_);
        const float all = mirrored + passed + scattered;
        if (!(all > 0.f)) return {0.f, 0.f, 0.f};
        return {scattered / all, passed / all, mirrored / all};
    }

    Slab slab_;
    Wavelengths w_;
};

class HanrahanKruegerLayer final : public Material {
  public:
    HanrahanKruegerLayer(MediumPtr medium, float thickness, float eta)
        : medium_(std::move(medium)), thickness_(thickness), eta_(eta) {}

    unsigned flags() const override {
        return reflects | transmits | has_smooth | has_null | (eta_ == 1.f ? 0u : has_delta);
    }
    const Bsdf& at(const SurfacePoint&, const Wavelengths& w, BsdfScratch& scratch) const override {
        const Spectral sigma_t = medium_->sigma_t->eval(w);
        const Spectral clear(0.f);
        // A clear layer stays clear however thick it is.
        const HanrahanKruegerBsdf::Slab slab{medium_->albedo->eval(w),
                                             select(sigma_t > clear, sigma_t * thickness_, clear),
                                             medium_->phase, eta_};
        return scratch.make<HanrahanKruegerBsdf>(slab, w);
    }
    bool is_spectral() const override { return medium_->is_spectral(); }

  private:
    MediumPtr medium_;
    float thickness_, eta_;
};

/// The coefficients and the phase function, by the reader of <medium type="homogeneous">.
MediumPtr read_medium(const SceneNode& node) {
    SceneNode medium;
    medium.type = "homogeneous";
    medium.location = node.location;
    const auto take = [&](std::string_view name) {
        for (const SceneValue& v : node.values)
            if (v.name == name) medium.values.push_back(v);
    };
    // Asked for here, so that a value of the wrong type is reported of this node.
    for (const char* name : {"sigma_s", "sigma_a", "sigma_t", "albedo"})
        if (node.get_color(name)) take(name);
    if (node.has("material") && !node.get_string("material").empty()) take("material");
    if (medium.values.empty())
        medium.values.push_back({"material", "string", std::string("skin1"), node.location});
    for (const SceneNode::Child* phase : node.children_of("phase"))
        medium.children.push_back(*phase);
    BuildContext own;  // its own: coefficients stay per mm, and the node does not outlive the call
    return make_medium(medium, own);
}

}  // namespace

MaterialPtr make_hk(const SceneNode& node, BuildContext&) {
    const MediumPtr medium = read_medium(node);
    const double thickness = node.get_float("thickness", 1.);
    if (!(thickness > 0.))
        node.fail_at("thickness", fmt::format("'thickness' of {} must be positive; got {}",
                                              node.describe(), thickness));
    const RelativeIndex index(node, "vacuum", "vacuum");
    if (index.is_dispersive())
        node.fail(
            fmt::format("{} takes one index of refraction for all wavelengths; only smooth "
                        "dielectrics disperse light",
                        node.describe()));
    return std::make_shared<HanrahanKruegerLayer>(medium, static_cast<float>(thickness),
                                                  index.nominal());
}

}  // namespace nacre
