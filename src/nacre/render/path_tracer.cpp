#include "nacre/render/path_tracer.h"

#include <algorithm>

#include "nacre/render/roulette.h"

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

PathTracer::PathTracer(const Scene& scene, bool recursive_only, Estimators estimators)
    : scene_(scene),
      lights_(scene.lights, scene.rays.bounds(),
              !recursive_only && estimators != Estimators::light_only),
      recursive_only_(recursive_only),
      estimators_(estimators),
      has_null_(std::ranges::any_of(
          scene.shapes, [](const ShapeBinding& s) { return s.material->flags() & has_null; })) {}

Spectral PathTracer::direct_light(const SurfacePoint& at, const Material& material, const Vec3f& wo,
                                  Sampler& sampler, const Wavelengths& wavelengths,
                                  RayCounts& counts) const {
    const LightChooser::Choice choice = lights_.choose(at.p, sampler.next1d());
    const Vec2f u = sampler.next2d();
    if (!choice.light) return Spectral(0.f);
    const LightSample light = choice.light->sample(at.p, u, wavelengths);
    if (!(light.pdf > 0.f) || !(max_lane(light.radiance) > 0.f)) return Spectral(0.f);
    const Vec3f wi = at.shading.to_local(light.wi);
    const Spectral f = material.eval(at, wo, wi, wavelengths);
    if (!(max_lane(f) > 0.f)) return Spectral(0.f);
    const float light_pdf = light.pdf * choice.probability;
    // Recursive ray tracing never finds a light by chance, so its light samples count in full.
    const bool alone = light.delta || recursive_only_ || estimators_ == Estimators::light_only;
    const float material_pdf = alone ? 0.f : material.pdf(at, wo, wi, wavelengths);
    const Spectral kept = surface_transmittance(scene_, has_null_, at.spawn(light.wi), light.wi,
                                                light.distance, wavelengths, counts);
    return f * light.radiance * kept / Spectral(light_pdf + material_pdf);
}

Spectral PathTracer::radiance(const Ray& camera_ray, Sampler& sampler,
                              const Wavelengths& wavelengths, RayCounts& counts) const {
    const IntegratorSettings& settings = scene_.integrator;
    Ray ray = camera_ray;
    Spectral result(0.f), throughput(1.f);
    float eta = 1.f;
    bool single_wavelength = false;
    // How the ray got its direction: density of the last smooth choice, and the point it was made
    // at. `certain` after the camera and after mirrors, where light samples had no part.
    bool certain = true;
    float pdf = 0.f;
    Point3f from = ray.o;

    int depth = 0;
    while (settings.max_depth < 0 || depth < settings.max_depth) {
        ++counts.rays;
        const auto hit = scene_.rays.intersect(ray);
        const Light* light = hit ? scene_.shapes[hit->shape].light : scene_.environment;
        SurfacePoint at;
        if (hit) at = scene_.rays.surface_point(ray, *hit);

        const bool found_by_chance =
            certain || (!recursive_only_ && estimators_ != Estimators::light_only);
        if (light && found_by_chance && !(depth == 0 && settings.hide_emitters)) {
            const SurfacePoint* on_light = hit ? &at : nullptr;
            const Spectral emitted = light->radiance(on_light, ray.d, wavelengths);
            if (max_lane(emitted) > 0.f) {
                const bool alone = certain || estimators_ == Estimators::material_only;
                const float light_pdf =
                    alone ? 0.f
                          : lights_.probability(from, light) * light->pdf(from, ray.d, on_light);
                result += throughput * emitted * Spectral(alone ? 1.f : pdf / (pdf + light_pdf));
            }
        }
        if (!hit) break;

        const Material& material = *scene_.shapes[hit->shape].material;
        const Vec3f wo = at.shading.to_local(-ray.d);
        if ((material.flags() & has_smooth) && estimators_ != Estimators::material_only &&
            (settings.max_depth < 0 || depth + 1 < settings.max_depth))
            result += throughput * direct_light(at, material, wo, sampler, wavelengths, counts);

        const float u1 = sampler.next1d();
        const auto sample = material.sample(at, wo, u1, sampler.next2d(), wavelengths);
        if (!sample || !(max_lane(sample->weight) > 0.f)) break;
        if (recursive_only_ && !sample->delta) break;
        throughput *= sample->weight;
        if (sample->single_wavelength && !single_wavelength) {
            // The other lanes would have gone elsewhere: the first goes on for all of them.
            single_wavelength = true;
            throughput *= Spectral(1.f / wavelengths.weight[0], 0.f, 0.f, 0.f);
        }
        eta *= sample->eta;
        ray.d = at.shading.to_world(sample->wi);
        ray.o = at.spawn(ray.d);
        ray.tmin = 0.f;
        ray.tmax = 1e30f;
        // A surface that light passes as if it were not there makes no difference to either.
        if (sample->null) continue;
        certain = sample->delta;
        pdf = sample->pdf;
        from = at.p;
        if (depth >= settings.rr_depth && !survives(throughput, eta, sampler.next1d(), throughput))
            break;
        ++depth;
    }
    return result;
}

}  // namespace nacre
