#include "nacre/render/path_tracer.h"

#include <algorithm>

#include "nacre/render/surface_path.h"

namespace nacre {

namespace {

// A shadow ray stops this share of its length before the light, so that rounding cannot make the
// light shade itself.
constexpr float shadow_margin = 1e-4f;

}  // namespace

Spectral surface_transmittance(const Scene& scene, bool scene_has_null, Point3f origin,
                               const Vec3f& direction, float distance,
                               const Wavelengths& wavelengths, RayCounts& counts) {
    float left = distance * (1.f - shadow_margin);
    if (!scene_has_null) {
        ++counts.rays;
        return Spectral(scene.rays.occluded({origin, direction, 0.f, left}) ? 0.f : 1.f);
    }
    Spectral kept(1.f);
    while (left > 0.f) {
        const Ray ray{origin, direction, 0.f, left};
        ++counts.rays;
        const auto hit = scene.rays.intersect(ray);
        if (!hit) break;
        const SurfacePoint at = scene.rays.surface_point(ray, *hit);
        const Material& material = *scene.shapes[hit->shape].material;
        if (!(material.flags() & has_null)) return Spectral(0.f);
        kept *= material.null_transmission(at, at.shading.to_local(-direction), wavelengths);
        if (!(max_lane(kept) > 0.f)) return Spectral(0.f);
        const Point3f next = at.spawn(direction);
        left -= dot(next - origin, direction);
        origin = next;
    }
    return kept;
}

namespace {

bool any_null(const Scene& scene) {
    return std::ranges::any_of(
        scene.shapes, [](const ShapeBinding& s) { return s.material->flags() & has_null; });
}

}  // namespace

PathTracer::PathTracer(const Scene& scene, bool recursive_only, Estimators estimators)
    : scene_(scene),
      lights_(scene.lights, scene.rays.bounds(),
              !recursive_only && estimators != Estimators::light_only),
      recursive_only_(recursive_only),
      estimators_(estimators),
      rr_depth_(scene.integrator.rr_depth),
      has_null_(any_null(scene)) {}

PathTracer::PathTracer(const Scene& scene, Translucencies below, int rr_depth)
    : scene_(scene),
      lights_(scene.lights, scene.rays.bounds(), true),
      below_(std::move(below)),
      rr_depth_(rr_depth < 0 ? scene.integrator.rr_depth : rr_depth),
      has_null_(any_null(scene)) {}

Spectral PathTracer::radiance(const Ray& ray, Sampler& sampler, const Wavelengths& wavelengths,
                              RayCounts& counts) const {
    return SurfacePath(*this, sampler, wavelengths, counts).trace(ray);
}

Spectral PathTracer::reflected(const SurfacePoint& at, const Material& material, const Vec3f& wo,
                               Sampler& sampler, const Wavelengths& wavelengths,
                               RayCounts& counts) const {
    return SurfacePath(*this, sampler, wavelengths, counts).trace_from(at, material, wo);
}

}  // namespace nacre
