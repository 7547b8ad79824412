#pragma once
// M = sum_j g_j h_j^T by least squares over the entries that are known, without or with the
// condition that no factor is negative.
//
// One factor after the other is set to the best for all others, again and again (cyclic coordinate
// descent). Each step solves its part exactly, so the error never rises. Where all entries are
// known, factors of both signs come to the singular value decomposition (partial_svd.h), which is
// the better way there. Non-negative factors:
//
//   A. Cichocki, R. Zdunek, S. Amari 2007, Hierarchical ALS Algorithms for Nonnegative Matrix and 3D
//   Tensor Factorization, ICA (HALS).
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nacre {

/// Terms of a sum, each two vectors of length n.
struct FactorTerms {
    std::vector<std::vector<double>> g, h;
};

class LeastSquaresFactors {
  public:
    /// The matrix is n x n, row by row, 0 where it is not known; `known` has 1 where it is, or is
    /// empty if that is everywhere.
    LeastSquaresFactors(std::span<const double> matrix, std::span<const std::uint8_t> known, int n,
                        bool nonnegative);
    ~LeastSquaresFactors();

    /// Adds terms until there are so many, each begun with what is left of the matrix, then betters
    /// all of them. Non-negative ones are also begun with random numbers, twice; the best is kept.
    void grow_to(int terms);
    FactorTerms terms() const;
    /// Frobenius norm over known entries of what is left, over that of the matrix.
    double relative_error() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace nacre
