#pragma once
// Multigrid for diffusion on cells: a few steps of Gauss and Seidel take the rough part of an
// error, and what is left is smooth enough to be found on cells twice as large, and so on
// (Brandt 1977). The transfer of corrections is linear in cells that have their neighbours and
// constant at the rim (Kwak 1999), that of residuals its transpose; smoothing goes even-odd before
// and odd-even after. So a cycle is a symmetric operator, as conjugate gradients want it.
// All bands go through at once, in float: corrections need no more, the solver's residual is double.
#include <memory>

#include "nacre/diffusion/aggregates.h"

namespace nacre {

class Multigrid {
  public:
    /// `sweeps`: steps of Gauss and Seidel before and after.
    Multigrid(BandMatrix matrix, std::vector<CellPlace> place, int sweeps = 3);
    ~Multigrid();
    Multigrid(Multigrid&&) noexcept;

    const BandMatrix& matrix() const;
    /// x: about A^-1 b, by one V-cycle from zero.
    void v_cycle(std::span<const BandFloats> b, std::span<BandFloats> x);
    /// The same by a full cycle: solves on the coarsest level first, and goes down and up from each
    /// finer one.
    void full_cycle(std::span<const BandFloats> b, std::span<BandFloats> x);

    std::size_t levels() const;
    std::size_t bytes() const;

  private:
    struct Level;
    void cycle(std::size_t level);
    void full(std::size_t level);

    std::vector<Level> levels_;
    int sweeps_;
};

}  // namespace nacre
