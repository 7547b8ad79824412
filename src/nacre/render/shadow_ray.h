#pragma once
// The ray that asks whether a drawn point of a light can be seen from a surface.
#include "nacre/scene/light.h"

namespace nacre {

struct ShadowRay {
    Point3f origin;
    Vec3f direction;
    float distance = 0.f;  ///< to the light; 1e30 to lights at infinity
};

/// From where rays leave the surface towards the light's point itself: on wide triangles they start
/// so far from `at.p` that along light.wi they would meet a round light elsewhere, before that
/// point, and it would shade itself.
inline ShadowRay shadow_ray(const SurfacePoint& at, const LightSample& light) {
    const Point3f origin = at.spawn(light.wi);
    if (light.distance >= 1e30f) return {origin, light.wi, light.distance};
    const Vec3f to = light.wi * light.distance - (origin - at.p);
    const float distance = length(to);
    if (!(distance > 0.f)) return {origin, light.wi, 0.f};
    return {origin, to * (1.f / distance), distance};
}

}  // namespace nacre
