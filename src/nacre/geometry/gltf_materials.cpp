#include "nacre/geometry/gltf_materials.h"

#include "nacre/geometry/gltf_material_reader.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

bool has_area(const Mesh& mesh) {
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Mesh::Triangle& t) {
        const Point3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]],
                      &c = mesh.positions[t[2]];
        return !(a == b) && !(b == c) && !(c == a);
    });
}

bool any_nonzero(const std::vector<double>& weights) {
    return std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0.; });
}

/// What of the file a picture of it does not show.
std::vector<std::string> left_out(const tinygltf::Model& model) {
    std::vector<std::string> r;
    bool points = false, colors = false, morphs = false, skins = false;
    for (const auto& mesh : model.meshes)
        for (const auto& primitive : mesh.primitives) {
            points |= primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES;
            colors |= primitive.attributes.contains("COLOR_0");
            morphs |= !primitive.targets.empty() && any_nonzero(mesh.weights);
        }
    for (const auto& node : model.nodes) {
        morphs |= any_nonzero(node.weights);
        skins |= node.skin >= 0;
    }
    if (points) r.emplace_back("points and lines");
    if (colors) r.emplace_back("colours of vertices");
    if (morphs) r.emplace_back("morph targets");
    if (skins) r.emplace_back("skins (it stands as modelled)");
    if (!model.animations.empty()) r.emplace_back("animations");
    if (!model.cameras.empty()) r.emplace_back("cameras");
    if (!model.lights.empty()) r.emplace_back("lights");
    return r;
}

/// %20 and the like.
std::string decoded(const std::string& uri) {
    std::string r;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const auto digit = [](char c) {
            return c >= '0' && c <= '9'                     ? c - '0'
                   : (c | 0x20) >= 'a' && (c | 0x20) <= 'f' ? (c | 0x20) - 'a' + 10
                                                            : -1;
        };
        if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 &&
            digit(uri[i + 2]) >= 0) {
            r += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
            i += 2;
        } else {
            r += uri[i];
        }
    }
    return r;
}

GltfImage image_of(const MeshSource& source, const tinygltf::Image& from, std::size_t index) {
    GltfImage r;
    r.inside.assign(from.image.begin(), from.image.end());
    if (r.inside.empty() && !from.uri.empty())
        r.path = source.path.parent_path() / decoded(from.uri);
    r.name = !r.path.empty()      ? r.path.string()
             : !from.name.empty() ? fmt::format("{}: picture '{}'", source.path.string(), from.name)
                                  : fmt::format("{}: picture {}", source.path.string(), index);
    return r;
}

void mark_used(const tinygltf::Model& model, std::vector<GltfMaterial>& materials) {
    for (const auto& mesh : model.meshes)
        for (const auto& primitive : mesh.primitives)
            if (primitive.material >= 0 &&
                static_cast<std::size_t>(primitive.material) < materials.size())
                materials[static_cast<std::size_t>(primitive.material)].used = true;
}

/// The one set of coordinates that the mesh gets: that of the first texture. Textures of another
/// set are left out.
int choose_coordinates(GltfMaterial& m) {
    int chosen = -1;
    for (const auto& [name, texture, color] : m.textures()) {
        if (texture->image < 0) continue;
        if (chosen < 0) chosen = texture->coordinates;
        if (texture->coordinates == chosen) continue;
        m.left_out.push_back(fmt::format("{} (by TEXCOORD_{}, beside others by TEXCOORD_{})", name,
                                         texture->coordinates, chosen));
        *texture = {};
    }
    return std::max(chosen, 0);
}

}  // namespace

bool GltfTexture::laid_on_as(const GltfTexture& o) const {
    return coordinates == o.coordinates && wrap_u == o.wrap_u && wrap_v == o.wrap_v &&
           nearest == o.nearest && to_uv.matrix() == o.to_uv.matrix();
}

std::array<GltfMaterial::NamedTexture, 6> GltfMaterial::textures() {
    return {{{"baseColorTexture", &base_color_texture, true},
             {"metallicRoughnessTexture", &metallic_roughness_texture, false},
             {"emissiveTexture", &emissive_texture, true},
             {"transmissionTexture", &transmission_texture, false},
             {"diffuseTransmissionTexture", &diffuse_transmission_texture, false},
             {"diffuseTransmissionColorTexture", &diffuse_transmission_color_texture, true}}};
}

std::string GltfImage::bytes() const {
    if (path.empty()) return inside;
    try {
        return read_bytes(path);
    } catch (const InputError& error) {
        throw InputError(
            fmt::format("{}; the glTF names it as a texture: put it there, or give the object a "
                        "material of nacre's",
                        error.what()));
    }
}

bool GltfObject::has_materials() const {
    return std::any_of(parts.begin(), parts.end(),
                       [](const GltfPart& part) { return part.material >= 0; });
}

bool has_gltf_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension == ".gltf" || extension == ".glb";
}

GltfObject parse_gltf_object(std::string_view bytes, const std::filesystem::path& path,
                             const MeshOptions& options) {
    const MeshSource source{bytes, path};
    refuse_compressed(source);
    const tinygltf::Model model = parse_gltf(source, true);
    GltfObject r;
    r.extensions_used = model.extensionsUsed;
    r.extensions_required = model.extensionsRequired;
    r.left_out = left_out(model);
    std::vector<int> uv_sets{0};
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        r.materials.push_back(read_gltf_material(source, model, i));
        uv_sets.push_back(choose_coordinates(r.materials.back()));
    }
    mark_used(model, r.materials);
    for (std::size_t i = 0; i < model.images.size(); ++i)
        r.images.push_back(image_of(source, model.images[i], i));
    std::vector<Mesh> meshes = read_gltf_parts(source, model, uv_sets);
    const bool any_area = std::any_of(meshes.begin(), meshes.end(), has_area);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (meshes[i].triangles.empty() || (any_area && !has_area(meshes[i]))) continue;
        finish_mesh(meshes[i], source, options, false);
        r.parts.push_back({std::make_shared<Mesh>(std::move(meshes[i])), static_cast<int>(i) - 1});
    }
    if (r.parts.empty())
        source.fail("has no triangles; nacre renders surfaces, not points, lines or empty files");
    return r;
}

GltfObject load_gltf(const std::filesystem::path& path, const MeshOptions& options) {
    const std::string bytes = read_bytes(path);
    if (bytes.empty()) MeshSource{bytes, path}.fail("is empty; export the mesh again");
    return parse_gltf_object(bytes, path, options);
}

}  // namespace nacre
