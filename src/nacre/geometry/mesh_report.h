#pragma once
// Is a mesh the boundary of a solid? A medium inside needs one.
#include <string>

#include "nacre/geometry/mesh.h"

namespace nacre {

/// What `inspect` found. Vertices at exactly the same place count as one, so that seams of texture
/// coordinates and the loose triangles of STL files do not look like holes.
struct MeshReport {
    std::size_t vertices = 0;  ///< distinct places
    std::size_t triangles = 0;
    std::size_t components = 0;          ///< connected through shared vertices
    std::size_t boundary_edges = 0;      ///< edges of one triangle only: the surface is open there
    std::size_t non_manifold_edges = 0;  ///< edges of three triangles or more
    /// Edges of two triangles that run along it in the same direction: one is inside out.
    std::size_t inconsistent_edges = 0;
    /// Triangles without area: left out by the reader, or flat.
    std::size_t degenerate_triangles = 0;
    /// By the divergence theorem; in the cube of the mesh's unit, negative if normals point
    /// inwards. Meaningless for open meshes.
    double volume = 0;
    double area = 0;
    Box3f bounds;

    bool closed() const { return boundary_edges == 0 && non_manifold_edges == 0; }
    bool oriented() const { return inconsistent_edges == 0; }
    bool inside_out() const { return closed() && oriented() && volume < 0; }
    /// A closed, consistently oriented surface with its outside outside.
    bool solid() const { return closed() && oriented() && volume > 0; }
};

MeshReport inspect(const Mesh& mesh);

/// One sentence of what is wrong and what it means, with a medium inside or without; empty if
/// nothing is.
std::string warning(const MeshReport& report, bool has_medium);

}  // namespace nacre
