#pragma once
// A diffusion problem ready to be solved for one light after the other: matter and shape are kept,
// and a solution under one light is a good start under the next.
#include "nacre/diffusion/field.h"
#include "nacre/diffusion/solver.h"

namespace nacre {

class DiffusionSystem {
  public:
    /// Problems of one shape share its grid.
    DiffusionSystem(std::shared_ptr<const CellGrid> grid, DiffusionMatter matter);
    DiffusionSystem(CellGrid grid, DiffusionMatter matter)
        : DiffusionSystem(std::make_shared<const CellGrid>(std::move(grid)), std::move(matter)) {}

    const CellGrid& grid() const { return *grid_; }
    const DiffusionMatter& matter() const { return matter_; }
    /// Cuts whose distance from the surface was clamped (problem.h).
    std::size_t clamped() const { return problem_.clamped; }
    std::size_t bytes() const;  ///< the grid included

    /// phi of each cell for `power` of each cell and `q` of each cut, empty where there is none.
    /// Starts from `phi`, which may be empty. Throws as nacre::solve.
    SolveReport solve(std::span<const BandDoubles> power, std::span<const BandDoubles> q,
                      std::vector<BandDoubles>& phi, const SolveOptions& options = {},
                      const Work& work = {});
    EnergyBalance balance(std::span<const BandDoubles> phi,
                          std::span<const BandDoubles> q = {}) const {
        return energy_balance(*grid_, matter_, problem_, phi, q);
    }

  private:
    std::shared_ptr<const CellGrid> grid_;
    DiffusionMatter matter_;
    DiffusionProblem problem_;  // without its matrix, which is the multigrid's
    Multigrid multigrid_;
};

}  // namespace nacre
