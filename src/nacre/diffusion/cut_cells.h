#pragma once
// Where a closed triangle mesh cuts the cells of a uniform grid, exact to the mesh: every triangle
// is clipped against the cells that it crosses, and the divergence theorem gives the rest. What
// lies beyond a face in its row of cells says how much of the face is inside, so the areas of a
// cell close by construction:  A n = h^2 (a_lower - a_upper)  in each direction (compendium of
// embedded boundaries: Johansen and Colella 1998; Day et al. 1998).
#include <array>
#include <cstdint>
#include <vector>

#include "nacre/geometry/mesh.h"

namespace nacre {

using CellPlace = std::array<std::int32_t, 3>;

/// A grid of cubes. The mesh lies within, at least one empty cell from every side.
struct GridFrame {
    Vec3d origin;   ///< lower corner of cell (0, 0, 0)
    double h = 1.;  ///< length of a cell's edge
    CellPlace n{};  ///< cells in each direction

    /// So many cells along the longest side of the box. `shift` moves the cells by parts of one:
    /// planes of the grid should not lie in faces of the mesh, and the default avoids those that
    /// people model.
    static GridFrame around(const Box3f& box, double cells,
                            Vec3d shift = {0.3183098861837907, 0.3678794411714423,
                                           0.4142135623730950});

    std::size_t count() const { return std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]); }
    std::size_t number(const CellPlace& c) const {
        return (std::size_t(c[2]) * std::size_t(n[1]) + std::size_t(c[1])) * std::size_t(n[0]) +
               std::size_t(c[0]);
    }
    Vec3d lower(const CellPlace& c) const {
        return origin + Vec3d(double(c[0]), double(c[1]), double(c[2])) * h;
    }
    Vec3d center(const CellPlace& c) const { return lower(c) + Vec3d(h, h, h) * 0.5; }
};

/// A cell that the surface passes through.
struct CutCell {
    CellPlace at{};
    double volume = 0.;                ///< share of the cell that is inside
    std::array<double, 6> aperture{};  ///< shares of faces: lower and upper in x, then y, then z
    Vec3d area_vector;                 ///< sum of area times outward normal
    double area = 0.;                  ///< of the surface within
    double offset = 0.;  ///< mean distance of the surface from the cell's centre along its normal
    Vec3d centroid;      ///< of the surface within
};

struct CutSurface {
    GridFrame frame;
    std::vector<CutCell> cells;  ///< in order of their numbers
    /// Row by row in x, the whole cells between them: half-open runs of numbers.
    std::vector<std::array<std::size_t, 2>> inside;
    std::size_t overlaps = 0;  ///< faces that the mesh covers twice or from the wrong side
};

/// Throws InputError if the mesh is not closed or encloses nothing.
CutSurface cut_cells(const Mesh& mesh, const GridFrame& frame);

}  // namespace nacre
