#include "nacre/diffusion/matrix.h"

namespace nacre {

std::size_t BandMatrix::bytes() const {
    return 4 * (first.capacity() + neighbour.capacity()) +
           sizeof(BandFloats) * (weight.capacity() + reaction.capacity() + inverse.capacity());
}

void BandMatrix::invert_diagonal() {
    inverse.resize(size());
    for_blocks(0, size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            BandFloats sum = reaction[i];
            for (std::uint32_t e = first[i]; e < first[i + 1]; ++e) sum += weight[e];
            inverse[i] = BandFloats(1.f) / sum;
        }
    });
}

BandDoubles BandMatrix::residual(std::span<const BandDoubles> x, std::span<const BandDoubles> b,
                                 std::span<BandDoubles> r) const {
    return sum_over(size(), [&](std::size_t i) {
        r[i] = b[i] - row(i, x);
        return r[i] * r[i];
    });
}

BandDoubles BandMatrix::multiply(std::span<const BandDoubles> x, std::span<BandDoubles> y) const {
    return sum_over(size(), [&](std::size_t i) {
        y[i] = row(i, x);
        return x[i] * y[i];
    });
}

}  // namespace nacre
