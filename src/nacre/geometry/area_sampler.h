#pragma once
// Points of a mesh by area.
#include <vector>

#include "nacre/geometry/surface_point_set.h"

namespace nacre {

/// A place on a mesh, in the precision that moving it needs.
struct SurfacePlace {
    std::uint32_t triangle = 0;
    double u = 0, v = 0;  ///< weights of the second and third corner
};

/// Maps the unit square onto a mesh with constant density: the triangles, one after the other, are
/// swept by strips parallel to their sides from the second to the third corner.
class AreaSampler {
  public:
    /// Throws InputError for a mesh without triangles or area or with coordinates that are not
    /// finite.
    explicit AreaSampler(const Mesh& mesh);

    double area() const { return sums_.back(); }
    /// The place at (s, t) in [0, 1)^2. Looks for the triangle from `hint` on, which must not be
    /// beyond it; `first_triangle(s)` is always right.
    SurfacePlace at(double s, double t, std::uint32_t hint) const;
    std::uint32_t first_triangle(double s) const;

  private:
    std::vector<double> sums_;  ///< cumulative area
};

/// Unit normal of a triangle that has an area.
Vec3d geometric_normal(const Mesh& mesh, std::uint32_t triangle);

/// Entry i of `points`, whose arrays are long enough, but for its share.
void set_place(const Mesh& mesh, const SurfacePlace& place, std::size_t i, SurfacePointSet& points);
void resize(SurfacePointSet& points, std::size_t count);

/// Throws InputError unless 1 <= count <= kMaxSurfacePoints.
void check_point_count(std::size_t count);

}  // namespace nacre
