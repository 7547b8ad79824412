#pragma once
// Points spread over a mesh, each with its share of the surface: where irradiance is gathered for
// the two-pass technique of Jensen and Buhler 2002, A Rapid Hierarchical Rendering Technique for
// Translucent Materials, ACM TOG 21(3).
#include <cstdint>
#include <vector>

#include "nacre/geometry/mesh.h"
#include "nacre/math/work.h"

namespace nacre {

/// Points on the triangles of a mesh; all arrays have the same length.
struct SurfacePointSet {
    std::vector<Point3f> p;  ///< (1 - u - v) a + u b + v c of the barycentric coordinates below
    std::vector<Vec3f> n;    ///< unit geometric normal, counter-clockwise side
    std::vector<std::uint32_t> triangle;
    std::vector<Vec2f> barycentric;  ///< weights u, v of the triangle's second and third corner
    std::vector<float> area;  ///< share of the surface, in the square of the mesh's unit; the sum
                              ///< is the mesh's area to 1e-5 of it

    std::size_t size() const { return p.size(); }
};

/// The most points that are made: some 2 GB of them, more than two passes can use.
constexpr std::size_t kMaxSurfacePoints = 50'000'000;

/// Random points: the surface, triangle after triangle, is cut into `count` pieces of equal area
/// and each gets one point, uniform within it. Every share is area / count. The same seed gives the
/// same bits for any number of threads.
/// @throws InputError for a mesh without triangles or area, or with coordinates that are not
/// finite, and unless 1 <= count <= kMaxSurfacePoints; Stopped if `work` says so.
SurfacePointSet random_points(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                              const Work& work = {});

/// Sets the shares of `points`, which lie on `mesh`, to the areas of their Voronoi cells, by
/// `samples_per_point` times as many regular samples of the surface, each given to the nearest
/// point on its sheet (same_sheet in surface_grid.h). The error of one share, measured (RMS) on a
/// lattice whose shares are known, is about 0.5 / samples_per_point^0.75 of it where triangles hold
/// many samples (4 % for 32, 2 % for 64), and approaches 1 / sqrt(samples_per_point) where they
/// hold less than one and the mesh lists them in no spatial order. Samples without a point
/// within 2.5 sqrt(area / count), as on components smaller than one share, are divided among all
/// points, so that the sum stays the mesh's area. A point that coincides with another may get 0.
/// @throws InputError as random_points, and unless 1 <= samples_per_point <= 10000; Stopped if
/// `work` says so.
void assign_voronoi_shares(const Mesh& mesh, SurfacePointSet& points, int samples_per_point = 32,
                           const Work& work = {});

}  // namespace nacre
