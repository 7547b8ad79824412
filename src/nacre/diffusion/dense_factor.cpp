#include "nacre/diffusion/dense_factor.h"

namespace nacre {

DenseFactor::DenseFactor(const BandMatrix& m) : n_(m.size()), l_(n_ * n_, BandDoubles(0.)) {
    for (std::size_t i = 0; i < n_; ++i) {
        l_[i * n_ + i] = to_double(m.reaction[i]);
        for (std::uint32_t e = m.first[i]; e < m.first[i + 1]; ++e) {
            l_[i * n_ + i] += to_double(m.weight[e]);
            l_[i * n_ + m.neighbour[e]] = -to_double(m.weight[e]);
        }
    }
    for (std::size_t i = 0; i < n_; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            BandDoubles sum = l_[i * n_ + j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= l_[i * n_ + k] * l_[j * n_ + k] * l_[k * n_ + k];
            l_[i * n_ + j] = j < i ? sum / l_[j * n_ + j] : sum;
        }
    }
}

void DenseFactor::solve(std::span<const BandFloats> b, std::span<BandFloats> x) const {
    std::vector<BandDoubles> y(n_);
    for (std::size_t i = 0; i < n_; ++i) {
        y[i] = to_double(b[i]);
        for (std::size_t k = 0; k < i; ++k) y[i] -= l_[i * n_ + k] * y[k];
    }
    for (std::size_t i = n_; i-- > 0;) {
        y[i] /= l_[i * n_ + i];
        for (std::size_t k = i + 1; k < n_; ++k) y[i] -= l_[k * n_ + i] * y[k];
        x[i] = to_float(y[i]);
    }
}

}  // namespace nacre
