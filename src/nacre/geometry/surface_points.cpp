#include "nacre/geometry/surface_points.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "nacre/geometry/area_sampler.h"
#include "nacre/math/error.h"

namespace nacre {

std::size_t point_count(double area, double spacing) {
    if (!(spacing > 0) || !std::isfinite(spacing))
        throw InputError(
            fmt::format("spacing of surface points is {}; give a length above zero", spacing));
    const double count = std::round(2 / std::numbers::sqrt3 * area / (spacing * spacing));
    if (!(count <= double(kMaxSurfacePoints))) {
        const double least = std::sqrt(2 / std::numbers::sqrt3 * area / double(kMaxSurfacePoints));
        throw InputError(
            fmt::format("a spacing of {} on an area of {:.4g} takes {:.3g} surface "
                        "points; the limit is {}: give a spacing of at least {:.4g}",
                        spacing, area, count, kMaxSurfacePoints, least));
    }
    return std::max<std::size_t>(1, static_cast<std::size_t>(count));
}

SurfacePointSet points_for_spacing(const Mesh& mesh, double spacing, PointMethod method,
                                   std::uint64_t seed, const SurfacePointOptions& options,
                                   const Work& work) {
    const std::size_t count = point_count(AreaSampler(mesh).area(), spacing);
    SurfacePointSet points = method == PointMethod::random ? random_points(mesh, count, seed, work)
                             : method == PointMethod::repulsion
                                 ? repelled_points(mesh, count, seed, options.repulsion, work)
                                 : eliminated_points(mesh, count, seed, options.elimination, work);
    if (options.shares == PointShares::voronoi)
        assign_voronoi_shares(mesh, points, options.samples_per_point, work);
    return points;
}

}  // namespace nacre
