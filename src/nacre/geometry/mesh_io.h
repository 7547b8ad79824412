#pragma once
// Meshes from files.
//
//   .obj          v, vt, vn, f; groups, objects and materials are merged into one mesh
//   .ply          ascii and binary of either byte order; faces or tristrips; normals; u v, s t,
//                 texture_u texture_v or texture_s texture_t
//   .off          text; also with normals, colours (skipped) and texture coordinates: STCNOFF
//   .stl          text and binary; vertices at exactly the same place are welded
//   .gltf .glb    triangles, strips and fans of the default scene, node transforms applied;
//                 sparse accessors too; for materials see gltf_materials.h
//   .serialized   Mitsuba's compressed meshes, versions 3 and 4
//
// Text may begin with a byte order mark and end its lines in LF, CR LF or CR. Polygons are cut into
// triangles that stay within them, concave ones too (mesh_polygon.h). Triangles two of whose
// corners coincide, and faces of fewer than three corners, are left out and counted in
// Mesh::dropped_triangles; triangles that are merely flat stay, since leaving them out would open a
// closed surface (rays never hit them). Normals that are missing, zero or not finite in a mesh that
// has others are computed (compute_normals). Vertices that no face uses stay in position-only
// files.
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "nacre/geometry/mesh.h"
#include "nacre/geometry/transform.h"

namespace nacre {

struct MeshOptions {
    /// Which mesh of a .serialized file, from 0.
    int shape_index = 0;
    /// Replace the texture coordinate v by 1 - v. Default as in Mitsuba: true for OBJ, whose v
    /// points up in the picture, false otherwise.
    std::optional<bool> flip_tex_coords;
    /// Applied to positions and normals. Where it mirrors, triangles are turned round, so that
    /// counter-clockwise stays outside.
    Transform to_world;
};

/// Reads a mesh; the format follows from the file's extension in any case. Throws InputError
/// "FILE[:line]: what is wrong; how to mend it".
std::shared_ptr<Mesh> load_mesh(const std::filesystem::path& path, const MeshOptions& options = {});

/// The same from memory: `path` gives the extension, the name in messages and the folder of a
/// glTF's buffers.
std::shared_ptr<Mesh> parse_mesh(std::string_view bytes, const std::filesystem::path& path,
                                 const MeshOptions& options = {});

}  // namespace nacre
