#include "nacre/peers/mesh.h"

#include <fstream>

#include "nacre/geometry/tessellate.h"
#include "nacre/math/error.h"
#include "nacre/scene/xml/scene_node.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace

const SceneNode& shape_node(const Scene& scene, std::uint32_t shape) {
    std::uint32_t i = 0;
    if (scene.root)
        for (const SceneNode::Child* child : scene.root->children_of("shape"))
            if (i++ == shape) return *child->node;
    throw RunError("the scene does not know what it was built from, so no peer can render it");
}

Mesh peer_mesh(const Scene& scene, std::uint32_t shape, double chord_error) {
    if (const Primitive* primitive = scene.rays.primitive(shape))
        return tessellate(*primitive, chord_error);
    const SceneNode& node = shape_node(scene, shape);
    Mesh mesh = *scene.rays.mesh(shape);
    if (node.get_bool("face_normals", false)) mesh.normals.clear();
    if (node.get_bool("flip_normals", false)) {
        for (Mesh::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
        for (Vec3f& n : mesh.normals) n = -n;
    }
    return mesh;
}

void write_mesh_arrays(const Mesh& mesh, const std::filesystem::path& file) {
    std::string bytes;
    append(bytes, mesh.positions);
    append(bytes, mesh.triangles);
    append(bytes, mesh.normals);
    append(bytes, mesh.uvs);
    write_whole_file(file, bytes);
}

void write_ply(const Mesh& mesh, const std::filesystem::path& file) {
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\n",
        mesh.positions.size());
    if (!mesh.normals.empty()) bytes += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!mesh.uvs.empty()) bytes += "property float u\nproperty float v\n";
    bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                         mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        append(bytes, mesh.positions[i]);
        if (!mesh.normals.empty()) append(bytes, mesh.normals[i]);
        if (!mesh.uvs.empty()) append(bytes, mesh.uvs[i]);
    }
    for (const Mesh::Triangle& t : mesh.triangles) {
        bytes += '\x03';
        append(bytes, t);
    }
    write_whole_file(file, bytes);
}

}  // namespace nacre
