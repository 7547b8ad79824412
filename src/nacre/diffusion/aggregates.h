#pragma once
// How the cells of one level of multigrid join to those of the next: two by two by two, but only
// those that are connected within their block. Where a thin part or a gap breaks a block up, each
// piece goes on as a cell of its own, so that light never leaks across a gap on a coarse level and
// no part gets lost (as algebraic multigrid by aggregation, with the grid's blocks as aggregates).
#include "nacre/diffusion/cut_cells.h"
#include "nacre/diffusion/matrix.h"

namespace nacre {

struct Aggregates {
    std::vector<std::uint32_t> of;      ///< the coarse cell of each fine one
    std::vector<std::uint32_t> first;   ///< of the fine cells of each coarse one, and the end
    std::vector<std::uint32_t> member;  ///< those fine cells
    std::vector<CellPlace> place;       ///< of coarse cells: even ones first
    std::size_t even = 0;

    std::size_t size() const { return place.size(); }
};

Aggregates aggregates_of(const BandMatrix& fine, std::span<const CellPlace> place);

/// The matrix between aggregates. Cells are now twice as far from each other, so of the sum of the
/// weights between two aggregates half is left.
BandMatrix coarse_matrix(const BandMatrix& fine, const Aggregates& aggregates);

}  // namespace nacre
