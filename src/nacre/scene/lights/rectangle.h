#pragma once
// Uniform directions towards a rectangle: Urena, Fajardo, King 2013, An Area-Preserving
// Parametrization for Spherical Rectangles, Computer Graphics Forum 32(4).
#include <optional>

#include "nacre/geometry/mesh.h"

namespace nacre {

/// A rectangle in space: a corner and two perpendicular edges.
struct Rectangle {
    Vec3d corner, x_axis, y_axis;  ///< the axes are unit vectors
    double width = 0, height = 0;
};

/// The rectangle that a mesh of two triangles forms, if it does (to 1e-5 of its size).
std::optional<Rectangle> as_rectangle(const Mesh& mesh);

/// A rectangle as seen from a point: its solid angle, and points of it that are uniform in solid
/// angle. In double precision, because the solid angle is a difference of angles.
class SphericalRectangle {
  public:
    SphericalRectangle(const Rectangle& rectangle, const Vec3d& from);

    /// sr; 0 if the point lies in the rectangle's plane.
    double solid_angle() const { return solid_angle_; }
    /// Vector from the point to a point of the rectangle; uniform in solid angle for uniform u.
    Vec3d sample(Vec2f u) const;

  private:
    Vec3d x_, y_, z_;                   ///< z away from the rectangle, towards the point
    double x0_, x1_, y0_, y1_, z0_;     ///< the rectangle in this frame, z0 <= 0
    double b0_, b1_, k_, solid_angle_;  ///< names of the paper
};

}  // namespace nacre
