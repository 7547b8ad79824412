#pragma once
// Points spread evenly over a mesh by leaving out the most crowded of many random ones: in a third
// of the time of 40 sweeps of repulsion, less regular, without its gathering at boundaries.
//
//   C. Yuksel 2015, Sample Elimination for Generating Poisson Disk Sample Sets, Computer Graphics
//   Forum 34(2) (Eurographics). With r = sqrt(area / (2 sqrt(3) count)), half the distance of
//   neighbours in the densest arrangement, a candidate weighs
//     w = sum over others within 2 r of (1 - max(d, 2 r_min) / (2 r))^alpha,   alpha = 8,
//     r_min = r beta (1 - (count / candidates)^gamma),   beta = 0.65, gamma = 1.5,
//   and the heaviest is left out, over and over, until `count` are left. r_min ("weight limiting")
//   stops pairs that are very close from deciding alone. Distances are in space, as in Yuksel's
//   section on surfaces; points on the other side of a thin sheet and on other components do not
//   count (same_sheet in surface_grid.h).
#include "nacre/geometry/surface_point_set.h"
#include "nacre/math/work.h"

namespace nacre {

struct EliminationOptions {
    float candidates = 5.f;  ///< random points per point that is kept, 1 to 100; Yuksel: 5
};

/// `count` points by elimination from random_points(mesh, candidates * count, seed). All shares are
/// area / count. The same seed gives the same bits for any number of threads. Takes about 250 bytes
/// a candidate.
/// @throws InputError as random_points, and for options out of range; Stopped if `work` says so.
SurfacePointSet eliminated_points(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                                  const EliminationOptions& options = {}, const Work& work = {});

}  // namespace nacre
