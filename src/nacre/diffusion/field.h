#pragma once
// What a solved field says at any place: inside by linear interpolation between cells, at the
// surface by the same boundary stencil that the solver uses.
#include <span>

#include "nacre/diffusion/problem.h"

namespace nacre {

/// The cells around a place with their weights, which sum to 1; cells that are not there are left
/// out. Empty (all weights 0) where none is.
struct CellMix {
    std::array<std::uint32_t, 8> cell{};
    std::array<double, 8> weight{};
    int count = 0;
};
CellMix cells_around(const CellGrid& grid, const Vec3d& p);

/// phi inside.
BandDoubles fluence(const CellGrid& grid, std::span<const BandDoubles> phi, const Vec3d& p);

/// phi at a place of the surface with unit normal `n`: every cell around goes on along the normal as
/// phi + 2 A D dphi/dn = q has it, (2 A phi_cell + q delta / D) / (2 A + delta / D).
BandDoubles surface_fluence(const CellGrid& grid, const DiffusionMatter& matter,
                            std::span<const BandDoubles> phi, const Vec3d& p, const Vec3d& n,
                            BandDoubles q = BandDoubles(0.));

/// What is given for each cut, at a place of the surface: the mean over the cells around that are
/// cut, by their weights; 0 if `of_cut` is empty.
BandDoubles flux_at(const CellGrid& grid, std::span<const BandDoubles> of_cut, const Vec3d& p);

/// Of volumetric sources: what leaves, per area.
inline BandDoubles exitance(double boundary, BandDoubles phi) {
    return phi * BandDoubles(0.5 / boundary);
}

/// Power that leaves through the surface and that is absorbed inside; with the power put in, the
/// balance that the solver keeps:  in = out + absorbed,  in = sum of `power`, q = 0.
struct EnergyBalance {
    BandDoubles out{0.}, absorbed{0.};
};
EnergyBalance energy_balance(const CellGrid& grid, const DiffusionMatter& matter,
                             const DiffusionProblem& problem, std::span<const BandDoubles> phi,
                             std::span<const BandDoubles> q = {});

}  // namespace nacre
