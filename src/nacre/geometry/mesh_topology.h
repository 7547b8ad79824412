#pragma once
// How the triangles of a mesh hang together. Vertices at exactly the same place count as one
// (weld.h), so that seams of texture coordinates and the loose triangles of STL files do not cut
// the surface.
#include <cstdint>
#include <vector>

#include "nacre/geometry/mesh.h"

namespace nacre {

/// Side k of triangle t, 3 t + k, runs from its corner k to corner (k + 1) mod 3.
using SideIndex = std::uint32_t;
constexpr SideIndex kNoSide = ~SideIndex{0};

/// For every side the side of the other triangle at that edge, whichever way it runs; kNoSide at
/// boundaries and where three triangles or more meet. A triangle two of whose corners coincide has
/// no sides: those beside it are each other's neighbours.
std::vector<SideIndex> side_neighbours(const Mesh& mesh);

/// For every triangle the number of its component, from 0 in order of appearance; triangles that
/// share a vertex are in one component.
std::vector<std::uint32_t> triangle_components(const Mesh& mesh);

}  // namespace nacre
