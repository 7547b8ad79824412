#include "nacre/diffusion/aggregates.h"

#include <algorithm>
#include <numeric>

namespace nacre {
namespace {

/// Numbers of the blocks of two by two by two cells in a box around all.
struct Blocks {
    CellPlace lower{}, n{1, 1, 1};

    explicit Blocks(std::span<const CellPlace> place) {
        if (place.empty()) return;
        CellPlace upper = lower = place[0];
        for (const CellPlace& p : place)
            for (std::size_t a = 0; a < 3; ++a) {
                lower[a] = std::min(lower[a], p[a]);
                upper[a] = std::max(upper[a], p[a]);
            }
        for (std::size_t a = 0; a < 3; ++a) {
            lower[a] >>= 1;
            n[a] = (upper[a] >> 1) - lower[a] + 1;
        }
    }
    std::size_t count() const { return std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]); }
    std::size_t of(const CellPlace& p) const {
        const auto at = [&](std::size_t a) { return std::size_t((p[a] >> 1) - lower[a]); };
        return (at(2) * std::size_t(n[1]) + at(1)) * std::size_t(n[0]) + at(0);
    }
};

/// Indices of `values` in order of them: first of each value, and all indices.
struct Buckets {
    std::vector<std::uint32_t> first, index;

    template <class F>
    Buckets(std::size_t size, std::size_t buckets, F&& of) : first(buckets + 1, 0), index(size) {
        for (std::size_t i = 0; i < size; ++i) ++first[of(i) + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::size_t i = 0; i < size; ++i) index[next[of(i)]++] = std::uint32_t(i);
    }
};

}  // namespace

Aggregates aggregates_of(const BandMatrix& fine, std::span<const CellPlace> place) {
    const Blocks blocks(place);
    const Buckets cells(place.size(), blocks.count(),
                        [&](std::size_t i) { return blocks.of(place[i]); });
    constexpr std::uint32_t none = ~std::uint32_t{0};
    Aggregates result;
    result.of.assign(place.size(), none);
    // Pieces in order of their blocks, each flooded from its first cell.
    std::vector<CellPlace> pieces;
    std::vector<std::uint32_t> waiting;
    for (std::size_t b = 0; b < blocks.count(); ++b) {
        for (std::uint32_t m = cells.first[b]; m < cells.first[b + 1]; ++m) {
            const std::uint32_t seed = cells.index[m];
            if (result.of[seed] != none) continue;
            const std::uint32_t piece = std::uint32_t(pieces.size());
            pieces.push_back({place[seed][0] >> 1, place[seed][1] >> 1, place[seed][2] >> 1});
            result.of[seed] = piece;
            waiting.assign(1, seed);
            while (!waiting.empty()) {
                const std::uint32_t i = waiting.back();
                waiting.pop_back();
                for (std::uint32_t e = fine.first[i]; e < fine.first[i + 1]; ++e) {
                    const std::uint32_t j = fine.neighbour[e];
                    if (result.of[j] != none || blocks.of(place[j]) != b) continue;
                    result.of[j] = piece;
                    waiting.push_back(j);
                }
            }
        }
    }
    // Even ones first.
    std::vector<std::uint32_t> number(pieces.size());
    for (const int colour : {0, 1}) {
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            if (((pieces[p][0] + pieces[p][1] + pieces[p][2]) & 1) != colour) continue;
            number[p] = std::uint32_t(result.place.size());
            result.place.push_back(pieces[p]);
        }
        if (colour == 0) result.even = result.place.size();
    }
    for (std::uint32_t& of : result.of) of = number[of];
    Buckets members(place.size(), result.size(), [&](std::size_t i) { return result.of[i]; });
    result.first = std::move(members.first);
    result.member = std::move(members.index);
    return result;
}

BandMatrix coarse_matrix(const BandMatrix& fine, const Aggregates& a) {
    struct Entry {
        std::uint32_t to;
        BandFloats weight;
    };
    // Calls f with what the members of an aggregate have in common with other aggregates.
    const auto entries_of = [&](std::size_t c, std::vector<Entry>& found) {
        found.clear();
        for (std::uint32_t m = a.first[c]; m < a.first[c + 1]; ++m) {
            const std::uint32_t i = a.member[m];
            for (std::uint32_t e = fine.first[i]; e < fine.first[i + 1]; ++e) {
                const std::uint32_t to = a.of[fine.neighbour[e]];
                if (to == c) continue;
                const auto known = std::find_if(found.begin(), found.end(),
                                                [&](const Entry& x) { return x.to == to; });
                if (known == found.end())
                    found.push_back({to, fine.weight[e]});
                else
                    known->weight += fine.weight[e];
            }
        }
    };
    BandMatrix m;
    m.even = a.even;
    m.first.assign(a.size() + 1, 0);
    m.reaction.resize(a.size());
    for_blocks(0, a.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<Entry> found;
        for (std::size_t c = begin; c < end; ++c) {
            entries_of(c, found);
            m.first[c + 1] = std::uint32_t(found.size());
            BandFloats reaction(0.f);
            for (std::uint32_t k = a.first[c]; k < a.first[c + 1]; ++k)
                reaction += fine.reaction[a.member[k]];
            m.reaction[c] = reaction;
        }
    });
    std::partial_sum(m.first.begin(), m.first.end(), m.first.begin());
    m.neighbour.resize(m.first.back());
    m.weight.resize(m.first.back());
    for_blocks(0, a.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<Entry> found;
        for (std::size_t c = begin; c < end; ++c) {
            entries_of(c, found);
            std::uint32_t at = m.first[c];
            for (const Entry& x : found) {
                m.neighbour[at] = x.to;
                m.weight[at++] = x.weight * BandFloats(0.5f);
            }
        }
    });
    m.invert_diagonal();
    return m;
}

}  // namespace nacre
