#include "nacre/geometry/point_repulsion.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numeric>

#include "nacre/geometry/surface_grid.h"
#include "nacre/geometry/surface_walk.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

// Sum of the forces on `point`, in the plane of its triangle.
Vec3d force_on(const SheetPoint& point, const SurfaceGrid& grid, const SurfaceGrid::Around& near,
               float radius) {
    Vec3f force;
    near.for_each([&](std::uint32_t slot) {
        const SheetPoint& other = grid.points()[slot];
        const Vec3f away = point.p - other.p;
        const float squared = length_squared(away);
        if (squared >= radius * radius || !same_sheet(point, other)) return;
        const Vec3f turned = away - point.n * dot(away, point.n);
        const float len = length(turned);
        // Without a direction there is no force: the point itself, or one right above it.
        if (len > 1e-6f * radius) force += turned * ((radius - std::sqrt(squared)) / len);
    });
    return Vec3d(force);
}

void check(const RepulsionOptions& options) {
    if (options.sweeps < 0 || options.sweeps > 1000)
        throw InputError(fmt::format("point repulsion in {} sweeps; give a number from 0 to 1000",
                                     options.sweeps));
    if (!(options.step > 0.f && options.step <= 0.24f))
        throw InputError(fmt::format(
            "point repulsion with step {}; give a number above 0, at most 0.24", options.step));
}

}  // namespace

SurfacePointSet repelled_points(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                                const RepulsionOptions& options, const Work& work) {
    check(options);
    SurfacePointSet points = random_points(mesh, count, seed, work);
    const double area = std::accumulate(points.area.begin(), points.area.end(), 0.0);
    const double radius = 2 * std::sqrt(area / double(count));
    const std::vector<std::uint32_t> component = triangle_components(mesh);
    const SurfaceWalk surface(mesh);
    std::vector<SurfacePlace> places(count);
    for (std::size_t i = 0; i < count; ++i)
        places[i] = {points.triangle[i], points.barycentric[i].x, points.barycentric[i].y};

    std::vector<SheetPoint> sheet(count);
    WorkPhase phase(work, "surface points: repulsion", std::uint64_t(options.sweeps) * count);
    for (int sweep = 0; sweep < options.sweeps; ++sweep) {
        for (std::size_t i = 0; i < count; ++i)
            sheet[i] = {points.p[i], points.n[i], component[points.triangle[i]],
                        static_cast<std::uint32_t>(i)};
        const SurfaceGrid grid(sheet, static_cast<float>(radius));
        tbb::parallel_for(std::size_t(0), grid.cells(), [&](std::size_t cell) {
            const SurfaceGrid::Around near = grid.around(cell);
            for (std::uint32_t slot = grid.begin(cell); slot < grid.end(cell); ++slot) {
                const SheetPoint& point = grid.points()[slot];
                Vec3d move =
                    force_on(point, grid, near, static_cast<float>(radius)) * double(options.step);
                // Out of a clump the sum of many forces would throw a point far beyond it.
                if (const double len = length(move); len > radius / 2) move *= radius / 2 / len;
                SurfacePlace& place = places[point.index];
                place = surface.walk(place, move);
                set_place(mesh, place, point.index, points);
            }
            phase.advance(grid.end(cell) - grid.begin(cell));
        });
    }
    return points;
}

}  // namespace nacre
