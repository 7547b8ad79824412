#include "nacre/diffusion/system.h"

namespace nacre {
namespace {

std::vector<CellPlace> places_of(const CellGrid& grid) {
    std::vector<CellPlace> places(grid.size());
    for (std::size_t c = 0; c < grid.size(); ++c) places[c] = grid.place(c);
    return places;
}

}  // namespace

DiffusionSystem::DiffusionSystem(std::shared_ptr<const CellGrid> grid, DiffusionMatter matter)
    : grid_(std::move(grid)),
      matter_(std::move(matter)),
      problem_(make_problem(*grid_, matter_)),
      multigrid_(std::move(problem_.matrix), places_of(*grid_)) {}

std::size_t DiffusionSystem::bytes() const {
    return grid_->bytes() + multigrid_.bytes() +
           sizeof(BandFloats) * (matter_.diffusion.capacity() + matter_.absorption.capacity() +
                                 problem_.conductance.capacity());
}

SolveReport DiffusionSystem::solve(std::span<const BandDoubles> power,
                                   std::span<const BandDoubles> q, std::vector<BandDoubles>& phi,
                                   const SolveOptions& options, const Work& work) {
    return nacre::solve(multigrid_, right_side(*grid_, problem_, power, q), phi, options, work);
}

}  // namespace nacre
