#pragma once
// The builders behind make_texture, one a file (texture_<type>.cpp).
#include "nacre/scene/build.h"

namespace nacre {

TexturePtr make_bitmap(const SceneNode& node, ColorRole role, BuildContext& context);
TexturePtr make_checkerboard(const SceneNode& node, ColorRole role, BuildContext& context);

}  // namespace nacre
