#pragma once
// The builders behind make_material, one a file (<type>.cpp), and what they share. Each is
// called with a node whose type is its own, and reads all parameters that its type knows.
#include "nacre/scene/build.h"

namespace nacre {

MaterialPtr make_blendbsdf(const SceneNode& node, BuildContext& context);
MaterialPtr make_conductor(const SceneNode& node, BuildContext& context);
MaterialPtr make_dielectric(const SceneNode& node, BuildContext& context);
MaterialPtr make_diffuse(const SceneNode& node, BuildContext& context);
MaterialPtr make_difftrans(const SceneNode& node, BuildContext& context);
MaterialPtr make_hk(const SceneNode& node, BuildContext& context);
MaterialPtr make_mask(const SceneNode& node, BuildContext& context);
MaterialPtr make_measured(const SceneNode& node, BuildContext& context);
MaterialPtr make_null(const SceneNode& node, BuildContext& context);
MaterialPtr make_plastic(const SceneNode& node, BuildContext& context);
MaterialPtr make_roughconductor(const SceneNode& node, BuildContext& context);
MaterialPtr make_roughdielectric(const SceneNode& node, BuildContext& context);
MaterialPtr make_roughplastic(const SceneNode& node, BuildContext& context);
MaterialPtr make_sumbsdf(const SceneNode& node, BuildContext& context);
MaterialPtr make_thindielectric(const SceneNode& node, BuildContext& context);
MaterialPtr make_twosided(const SceneNode& node, BuildContext& context);

/// A reflectance model of the list (reflectance/models.h) whose name is the node's type.
MaterialPtr make_reflectance_model(const SceneNode& node, BuildContext& context);

/// The texture of parameter `name`, a reflectance or transmittance: throws unless every value lies
/// in [0, 1], since anything else would make or destroy energy.
TexturePtr get_reflectance(const SceneNode& node, std::string_view name, float otherwise,
                           BuildContext& context);

/// The nested <bsdf> elements, built; throws unless there are between `least` and `most`.
std::vector<MaterialPtr> nested_materials(const SceneNode& node, std::size_t least,
                                          std::size_t most, BuildContext& context);

}  // namespace nacre
