#pragma once
// Light of a point or of one direction that a smooth boundary refracts, as a function of where on
// the boundary it enters: the direction inside, and how much of it comes to a point there.
#include <vector>

#include "nacre/geometry/surface_chart.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// A light without extent as a point of the surface sees it. At infinity if `distant`, and
/// `place` is then the unit vector towards it.
struct LightPlace {
    Vec3d place;
    bool distant = false;
};

struct SourceWithoutExtent {
    const Light* light;
    LightPlace place;
};
/// The points, spots and directional lights of a scene that shine.
std::vector<SourceWithoutExtent> sources_without_extent(const Scene& scene);

inline double det(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return dot(cross(a, b), c); }

/// The refracted direction at a surface, a unit vector into the matter below, and its derivatives
/// by the surface's parameters.
struct RefractedLight {
    Vec3d d, da, db;
    double cos_out = 0;  ///< to the light; the direction below the horizon is the smooth
                         ///< continuation, which lights nothing
};

/// `eta`: index inside over outside, > 1.
RefractedLight refract_light(const SurfaceChart& at, const LightPlace& light, double eta);

/// One step of Newton's method for the place (a, b) from where light comes to `y`: what to add to
/// the coordinates of `at`. False where the beam is focused.
bool step_towards(const Vec3d& y, const SurfaceChart& at, const RefractedLight& light,
                  double& step_a, double& step_b);

/// How much the boundary gathers: the light's own irradiance on a surface at `at` that faces it,
/// times this, times the Fresnel transmittance, is the irradiance at y from there. It is the
/// solid angle at y for a solid angle at the light, over that without the boundary, with eta^2 for
/// the radiance: as a path from y sees it, whose directions follow the shading normal. (Seen from
/// the light it would be the same only if the shading normal were that of the surface.)
/// `y` lies on the refracted ray. Infinite where the beam is focused.
double refraction_gain(const Vec3d& y, const SurfaceChart& at, const LightPlace& light, double eta);

}  // namespace nacre
