#include "nacre/diffusion/multigrid.h"

#include <algorithm>

#include "nacre/diffusion/dense_factor.h"

namespace nacre {
namespace {

// Small enough to be solved directly.
constexpr std::size_t coarsest = 60;

}  // namespace

struct Multigrid::Level {
    BandMatrix matrix;
    Aggregates to_coarse;           // empty on the coarsest level
    std::vector<BandFloats> share;  // times a link's weight: of a correction that comes by it
    std::vector<BandFloats> b, x, r;
    DenseFactor direct;  // on the coarsest level

    Level(BandMatrix m) : matrix(std::move(m)), x(matrix.size()) {}

    /// Between the middles of two aggregates a cell is a quarter of the way, and where resistances
    /// differ as much of it as what light has passed by then: a link counts as it is weak beside
    /// those within the aggregate. So a sliver of a cell at the rim has no say in its neighbours.
    void set_shares() {
        share.resize(matrix.size());
        for_blocks(0, matrix.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                BandFloats within(0.f), strongest(1e-30f), leaving(1e-30f);
                for (std::uint32_t e = matrix.first[i]; e < matrix.first[i + 1]; ++e) {
                    const BandFloats w = matrix.weight[e];
                    strongest = max(strongest, w);
                    if (to_coarse.of[matrix.neighbour[e]] == to_coarse.of[i])
                        within = max(within, w);
                    else
                        leaving += w;
                }
                within = select(within > BandFloats(0.f), within, strongest);
                share[i] = min(BandFloats(0.25f) / within, BandFloats(0.75f) / leaving);
            }
        });
    }

    enum class Half { even, odd };
    void relax(Half half) {
        const std::size_t from = half == Half::even ? 0 : matrix.even,
                          to = half == Half::even ? matrix.even : matrix.size();
        for_blocks(from, to, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                BandFloats sum = b[i];
                for (std::uint32_t e = matrix.first[i]; e < matrix.first[i + 1]; ++e)
                    sum += matrix.weight[e] * x[matrix.neighbour[e]];
                x[i] = sum * matrix.inverse[i];
            }
        });
    }
    /// The first half of the first step, from zero.
    void relax_from_zero() {
        for_blocks(0, matrix.even, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) x[i] = b[i] * matrix.inverse[i];
        });
    }

    /// After a step that ended with the odd cells: those have no residual.
    void residual_of_even() {
        for_blocks(0, matrix.even, [&](std::size_t begin, std::size_t end) {
            const std::span<const BandFloats> from = x;
            for (std::size_t i = begin; i < end; ++i) r[i] = b[i] - matrix.row(i, from);
        });
    }
    void restrict_even(std::vector<BandFloats>& coarse) const {
        for_blocks(0, to_coarse.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                BandFloats sum(0.f);
                for (std::uint32_t m = to_coarse.first[c]; m < to_coarse.first[c + 1]; ++m) {
                    const std::uint32_t i = to_coarse.member[m];
                    const bool even = i < matrix.even;
                    BandFloats away(0.f), come(0.f);
                    for (std::uint32_t e = matrix.first[i]; e < matrix.first[i + 1]; ++e) {
                        const std::uint32_t j = matrix.neighbour[e];
                        if (to_coarse.of[j] == c) continue;
                        if (even)
                            away += matrix.weight[e];
                        else
                            come += matrix.weight[e] * share[j] * r[j];
                    }
                    sum += even ? (BandFloats(1.f) - away * share[i]) * r[i] : come;
                }
                coarse[c] = sum;
            }
        });
    }
    void sum_members(const std::vector<BandFloats>& fine, std::vector<BandFloats>& coarse) const {
        for_blocks(0, to_coarse.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                BandFloats sum(0.f);
                for (std::uint32_t m = to_coarse.first[c]; m < to_coarse.first[c + 1]; ++m)
                    sum += fine[to_coarse.member[m]];
                coarse[c] = sum;
            }
        });
    }
    void prolong(const std::vector<BandFloats>& coarse, bool add) {
        for_blocks(0, matrix.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::uint32_t own = to_coarse.of[i];
                const BandFloats here = coarse[own];
                BandFloats others(0.f);
                for (std::uint32_t e = matrix.first[i]; e < matrix.first[i + 1]; ++e) {
                    const std::uint32_t to = to_coarse.of[matrix.neighbour[e]];
                    if (to != own) others += matrix.weight[e] * (coarse[to] - here);
                }
                const BandFloats value = here + share[i] * others;
                x[i] = add ? x[i] + value : value;
            }
        });
    }
};

