#pragma once
// A surface as a function of two coordinates, with derivatives: what solvers need that move a point
// on it.
#include <array>
#include <cstdint>

#include "nacre/math/vec.h"

namespace nacre {

/// A piece of a surface: barycentric coordinates (a, b) of its second and third corner run over it.
/// Corners are the parameters of `Hit`, (u, v, 0); on a sphere, whose parameters are bad near the
/// poles, directions from its centre.
struct ChartTriangle {
    std::uint32_t shape = 0, primitive = 0;
    std::array<Vec3d, 3> corners;

    Vec3d at(double a, double b) const {
        return corners[0] + (corners[1] - corners[0]) * a + (corners[2] - corners[0]) * b;
    }
};

/// A surface around a point. In double, since Newton's method divides by differences of nearly
/// equal normals.
struct SurfaceChart {
    Vec3d p, pa, pb;  ///< position and its derivatives by the two coordinates
    Vec3d n, na, nb;  ///< the shading normal, unit, as SurfacePoint's
    Vec3d ng;         ///< the geometric normal, unit, on the same side
};

}  // namespace nacre
