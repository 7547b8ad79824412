#pragma once
// What a glTF file says its surfaces are made of.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

struct GltfMaterial {
    std::string name;  ///< "material 3" if the file gives none
    /// What the file says beyond the defaults of the format, in its own words, such as
    /// "metallicFactor 0.5", "baseColorTexture", "KHR_materials_volume: attenuationDistance 2".
    std::vector<std::string> properties;
    bool used = false;  ///< by a primitive of the file
};

struct GltfSummary {
    std::vector<GltfMaterial> materials;
    std::vector<std::string> extensions_used, extensions_required;
};

/// True for .gltf and .glb, in any case.
bool has_gltf_extension(const std::filesystem::path& path);
/// Throws InputError, as load_mesh.
GltfSummary load_gltf_summary(const std::filesystem::path& path);
GltfSummary parse_gltf_summary(std::string_view bytes, const std::filesystem::path& path);

}  // namespace nacre
