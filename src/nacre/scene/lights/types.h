#pragma once
// The lights one by one, as make_light and make_area_light of build.h know them.
#include "nacre/image/image.h"
#include "nacre/scene/build.h"

namespace nacre {

/// White of Y = 1 (D65), Mitsuba's default of every emission.
SpectrumPtr default_emission();

LightPtr make_point_light(const SceneNode& node, BuildContext& context);
LightPtr make_spot_light(const SceneNode& node, BuildContext& context);
LightPtr make_directional_light(const SceneNode& node, BuildContext& context);
LightPtr make_constant_light(const SceneNode& node, BuildContext& context);
LightPtr make_environment_map(const SceneNode& node, BuildContext& context);

/// What an environment map needs besides its image.
struct EnvironmentPlacement {
    float scale = 1.f;
    Transform to_world;
    float scene_radius = 1.f;  ///< of the scene's bounding sphere, for `power`
};
/// An environment map from an image in memory (light_envmap.cpp explains the mapping). Throws
/// InputError for images smaller than 2 x 3 pixels, pixels that are not finite and transforms that
/// are no rotation; `name` stands for the image in messages. Negative values become 0, with a
/// warning.
LightPtr make_environment_map(const Image& image, const EnvironmentPlacement& placement,
                              const std::string& name, std::vector<std::string>& warnings);

}  // namespace nacre
