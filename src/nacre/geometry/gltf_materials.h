#pragma once
// What a glTF file says its surfaces are made of, and its triangles by material. glTF 2.0 (Khronos
// 2021) with the extensions KHR_materials_{diffuse_transmission, emissive_strength, ior, specular,
// transmission, volume, volume_scatter} and KHR_texture_transform.
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/geometry/mesh_io.h"

namespace nacre {

/// How a picture is laid on a surface.
struct GltfTexture {
    enum class Wrap { repeat, mirror, clamp };

    int image = -1;       ///< index into GltfObject::images; -1: no texture
    int coordinates = 0;  ///< n of TEXCOORD_n
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;
    Transform to_uv;  ///< of texture coordinates, v pointing down in the picture

    bool laid_on_as(const GltfTexture& other) const;
};

struct GltfMaterial {
    enum class Alpha { opaque, mask, blend };

    std::string name;  ///< "material 3" if the file gives none
    /// What the file says beyond the defaults of the format, in its own words, such as
    /// "metallicFactor 0.5", "baseColorTexture", "KHR_materials_volume: attenuationDistance 2".
    std::vector<std::string> properties;
    bool used = false;  ///< by a primitive of the file

    // Factors and the textures that multiply them, in the format's terms and ranges.
    Vec3f base_color{1.f, 1.f, 1.f};
    float alpha = 1.f, metallic = 1.f, roughness = 1.f;
    GltfTexture base_color_texture;          ///< sRGB colour and alpha
    GltfTexture metallic_roughness_texture;  ///< green: roughness, blue: metallic
    Alpha alpha_mode = Alpha::opaque;
    float alpha_cutoff = 0.5f;
    Vec3f emissive{};  ///< strength included
    GltfTexture emissive_texture;
    float ior = 1.5f, specular = 1.f;
    Vec3f specular_color{1.f, 1.f, 1.f};
    float transmission = 0.f;
    GltfTexture transmission_texture;  ///< red
    float diffuse_transmission = 0.f;
    GltfTexture diffuse_transmission_texture;  ///< alpha
    Vec3f diffuse_transmission_color{1.f, 1.f, 1.f};
    GltfTexture diffuse_transmission_color_texture;
    bool thick = false;  ///< the surface encloses a volume
    Vec3f attenuation_color{1.f, 1.f, 1.f};
    float attenuation_distance = 0.f;  ///< in units of the file's scene; 0: nothing is attenuated
    Vec3f multiscatter_color{};
    float scatter_anisotropy = 0.f;

    /// What of the above the file says in other words, which nacre has no equal of.
    std::vector<std::string> left_out;

    struct NamedTexture {
        const char* name;  ///< the format's
        GltfTexture* texture;
        bool color;  ///< sRGB; else numbers as they are stored
    };
    /// All of them, in the order in which they stand here.
    std::array<NamedTexture, 6> textures();
};

/// A picture as the file holds it: PNG or JPEG. In a file of its own: `path`; else `inside`.
struct GltfImage {
    std::string name;  ///< for messages
    std::filesystem::path path;
    std::string inside;

    std::string bytes() const;  ///< throws InputError if the file cannot be read
};

struct GltfPart {
    std::shared_ptr<Mesh> mesh;
    int material = -1;  ///< index into GltfObject::materials; -1: the format's default material
};

struct GltfObject {
    std::vector<GltfPart> parts;  ///< none is empty
    std::vector<GltfMaterial> materials;
    std::vector<GltfImage> images;
    /// What else than materials the file has and nacre does not take: "cameras", "skins".
    std::vector<std::string> left_out;
    std::vector<std::string> extensions_used, extensions_required;

    bool has_materials() const;  ///< whether any triangle has one
};

/// True for .gltf and .glb, in any case.
bool has_gltf_extension(const std::filesystem::path& path);
/// The default scene, its node transforms and `options` applied. Throws InputError, as load_mesh,
/// and for factors beyond their range.
GltfObject load_gltf(const std::filesystem::path& path, const MeshOptions& options = {});
GltfObject parse_gltf_object(std::string_view bytes, const std::filesystem::path& path,
                             const MeshOptions& options = {});

}  // namespace nacre
