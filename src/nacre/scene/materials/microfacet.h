#pragma once
// Roughness and metals as parameters of materials.
#include "nacre/reflectance/beckmann.h"
#include "nacre/reflectance/ggx.h"
#include "nacre/scene/materials/types.h"

namespace nacre {

/// The parameters of a rough surface:
///   distribution     beckmann (default), ggx
///   alpha (0.1), or alpha_u and alpha_v   numbers > 0 or textures; u runs along the tangent
///   sample_visible   true: draw the normals that the viewer sees, otherwise all
struct Roughness {
    bool ggx = false;
    TexturePtr alpha_u, alpha_v;
    NormalSampling sampling = NormalSampling::visible;

    /// The distribution at a point. Below 1e-4, where a surface counts as smooth, single precision
    /// no longer resolves the lobe.
    template <class Distribution>
    Distribution at(Vec2f uv) const {
        return {std::max(alpha_u->eval_scalar(uv), 1e-4f),
                std::max(alpha_v->eval_scalar(uv), 1e-4f)};
    }
};
Roughness get_roughness(const SceneNode& node, BuildContext& context);

/// A rough surface that reflects, black from the inside, as a path meets it. `Model` is one of the
/// reflectance models with facets, with one lobe or two.
template <class Model>
class RoughReflectionBsdf final : public Bsdf {
  public:
    explicit RoughReflectionBsdf(const Model& model) : model_(model) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        return model_.eval(wi, wo) * wi.z;
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override { return model_.pdf(wi, wo); }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        if (!(wo.z > 0.f)) return std::nullopt;
        BsdfSample s;
        if constexpr (requires { model_.sample(wo, u1, u2); })
            s.wi = model_.sample(wo, u1, u2);
        else
            s.wi = model_.sample(wo, u2);
        s.pdf = model_.pdf(s.wi, wo);
        if (!(s.pdf > 0.f)) return std::nullopt;
        s.weight = model_.eval(s.wi, wo) * (s.wi.z / s.pdf);
        return s;
    }

  private:
    Model model_;
};

/// The complex index of a metal: `material` (a name of conductor_names(), "none": a perfect mirror)
/// or eta and k (0 and 1).
struct MetalIndex {
    TexturePtr eta, k;
};
MetalIndex get_metal(const SceneNode& node, BuildContext& context);

}  // namespace nacre
