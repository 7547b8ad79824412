#pragma once
// Solves a diffusion problem: conjugate gradients with a multigrid cycle before each step, or the
// cycles alone. What is left of the right side is computed in double, so any tolerance above some
// 1e-13 is reached.
#include "nacre/diffusion/multigrid.h"
#include "nacre/math/work.h"

namespace nacre {

struct SolveOptions {
    double tolerance = 1e-8;  ///< of |b - A x| over |b|, in every band
    int most_cycles = 200;
    enum class Method { conjugate_gradients, v_cycles } method = Method::conjugate_gradients;
    bool full_start = true;  ///< begins with a full cycle where x is zero
};

struct SolveReport {
    int cycles = 0;
    /// |b - A x| / |b| at the start and after each cycle, of the worst band.
    std::vector<double> residuals;
    /// The factor that a cycle leaves of the residual: the geometric mean over the cycles after the
    /// first.
    double factor() const;
};

/// Starts from `x`. Throws RunError if the tolerance is not reached, Stopped if `work` says so.
SolveReport solve(Multigrid& multigrid, std::span<const BandDoubles> b, std::vector<BandDoubles>& x,
                  const SolveOptions& options = {}, const Work& work = {});

}  // namespace nacre
