#pragma once
// The surfaces of a scene as triangles in world space, and the files in which peers get them.
#include <filesystem>

#include "nacre/geometry/mesh.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// The <shape> that shape i of the scene was built from; throws RunError if the scene does not know
/// what it was built from.
const SceneNode& shape_node(const Scene& scene, std::uint32_t shape);

/// Shape i as a mesh, counter-clockwise seen from its outside, flip_normals applied; with normals
/// only if it is smooth. Spheres, disks and cylinders are tessellated to `chord_error` (see
/// geometry/tessellate.h).
Mesh peer_mesh(const Scene& scene, std::uint32_t shape, double chord_error = 2e-4);

/// Arrays as they lie in memory, one after the other: positions (3 floats a vertex), triangles (3
/// unsigned 32-bit integers), and normals (3 floats a vertex) and texture coordinates (2 floats) if
/// the mesh has them. Throws RunError if the file cannot be written.
void write_mesh_arrays(const Mesh& mesh, const std::filesystem::path& file);
/// Binary PLY, little-endian, with normals and `u`, `v` if the mesh has them.
void write_ply(const Mesh& mesh, const std::filesystem::path& file);

}  // namespace nacre
