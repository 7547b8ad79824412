#include "nacre/render/path_tracer.h"

#include "nacre/render/shadow_walk.h"
#include "nacre/render/surface_path.h"

namespace nacre {

PathTracer::PathTracer(const Scene& scene, bool recursive_only, Estimators estimators)
    : scene_(scene),
      lights_(scene.lights, scene.rays.bounds(),
              !recursive_only && estimators != Estimators::light_only),
      recursive_only_(recursive_only),
      estimators_(estimators),
      rr_depth_(scene.integrator.rr_depth),
      has_null_(has_null_surfaces(scene)) {}

PathTracer::PathTracer(const Scene& scene, Translucencies below, int rr_depth)
    : scene_(scene),
      lights_(scene.lights, scene.rays.bounds(), true),
      below_(std::move(below)),
      rr_depth_(rr_depth < 0 ? scene.integrator.rr_depth : rr_depth),
      has_null_(has_null_surfaces(scene)) {}

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
