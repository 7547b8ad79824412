#pragma once
// The symmetric matrix of a diffusion problem on cells:
//   (A x)_i = sum_j w_ij (x_i - x_j) + k_i x_i
// w is what flows from cell to cell, k what is absorbed in the cell or leaves it for good. Written
// like this, what leaves a cell arrives in its neighbour to the last bit, in every band.
#include <tbb/parallel_for.h>

#include <cstdint>
#include <span>
#include <vector>

#include "nacre/diffusion/bands.h"

namespace nacre {

struct BandMatrix {
    std::vector<std::uint32_t> first;      ///< of each cell's entries, and the end
    std::vector<std::uint32_t> neighbour;  ///< j
    std::vector<BandFloats> weight;        ///< w_ij > 0
    std::vector<BandFloats> reaction;      ///< k_i
    std::vector<BandFloats> inverse;       ///< 1 / (sum_j w_ij + k_i)
    std::size_t even = 0;  ///< none of the cells before it is another's neighbour, nor of the rest

    std::size_t size() const { return reaction.size(); }
    std::size_t bytes() const;
    /// Fills `inverse`.
    void invert_diagonal();

    /// r = b - A x; returns r r in each band.
    BandDoubles residual(std::span<const BandDoubles> x, std::span<const BandDoubles> b,
                         std::span<BandDoubles> r) const;
    /// y = A x; returns x y.
    BandDoubles multiply(std::span<const BandDoubles> x, std::span<BandDoubles> y) const;
    /// (A x)_i
    template <class Pack>
    Pack row(std::size_t i, std::span<const Pack> x) const;
};

/// Calls `f(begin, end)` for blocks of cells, in parallel.
template <class F>
void for_blocks(std::size_t begin, std::size_t end, F&& f) {
    constexpr std::size_t block = 2048;
    const std::size_t blocks = (end - begin + block - 1) / block;
    tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
        f(begin + b * block, std::min(end, begin + (b + 1) * block));
    });
}

/// The sum of `f(cell)`: the same bits for any number of threads.
template <class F>
BandDoubles sum_over(std::size_t size, F&& f) {
    constexpr std::size_t block = 2048;
    std::vector<BandDoubles> sums((size + block - 1) / block, BandDoubles(0.));
    tbb::parallel_for(std::size_t(0), sums.size(), [&](std::size_t b) {
        BandDoubles sum(0.);
        for (std::size_t i = b * block; i < std::min(size, (b + 1) * block); ++i) sum += f(i);
        sums[b] = sum;
    });
    BandDoubles sum(0.);
    for (const BandDoubles& s : sums) sum += s;
    return sum;
}

template <class Pack>
Pack BandMatrix::row(std::size_t i, std::span<const Pack> x) const {
    const auto as = [](BandFloats a) {
        if constexpr (std::is_same_v<Pack, BandFloats>)
            return a;
        else
            return to_double(a);
    };
    const Pack here = x[i];
    Pack sum = as(reaction[i]) * here;
    for (std::uint32_t e = first[i]; e < first[i + 1]; ++e)
        sum += as(weight[e]) * (here - x[neighbour[e]]);
    return sum;
}

}  // namespace nacre
