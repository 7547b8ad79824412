#pragma once
// One material of a glTF document. Only for the .cpp files that read glTF.
#include "nacre/geometry/gltf_document.h"
#include "nacre/geometry/gltf_materials.h"

namespace nacre {

GltfMaterial read_gltf_material(const MeshSource& source, const tinygltf::Model& model,
                                std::size_t index);

}  // namespace nacre
