#pragma once
// The cuts through a BRDF that pictures show.
#include "nacre/measured/half_angle.h"

namespace nacre {

/// The direction at `theta` (radians) to the normal in the plane of incidence; negative on the
/// other side.
inline Vec3d in_plane(double theta) { return {std::sin(theta), 0., std::cos(theta)}; }

/// B. Burley 2012, Physically-Based Shading at Disney: the plane of theta_h and theta_d (radians)
/// in which light and viewer stand to the two sides of the half vector, phi_d = 90 degrees.
inline DirectionPair burley_slice(double theta_h, double theta_d) {
    const Vec3d h = in_plane(theta_h), y{0., std::sin(theta_d), 0.};
    return {h * std::cos(theta_d) + y, h * std::cos(theta_d) - y};
}

}  // namespace nacre
