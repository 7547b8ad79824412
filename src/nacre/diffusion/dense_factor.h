#pragma once
// The few cells of the coarsest level, solved directly: L D L^T of each band, in double.
#include "nacre/diffusion/matrix.h"

namespace nacre {

class DenseFactor {
  public:
    DenseFactor() = default;
    explicit DenseFactor(const BandMatrix& matrix);

    std::size_t size() const { return n_; }
    /// x = A^-1 b
    void solve(std::span<const BandFloats> b, std::span<BandFloats> x) const;

  private:
    std::size_t n_ = 0;
    std::vector<BandDoubles> l_;  // row by row; D on the diagonal
};

}  // namespace nacre
