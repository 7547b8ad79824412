#pragma once
// Affine transforms with their inverse, in double precision: scene files chain many of them.
#include <array>

#include "nacre/math/vec.h"

namespace nacre {

/// An invertible affine (or projective, for cameras) map of space. Column vectors: (A * B) applies
/// B first.
class Transform {
  public:
    using Matrix = std::array<double, 16>;  ///< row major

    Transform();
    /// Throws InputError if `m` is singular or has a value that is not finite.
    explicit Transform(const Matrix& m);

    static Transform translate(const Vec3d& d);
    static Transform scale(const Vec3d& s);
    /// Rotation by `degrees` about `axis` (counter-clockwise when the axis points at the viewer).
    static Transform rotate(const Vec3d& axis, double degrees);
    /// Camera to world: the camera sits at `origin`, +z looks at `target`, x points to the left of
    /// the picture (Mitsuba's convention). Throws InputError if the three do not span a frame.
    static Transform look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up);

    friend Transform operator*(const Transform& a, const Transform& b);
    Transform inverse() const;
    const Matrix& matrix() const { return m_; }

    /// Points get the full homogeneous map (with the division by w where the map is projective).
    Point3f point(const Point3f& p) const;
    Vec3f vector(const Vec3f& v) const;
    /// Normals transform by the inverse transpose; the result is not normalised.
    Vec3f normal(const Vec3f& n) const;
    /// The same maps in double precision.
    Vec3d map_point(const Vec3d& p) const;
    Vec3d map_vector(const Vec3d& v) const;
    Vec3d map_normal(const Vec3d& n) const;
    /// True if the map turns right-handed frames into left-handed ones.
    bool swaps_handedness() const;
    bool is_identity() const;

  private:
    Transform(const Matrix& m, const Matrix& inverse) : m_(m), inverse_(inverse) {}

    Matrix m_, inverse_;
};

}  // namespace nacre
