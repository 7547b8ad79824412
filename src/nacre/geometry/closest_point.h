#pragma once
// Nearest point of a triangle, in double precision.
#include "nacre/geometry/analytic.h"

namespace nacre {

/// Nearest point of the triangle abc to `p`: distance and barycentric coordinates of b and c.
/// Degenerate triangles are treated as the segment or point they are.
AnalyticHit closest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace nacre
