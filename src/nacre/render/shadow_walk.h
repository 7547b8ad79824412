#pragma once
// The way of a shadow ray from a point to a light: through surfaces that let light pass straight on
// and the matter between them, to the first surface that lets nothing pass.
#include "nacre/render/integrator.h"
#include "nacre/render/shadow_ray.h"

namespace nacre {

/// Whether some surface of the scene lets light pass straight on. Where none does, a shadow ray
/// need not know what it meets.
bool has_null_surfaces(const Scene& scene);

/// Whether the light is reached. `way` says what lies on it; it keeps what is left of the light:
///   bool opaque_only()                      nothing but opaque surfaces can lie on it
///   bool passes(const ShapeBinding&)        whether a surface lets anything pass
///   bool segment(const Ray&, float length)  the matter on a straight piece
///   bool surface(const ShapeBinding&, const SurfacePoint&, const Vec3f& d)
///                                           a surface that lets pass; d is the ray's direction
/// The last two return false if nothing is left. Whether a surface lets pass is asked before the
/// segment that leads to it.
template <class Way>
bool walk_to_light(const Scene& scene, const ShadowRay& shadow, RayCounts& counts, Way& way) {
    // Stops a little before the light, lest rounding make it shade itself.
    constexpr float margin = 1e-4f;
    Ray ray{shadow.origin, shadow.direction, 0.f, shadow.distance * (1.f - margin)};
    while (ray.tmax > 0.f) {
        ++counts.rays;
        if (way.opaque_only()) return !scene.rays.occluded(ray);
        const auto hit = scene.rays.intersect(ray);
        const ShapeBinding* shape = hit ? &scene.shapes[hit->shape] : nullptr;
        if (shape && !way.passes(*shape)) return false;
        if (!way.segment(ray, hit ? hit->t : ray.tmax)) return false;
        if (!shape) return true;
        const SurfacePoint at = scene.rays.surface_point(ray, *hit);
        if (!way.surface(*shape, at, ray.d)) return false;
        const Point3f next = at.spawn(ray.d);
        ray.tmax -= dot(next - ray.o, ray.d);
        ray.o = next;
    }
    return true;
}

/// Share of the light that a shadow ray keeps: 0 behind opaque surfaces, the product of null
/// transmissions otherwise. Media are not considered.
Spectral surface_transmittance(const Scene& scene, bool scene_has_null, const ShadowRay& shadow,
                               const Wavelengths& wavelengths, RayCounts& counts);

}  // namespace nacre
