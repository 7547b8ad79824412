#pragma once
// Interpolated normals that face away from the viewer.
//
// Near the silhouette of a coarse mesh the interpolated normal n may point away from a viewer who
// sees the outside of the triangle, and a direction mirrored about it may lead below the triangle.
// A reflectance model has no answer there: the object would get black rims. So n is turned towards
// the viewer as far as needed and no farther; the geometry stays.
//
//   A. Keller, C. Wachter, M. Raab, D. Seibert, D. van Antwerpen, J. Korndorfer, L. Kettner 2017,
//   The Iray Light Transport Simulation and Rendering System, arXiv:1705.01263, appendix.
#include "nacre/geometry/ray_scene.h"

namespace nacre {

/// Turns the frame of `at` until `to_viewer` is on the side of the shading normal on which it is of
/// the geometric one and, if the surface mirrors, until the mirrored direction is so too. Returns
/// whether anything had to be turned; else no bit changes. The viewer may be on either side.
bool turn_to_viewer(SurfacePoint& at, const Vec3f& to_viewer, bool mirrors);

}  // namespace nacre
