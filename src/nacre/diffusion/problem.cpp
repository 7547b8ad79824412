#include "nacre/diffusion/problem.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <numeric>

#include "nacre/math/error.h"

namespace nacre {
namespace {

void check(const CellGrid& grid, const DiffusionMatter& matter) {
    const auto one_or_all = [&](std::size_t n) { return n == 1 || n == grid.size(); };
    if (!one_or_all(matter.diffusion.size()) || !one_or_all(matter.absorption.size()))
        throw InputError(fmt::format(
            "{} diffusion and {} absorption coefficients for {} cells: give one of each, or one "
            "a cell",
            matter.diffusion.size(), matter.absorption.size(), grid.size()));
    if (!(matter.boundary > 0.))
        throw InputError(
            fmt::format("boundary parameter A = {:g}: it must be positive", matter.boundary));
    const auto refuse = [&](const char* what, std::size_t cell, std::size_t count, float value) {
        const Vec3d p = grid.center(count == 1 ? 0 : cell);
        throw InputError(
            fmt::format("{} is {:g} at ({:g}, {:g}, {:g})", what, value, p.x, p.y, p.z));
    };
    for (std::size_t i = 0; i < matter.diffusion.size(); ++i)
        for (int b = 0; b < BandFloats::size; ++b)
            if (const float d = matter.diffusion[i][b]; !(d > 0.f && std::isfinite(d)))
                refuse("the diffusion coefficient, which must be positive,", i,
                       matter.diffusion.size(), d);
    for (std::size_t i = 0; i < matter.absorption.size(); ++i)
        for (int b = 0; b < BandFloats::size; ++b)
            if (const float a = matter.absorption[i][b]; !(a >= 0.f && std::isfinite(a)))
                refuse("absorption, which must not be negative,", i, matter.absorption.size(), a);
}

}  // namespace

Resistance boundary_resistance(double boundary, double offset, BandFloats diffusion) {
    const BandDoubles along = BandDoubles(offset) / to_double(diffusion), least(-boundary);
    return {BandDoubles(2. * boundary) + max(along, least), any(along < least)};
}

DiffusionProblem make_problem(const CellGrid& grid, const DiffusionMatter& matter) {
    check(grid, matter);
    const double h = grid.frame().h;
    DiffusionProblem result;
    BandMatrix& m = result.matrix;
    m.even = grid.even();
    m.first.assign(grid.size() + 1, 0);
    m.reaction.resize(grid.size());
    result.conductance.resize(grid.cuts().size());
    const auto share = [&](std::size_t cell, std::size_t face) {
        const std::uint32_t other = grid.neighbour(cell, face);
        return other == CellGrid::none
                   ? 0.
                   : std::min(grid.aperture(cell, face), grid.aperture(other, face ^ 1));
    };
    std::atomic<std::size_t> clamped{0};
    for_blocks(0, grid.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            for (std::size_t face = 0; face < 6; ++face) m.first[c + 1] += share(c, face) > 0.;
            m.reaction[c] = matter.absorption_at(c) * BandFloats(float(grid.volume(c) * h * h * h));
            const CutCell* cut = grid.cut(c);
            if (!cut) continue;
            const Resistance r =
                boundary_resistance(matter.boundary, cut->offset, matter.diffusion_at(c));
            const BandFloats conductance = to_float(BandDoubles(cut->area) / r.value);
            result.conductance[std::size_t(grid.cut_number(c))] = conductance;
            m.reaction[c] += conductance;
            if (r.clamped) ++clamped;
        }
    });
    result.clamped = clamped;
    std::partial_sum(m.first.begin(), m.first.end(), m.first.begin());
    m.neighbour.resize(m.first.back());
    m.weight.resize(m.first.back());
    for_blocks(0, grid.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            std::uint32_t at = m.first[c];
            const BandFloats here = matter.diffusion_at(c);
            for (std::size_t face = 0; face < 6; ++face) {
                const double s = share(c, face);
                if (!(s > 0.)) continue;
                const std::uint32_t other = grid.neighbour(c, face);
                const BandFloats there = matter.diffusion_at(other);
                m.neighbour[at] = other;
                m.weight[at++] = BandFloats(float(2. * s * h)) * here * there / (here + there);
            }
        }
    });
    return result;
}

std::vector<BandDoubles> right_side(const CellGrid& grid, const DiffusionProblem& problem,
                                    std::span<const BandDoubles> power,
                                    std::span<const BandDoubles> q) {
    std::vector<BandDoubles> b(grid.size(), BandDoubles(0.));
    if (!power.empty()) std::copy(power.begin(), power.end(), b.begin());
    if (!q.empty())
        for (std::size_t c = 0; c < q.size(); ++c)
            b[grid.cell_of_cut(c)] += q[c] * to_double(problem.conductance[c]);
    return b;
}

}  // namespace nacre
