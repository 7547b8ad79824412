#include "nacre/measured/factor/matrix.h"

#include <tbb/parallel_for.h>

#include <atomic>

#include "nacre/math/error.h"

namespace nacre {

FactorMatrix sample_matrix(const Target& target, const FactorGrid& grid) {
    if (grid.side < FactorGrid::least_side || grid.side > FactorGrid::most_side)
        throw InputError(
            fmt::format("textures of {0} x {0} texels: the side must lie within {1} "
                        "to {2}",
                        grid.side, FactorGrid::least_side, FactorGrid::most_side));
    FactorMatrix m;
    m.grid = grid;
    const int n = grid.count();
    for (auto& channel : m.values) channel.assign(m.size(), 0.);
    m.known.assign(m.size(), 0);
    std::vector<Vec3d> columns(n);
    for (int l = 0; l < n; ++l) columns[l] = grid.column(l);
    std::atomic<std::size_t> below = 0, missing = 0;
    std::atomic<bool> wrong = false, bright = false, coloured = false;
    tbb::parallel_for(0, n, [&](int k) {
        const Vec3d x = grid.row(k);
        std::vector<Vec3d> wi, wo;
        std::vector<int> column;
        for (int l = 0; l < n; ++l) {
            const DirectionPair w = grid.pair(x, columns[l]);
            if (!(w.wi.z > 0. && w.wo.z > 0.)) continue;
            wi.push_back(w.wi);
            wo.push_back(w.wo);
            column.push_back(l);
        }
        const auto values = target.values(wi, wo);
        std::size_t without = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto& value = values[i];
            if (!value) {
                ++without;
                continue;
            }
            const std::size_t at = std::size_t(k) * n + column[i];
            m.known[at] = 1;
            for (int c = 0; c < 3; ++c) {
                m.values[c][at] = (*value)[c];
                if (!std::isfinite((*value)[c])) wrong = true;
                if ((*value)[c] > 0.) bright = true;
            }
            if (value->x != value->y || value->x != value->z) coloured = true;
        }
        below += std::size_t(n) - values.size();
        missing += without;
    });
    m.below = below;
    m.missing = missing;
    if (m.below + m.missing == m.size())
        throw InputError(fmt::format("{}: has no value at any of the directions", target.name()));
    if (wrong)
        throw InputError(fmt::format("{}: has values that are not finite; it cannot be factored",
                                     target.name()));
    if (!bright)
        throw InputError(
            fmt::format("{}: has no value above 0; there is nothing to factor", target.name()));
    if (m.below + m.missing == 0) m.known.clear();
    if (!coloured)
        for (int c : {1, 2}) std::vector<double>().swap(m.values[c]);
    return m;
}

}  // namespace nacre
