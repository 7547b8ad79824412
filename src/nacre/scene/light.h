#pragma once
// Lights as the integrators see them: drawn towards a point, or met by a ray.
#include <memory>

#include "nacre/geometry/ray_scene.h"
#include "nacre/spectrum/wavelengths.h"

namespace nacre {

/// A direction towards a light from a given point.
struct LightSample {
    Vec3f wi;              ///< unit vector from the point to the light
    float distance = 0.f;  ///< to the light; 1e30 for lights at infinity
    Spectral radiance;  ///< arriving if nothing is in between; for delta lights the irradiance on a
                        ///< surface facing wi
    float pdf = 0.f;    ///< per solid angle; 1 for delta lights
    bool delta = false;  ///< no ray could have found it by chance
};

class Light {
  public:
    virtual ~Light() = default;
    /// Draws a direction from `from` to the light; pdf = 0 if the light does not reach the point.
    virtual LightSample sample(const Point3f& from, Vec2f u,
                               const Wavelengths& wavelengths) const = 0;
    /// Density with which `sample` would have drawn the unit direction `wi` from `from`. For area
    /// lights `on_light` is the point of the light that the ray met; it is null for lights at
    /// infinity.
    virtual float pdf(const Point3f& from, const Vec3f& wi, const SurfacePoint* on_light) const = 0;
    /// Radiance that leaves the light at `on_light` (null at infinity) against a ray that travels
    /// along `direction`.
    virtual Spectral radiance(const SurfacePoint* on_light, const Vec3f& direction,
                              const Wavelengths& wavelengths) const = 0;
    /// Rough total power in luminance, for choosing among lights; > 0 if the light shines at all.
    virtual float power() const = 0;
    /// True for lights met by rays that leave the scene (constant, envmap).
    virtual bool is_infinite() const { return false; }
    virtual bool is_delta() const { return false; }
    /// True for an infinite light that is the same in all directions: a path that goes on by itself
    /// samples it as well as can be.
    virtual bool is_uniform() const { return false; }
    /// Bounds of where light leaves from; empty for lights at infinity (directional included).
    virtual Box3f bounds() const = 0;
    virtual bool is_spectral() const { return false; }
};
using LightPtr = std::shared_ptr<const Light>;

}  // namespace nacre
