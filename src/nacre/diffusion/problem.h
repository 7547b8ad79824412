#pragma once
// The diffusion equation on cells,
//   div(D grad phi) - sigma_a phi = -Q   inside,     phi + 2 A D dphi/dn = q   at the surface,
// as a symmetric matrix: plain differences of cell centres times the face's share that is inside,
// and what a cell's surface lets out by one point,
//   area (phi_cell - q) / (2 A + delta / D)
// with delta the distance from the cell's centre to its surface along the normal, negative where the
// centre lies outside. That is second order in the largest error, symmetric, and positive definite
// while 2 A + delta / D > 0 (Bochkov and Gibou 2019); it holds whenever h < 1.15 z_b, z_b = 2 A D.
// Beyond, delta is kept above -z_b / 2, first order there, and how often is told. At jumps of D a
// face has the harmonic mean.
#include "nacre/diffusion/cell_grid.h"
#include "nacre/diffusion/matrix.h"

namespace nacre {

/// What the inside is made of, each list as long as there are cells or one long if it is the same
/// everywhere. Lengths in the grid's unit. Unused lanes must repeat a used one.
struct DiffusionMatter {
    std::vector<BandFloats> diffusion;   ///< D > 0 of each cell
    std::vector<BandFloats> absorption;  ///< sigma_a >= 0
    /// A > 0 of the boundary: (1 + Fdr) / (1 - Fdr) or another form; 1 without refraction.
    double boundary = 1.;

    BandFloats diffusion_at(std::size_t cell) const {
        return diffusion[diffusion.size() == 1 ? 0 : cell];
    }
    BandFloats absorption_at(std::size_t cell) const {
        return absorption[absorption.size() == 1 ? 0 : cell];
    }
};

/// (2 A + delta / D) of a cell's surface, and whether delta had to be clamped in a band.
struct Resistance {
    BandDoubles value;
    bool clamped;
};
Resistance boundary_resistance(double boundary, double offset, BandFloats diffusion);

struct DiffusionProblem {
    BandMatrix matrix;
    std::vector<BandFloats> conductance;  ///< area / (2 A + delta / D) of each cut
    std::size_t clamped = 0;              ///< cuts whose delta was clamped in a band
};

/// Throws InputError for a D that is not positive and finite, or a sigma_a that is negative.
DiffusionProblem make_problem(const CellGrid& grid, const DiffusionMatter& matter);

/// The right side: `power` is Q times volume of each cell (empty: none), `q` of each cut (empty: 0).
std::vector<BandDoubles> right_side(const CellGrid& grid, const DiffusionProblem& problem,
                                    std::span<const BandDoubles> power,
                                    std::span<const BandDoubles> q);

}  // namespace nacre
