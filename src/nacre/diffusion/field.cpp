#include "nacre/diffusion/field.h"

#include <cmath>

namespace nacre {

CellMix cells_around(const CellGrid& grid, const Vec3d& p) {
    const GridFrame& f = grid.frame();
    CellPlace low;
    Vec3d part;
    for (std::size_t a = 0; a < 3; ++a) {
        const double x = (p[a] - f.origin[a]) / f.h - 0.5;
        low[a] = std::int32_t(std::floor(x));
        part[a] = x - std::floor(x);
    }
    CellMix mix;
    double sum = 0.;
    for (int corner = 0; corner < 8; ++corner) {
        CellPlace c = low;
        double weight = 1.;
        for (std::size_t a = 0; a < 3; ++a) {
            const bool upper = corner >> a & 1;
            c[a] += upper;
            weight *= upper ? part[a] : 1. - part[a];
        }
        const std::uint32_t cell = grid.at(c);
        if (cell == CellGrid::none || !(weight > 0.)) continue;
        mix.cell[std::size_t(mix.count)] = cell;
        mix.weight[std::size_t(mix.count++)] = weight;
        sum += weight;
    }
    for (int i = 0; i < mix.count; ++i) mix.weight[std::size_t(i)] /= sum;
    return mix;
}

BandDoubles fluence(const CellGrid& grid, std::span<const BandDoubles> phi, const Vec3d& p) {
    const CellMix mix = cells_around(grid, p);
    BandDoubles sum(0.);
    for (int i = 0; i < mix.count; ++i)
        sum += phi[mix.cell[std::size_t(i)]] * BandDoubles(mix.weight[std::size_t(i)]);
    return sum;
}

BandDoubles surface_fluence(const CellGrid& grid, const DiffusionMatter& matter,
                            std::span<const BandDoubles> phi, const Vec3d& p, const Vec3d& n,
                            BandDoubles q) {
    const CellMix mix = cells_around(grid, p);
    const BandDoubles twice(2. * matter.boundary);
    BandDoubles sum(0.);
    for (int i = 0; i < mix.count; ++i) {
        const std::uint32_t cell = mix.cell[std::size_t(i)];
        const Resistance r = boundary_resistance(matter.boundary, dot(p - grid.center(cell), n),
                                                 matter.diffusion_at(cell));
        sum += (twice * phi[cell] + (r.value - twice) * q) / r.value *
               BandDoubles(mix.weight[std::size_t(i)]);
    }
    return sum;
}

BandDoubles flux_at(const CellGrid& grid, std::span<const BandDoubles> of_cut, const Vec3d& p) {
    BandDoubles result(0.);
    if (of_cut.empty()) return result;
    const CellMix mix = cells_around(grid, p);
    double weight = 0.;
    for (int i = 0; i < mix.count; ++i) {
        const std::int32_t cut = grid.cut_number(mix.cell[std::size_t(i)]);
        if (cut < 0) continue;
        result += of_cut[std::size_t(cut)] * BandDoubles(mix.weight[std::size_t(i)]);
        weight += mix.weight[std::size_t(i)];
    }
    return weight > 0. ? result * BandDoubles(1. / weight) : result;
}

EnergyBalance energy_balance(const CellGrid& grid, const DiffusionMatter& matter,
                             const DiffusionProblem& problem, std::span<const BandDoubles> phi,
                             std::span<const BandDoubles> q) {
    const double h = grid.frame().h;
    EnergyBalance e;
    e.absorbed = sum_over(grid.size(), [&](std::size_t c) {
        const BandFloats share =
            matter.absorption_at(c) * BandFloats(float(grid.volume(c) * h * h * h));
        return to_double(share) * phi[c];
    });
    e.out = sum_over(grid.cuts().size(), [&](std::size_t c) {
        const BandDoubles above = phi[grid.cell_of_cut(c)] - (q.empty() ? BandDoubles(0.) : q[c]);
        return to_double(problem.conductance[c]) * above;
    });
    return e;
}

}  // namespace nacre
