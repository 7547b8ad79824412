#pragma once
// Half-angle coordinates of two directions: the half vector by its polar angles, and the light by
// its polar angles about the half vector.
//
//   S. M. Rusinkiewicz 1998, A New Change of Variables for Efficient BRDF Representation, EGWR,
//   section 2: theta_h, phi_h of h = (wi + wo)/|wi + wo|; theta_d, phi_d of the difference vector
//   d = R_y(-theta_h) R_z(-phi_h) wi.
//
// Isotropic models do not depend on phi_h; reciprocal ones have the period pi in phi_d.
#include <algorithm>
#include <cmath>

#include "nacre/math/vec.h"

namespace nacre {

struct HalfAngle {
    double theta_h = 0., phi_h = 0.;  ///< radians; theta_h in [0, pi/2] of directions above
    double theta_d = 0., phi_d = 0.;  ///< radians; theta_d in [0, pi/2], phi_d in [-pi, pi]
};

struct DirectionPair {
    Vec3d wi, wo;
};

namespace half_angle_detail {

/// The axes that the difference vector is given in.
struct Axes {
    Vec3d x, y, h;
    Axes(double theta, double phi)
        : x{std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta)},
          y{-std::sin(phi), std::cos(phi), 0.},
          h{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)} {}
};

}  // namespace half_angle_detail

/// Of two unit vectors that are not opposite. At theta_h = 0 phi_h is 0, at theta_d = 0 phi_d is.
inline HalfAngle to_half_angle(const Vec3d& wi, const Vec3d& wo) {
    const Vec3d h = normalize(wi + wo);
    HalfAngle a;
    a.theta_h = std::atan2(std::hypot(h.x, h.y), h.z);
    a.phi_h = std::atan2(h.y, h.x);
    const half_angle_detail::Axes axes(a.theta_h, a.phi_h);
    const double x = dot(wi, axes.x), y = dot(wi, axes.y);
    a.theta_d = std::atan2(std::hypot(x, y), dot(wi, axes.h));
    a.phi_d = std::atan2(y, x);
    return a;
}

/// The directions, unit vectors; either may lie below the horizon.
inline DirectionPair from_half_angle(const HalfAngle& a) {
    const half_angle_detail::Axes axes(a.theta_h, a.phi_h);
    const double s = std::sin(a.theta_d);
    const Vec3d across = axes.x * (s * std::cos(a.phi_d)) + axes.y * (s * std::sin(a.phi_d));
    const Vec3d along = axes.h * std::cos(a.theta_d);
    return {along + across, along - across};
}

}  // namespace nacre
