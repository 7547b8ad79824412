#pragma once
// The geometry of analytic shapes in double precision: what RayScene hands to Embree for spheres,
// disks and cylinders.
#include <cstdint>
#include <vector>

#include "nacre/geometry/mesh.h"
#include "nacre/geometry/primitives.h"
#include "nacre/geometry/surface_chart.h"

namespace nacre {

/// A point of an analytic shape, by the shape's own two parameters (u, v):
///   sphere    azimuth / 2 pi, polar angle / pi
///   disk      x, y of the unit disk
///   cylinder  azimuth / 2 pi, z of the unit cylinder
/// so that a point computed from them lies on the surface to within one rounding.
struct AnalyticHit {
    double t = 0;  ///< ray parameter, or distance for a closest point
    float u = 0, v = 0;
};

struct AnalyticPoint {
    Vec3d p;
    Vec3d n;     ///< unit; outwards, +z for disks, reversed by flip_normals
    Vec3d dpdu;  ///< derivative along the first texture coordinate; not normalised
    Vec2f uv;    ///< Mitsuba's texture coordinates (a disk's are radius and azimuth / 2 pi)
};

class AnalyticShape {
  public:
    /// Throws InputError for a radius that is not a positive number.
    explicit AnalyticShape(const Primitive& primitive);

    /// First crossing of o + t d with tmin < t <= tmax; false if there is none.
    bool intersect(const Vec3d& o, const Vec3d& d, double tmin, double tmax,
                   AnalyticHit& hit) const;
    /// Nearest point of the surface; `t` is its distance. Closed form for spheres and for shapes
    /// under similarity transforms. Under other transforms the point of an ellipse is found by a
    /// search over its azimuth, to 1e-9 of its size.
    AnalyticHit closest(const Vec3d& p) const;
    AnalyticPoint at(float u, float v) const;
    SurfaceChart chart(const ChartTriangle& triangle, double a, double b) const;
    AnalyticHit chart_hit(const ChartTriangle& triangle, double a, double b) const;
    std::vector<ChartTriangle> chart_triangles(std::uint32_t shape) const;
    /// Contains the shape, rounded outwards.
    Box3f bounds() const;
    /// Longest extent, a scale for rounding errors.
    double size() const { return size_; }
    double area() const { return area_; }
    /// Parameters of a point uniform by area from `u` in [0,1)^2, and its density by area.
    AnalyticHit sample(Vec2f u, double& pdf) const;

  private:
    enum class Kind : std::uint8_t { Sphere, Disk, Cylinder };

    Vec3d local(double x, double y, double z) const { return o_ + x_ * x + y_ * y + z_ * z; }
    bool crosses_sphere(const Vec3d& o, const Vec3d& d, double tmin, double tmax,
                        AnalyticHit& hit) const;
    /// The parameters of a sphere's point, whatever its distance from the centre.
    AnalyticHit on_sphere(double t, const Vec3d& from_center) const;
    AnalyticHit closest_on_disk(const Vec3d& p) const;
    AnalyticHit closest_on_cylinder(const Vec3d& p) const;
    double stretch(double azimuth) const;

    Kind kind_;
    bool flip_ = false;
    bool similarity_ = true;
    Vec3d o_, x_{1, 0, 0}, y_{0, 1, 0}, z_{0, 0, 1};  ///< origin and axes in the world
    Transform to_world_;
    Transform to_local_;
    double radius_ = 1;
    double size_ = 0, area_ = 0;
    /// Cylinders that are not round: cumulative area over equal steps of azimuth, for sampling.
    std::vector<double> steps_;
};

}  // namespace nacre
