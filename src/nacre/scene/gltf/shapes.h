#pragma once
// The materials of a glTF file as nodes of a scene. docs/gltf.md says what becomes what.
#include <span>

#include "nacre/geometry/gltf_materials.h"
#include "nacre/scene/build.h"
#include "nacre/scene/xml/write_nodes.h"

namespace nacre {

/// One <shape type="gltf"> for each part, its mesh in `context.meshes`, with a material and, where
/// the file says so, a medium inside and light. `unit` is the length of the scene's unit in the
/// file's; what the pictures will not show is told in one warning.
std::vector<NodePtr> make_gltf_shapes(const GltfObject& object, const std::string& name,
                                      double unit, BuildContext& context);

/// The tree with every <shape type="gltf"> that has no material, medium or light of its own
/// replaced by shapes of the file's materials; the same tree if there is none.
SceneNodePtr with_gltf_shapes(const SceneNodePtr& root, BuildContext& context);

}  // namespace nacre
