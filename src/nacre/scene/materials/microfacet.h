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

/// The complex index of a metal: `material` (a name of conductor_names(), "none": a perfect mirror)
/// or eta and k (0 and 1).
struct MetalIndex {
    TexturePtr eta, k;
};
MetalIndex get_metal(const SceneNode& node, BuildContext& context);

}  // namespace nacre