Multigrid::Multigrid(BandMatrix matrix, std::vector<CellPlace> place, int sweeps)
    : sweeps_(sweeps) {
    matrix.invert_diagonal();
    levels_.emplace_back(std::move(matrix));
    // Without links nothing is left to join, and a relaxation is exact.
    while (levels_.back().matrix.size() > coarsest && !levels_.back().matrix.neighbour.empty()) {
        Level& fine = levels_.back();
        Aggregates a = aggregates_of(fine.matrix, place);
        place = a.place;
        BandMatrix coarse = coarse_matrix(fine.matrix, a);
        fine.to_coarse = std::move(a);
        fine.set_shares();
        fine.r.resize(fine.matrix.even);
        levels_.emplace_back(std::move(coarse));
    }
    for (Level& l : levels_) l.b.resize(l.matrix.size());
    if (levels_.back().matrix.size() <= coarsest)
        levels_.back().direct = DenseFactor(levels_.back().matrix);
}

Multigrid::~Multigrid() = default;
Multigrid::Multigrid(Multigrid&&) noexcept = default;

const BandMatrix& Multigrid::matrix() const { return levels_.front().matrix; }
std::size_t Multigrid::levels() const { return levels_.size(); }

std::size_t Multigrid::bytes() const {
    std::size_t sum = 0;
    for (const Level& l : levels_)
        sum += l.matrix.bytes() +
               4 * (l.to_coarse.of.capacity() + l.to_coarse.first.capacity() +
                    l.to_coarse.member.capacity()) +
               sizeof(CellPlace) * l.to_coarse.place.capacity() +
               sizeof(BandFloats) *
                   (l.b.capacity() + l.x.capacity() + l.r.capacity() + l.share.capacity());
    return sum;
}

void Multigrid::cycle(std::size_t level) {
    Level& l = levels_[level];
    if (level + 1 == levels_.size()) {
        if (l.direct.size() == l.matrix.size())
            l.direct.solve(l.b, l.x);
        else
            for (const auto half : {Level::Half::even, Level::Half::odd}) l.relax(half);
        return;
    }
    for (int s = 0; s < sweeps_; ++s) {
        if (s == 0)
            l.relax_from_zero();
        else
            l.relax(Level::Half::even);
        l.relax(Level::Half::odd);
    }
    l.residual_of_even();
    l.restrict_even(levels_[level + 1].b);
    cycle(level + 1);
    l.prolong(levels_[level + 1].x, true);
    for (int s = 0; s < sweeps_; ++s) {
        l.relax(Level::Half::odd);
        l.relax(Level::Half::even);
    }
}

void Multigrid::full_cycle(std::span<const BandFloats> b, std::span<BandFloats> x) {
    std::copy(b.begin(), b.end(), levels_[0].b.begin());
    full(0);
    std::copy(levels_[0].x.begin(), levels_[0].x.end(), x.begin());
}

void Multigrid::full(std::size_t level) {
    Level& l = levels_[level];
    if (level + 1 == levels_.size()) return cycle(level);
    l.sum_members(l.b, levels_[level + 1].b);
    const std::vector<BandFloats> b = l.b;
    full(level + 1);
    l.prolong(levels_[level + 1].x, false);
    // A V-cycle for what is left.
    const std::vector<BandFloats> start = l.x;
    const std::span<const BandFloats> from = start;
    for_blocks(0, l.matrix.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) l.b[i] = b[i] - l.matrix.row(i, from);
    });
    cycle(level);
    for_blocks(0, l.matrix.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            l.x[i] += start[i];
            l.b[i] = b[i];
        }
    });
}

void Multigrid::v_cycle(std::span<const BandFloats> b, std::span<BandFloats> x) {
    std::copy(b.begin(), b.end(), levels_[0].b.begin());
    cycle(0);
    std::copy(levels_[0].x.begin(), levels_[0].x.end(), x.begin());
}

}  // namespace nacre
