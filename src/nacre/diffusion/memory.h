#pragma once
// What a diffusion problem takes, before any of it is allocated.
#include <string_view>

#include "nacre/diffusion/cut_cells.h"

namespace nacre {

struct DiffusionMemory {
    double cells = 0.;  ///< about how many hold some of the inside
    double bytes = 0.;  ///< at the most at one time: the grid, the matrices, the vectors of a solve
};

/// Of a closed mesh on a grid of that frame, by the mesh's volume and area.
DiffusionMemory diffusion_memory(const Mesh& mesh, const GridFrame& frame);

/// Throws InputError if that is more than `limit` bytes, with the largest number of cells along the
/// longest side that would do. `option` is what the user calls that number.
void check_memory(const Mesh& mesh, double cells, double limit, std::string_view option);

}  // namespace nacre
