#pragma once
// One material of a glTF file as nodes.
#include "nacre/scene/gltf/fields.h"

namespace nacre {

/// Adds to the shape its <bsdf>, and the medium inside and the light if there are any. `unit`: as
/// in gltf_shapes.h. What has no equal is added to `material.left_out`.
void add_gltf_material(const NodePtr& shape, const GltfObject& object, GltfMaterial& material,
                       double unit, BuildContext& context);

}  // namespace nacre
