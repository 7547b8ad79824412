#include "nacre/geometry/surface_point_set.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "nacre/geometry/area_sampler.h"
#include "nacre/geometry/mesh_topology.h"
#include "nacre/geometry/surface_grid.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"

namespace nacre {
namespace {

// Visits sample i of `count` with its place; `square` gives the point of the unit square in strip
// i, both coordinates in [0, 1).
template <class Square, class Visit>
void for_each_strip(const AreaSampler& sampler, std::size_t count, const Square& square,
                    const Visit& visit, std::string_view name, const Work& work) {
    WorkPhase phase(work, name, count);
    using Range = tbb::blocked_range<std::size_t>;
    tbb::parallel_for(Range(0, count, 1024), [&](const Range& range) {
        std::uint32_t triangle = sampler.first_triangle(double(range.begin()) / double(count));
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const auto [within, t] = square(i);
            const SurfacePlace place =
                sampler.at((double(i) + within) / double(count), t, triangle);
            // Strips follow one another, so the next sample lies here or further on.
            triangle = place.triangle;
            visit(i, place);
        }
        phase.advance(range.size());
    });
}

double unit_double(std::uint64_t bits) { return double(bits >> 11) * 0x1p-53; }

}  // namespace

SurfacePointSet random_points(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                              const Work& work) {
    check_point_count(count);
    const AreaSampler sampler(mesh);
    SurfacePointSet points;
    resize(points, count);
    const auto square = [&](std::size_t i) {
        Random random(stream_key(seed, i));
        const double within = unit_double(random.next_bits());
        return std::array{within, unit_double(random.next_bits())};
    };
    const auto place_point = [&](std::size_t i, const SurfacePlace& place) {
        set_place(mesh, place, i, points);
        points.area[i] = static_cast<float>(sampler.area() / double(count));
    };
    for_each_strip(sampler, count, square, place_point, "surface points: random", work);
    return points;
}

void assign_voronoi_shares(const Mesh& mesh, SurfacePointSet& points, int samples_per_point,
                           const Work& work) {
    check_point_count(points.size());
    if (samples_per_point < 1 || samples_per_point > 10000)
        throw InputError(
            fmt::format("Voronoi shares by {} samples per point; give a number from "
                        "1 to 10000",
                        samples_per_point));
    const AreaSampler sampler(mesh);
    const std::vector<std::uint32_t> component = triangle_components(mesh);
    const std::size_t count = points.size(), samples = count * std::size_t(samples_per_point);
    std::vector<SheetPoint> sheet(count);
    for (std::size_t i = 0; i < count; ++i)
        sheet[i] = {points.p[i], points.n[i], component[points.triangle[i]],
                    static_cast<std::uint32_t>(i)};
    // Even points leave no hole wider than the first radius; the second is for others.
    const auto spacing = static_cast<float>(std::sqrt(sampler.area() / double(count)));
    const float radii[] = {1.25f * spacing, 2.5f * spacing};
    const SurfaceGrid grids[] = {{sheet, radii[0]}, {sheet, radii[1]}};

    // Counts are whole numbers, so the order in which threads add to them does not matter.
    std::vector<std::atomic<std::uint32_t>> owned(count);
    std::atomic<std::size_t> without_owner = 0;
    // A Fibonacci lattice: multiples of the golden ratio, the least well approximated by fractions,
    // keep neighbouring strips' samples apart.
    const auto square = [](std::size_t i) {
        const double multiple = double(i) * (std::numbers::phi - 1);
        return std::array{0.5, multiple - std::floor(multiple)};
    };
    const auto give_to_owner = [&](std::size_t, const SurfacePlace& place) {
        const Mesh::Triangle& t = mesh.triangles[place.triangle];
        const Vec3d a(mesh.positions[t[0]]);
        const SheetPoint sample = {Point3f(a + (Vec3d(mesh.positions[t[1]]) - a) * place.u +
                                           (Vec3d(mesh.positions[t[2]]) - a) * place.v),
                                   Vec3f(geometric_normal(mesh, place.triangle)),
                                   component[place.triangle], 0};
        std::uint32_t owner = ~0u;
        for (int g = 0; g < 2 && owner == ~0u; ++g) {
            float nearest = radii[g] * radii[g];
            grids[g].around(sample.p).for_each([&](std::uint32_t slot) {
                const SheetPoint& point = grids[g].points()[slot];
                const float distance = length_squared(point.p - sample.p);
                if (distance < nearest && same_sheet(point, sample))
                    nearest = distance, owner = point.index;
            });
        }
        if (owner == ~0u)
            ++without_owner;
        else
            owned[owner].fetch_add(1, std::memory_order_relaxed);
    };
    for_each_strip(sampler, samples, square, give_to_owner, "shares of the surface", work);
    const double one = sampler.area() / double(samples);
    const double common = one * double(without_owner) / double(count);
    for (std::size_t i = 0; i < count; ++i)
        points.area[i] = static_cast<float>(one * owned[i] + common);
}

}  // namespace nacre
