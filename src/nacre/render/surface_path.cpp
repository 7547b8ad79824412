#include "nacre/render/surface_path.h"

#include "nacre/render/first_boundary.h"
#include "nacre/render/roulette.h"
#include "nacre/render/shading_normal.h"
#include "nacre/render/shadow_walk.h"

namespace nacre {

Spectral SurfacePath::trace(const Ray& ray) {
    ray_ = ray;
    from_ = ray.o;
    follow();
    return result_;
}

Spectral SurfacePath::trace_from(const SurfacePoint& at, const Material& material,
                                 const Vec3f& wo) {
    if (within_depth(0) && scatter(at, material, wo)) follow();
    return result_;
}

void SurfacePath::follow() {
    while (within_depth(0)) {
        ++counts_.rays;
        const auto hit = scene_.rays.intersect(ray_);
        const Light* light = hit ? scene_.shapes[hit->shape].light : scene_.beyond(depth_);
        SurfacePoint at;
        if (hit) at = scene_.rays.surface_point(ray_, *hit);
        if (light && !(depth_ == 0 && scene_.integrator.hide_emitters))
            add_emission(*light, hit ? &at : nullptr);
        if (!hit) return;
        if (split_reflection_ && depth_ > 0) {
            split_reflection_ = false;
            const float chance = reflection_chance(max_lane(throughput_));
            if (!survives(chance, sampler_.next1d(), throughput_)) return;
        }
        if (!at_surface(at)) return;
    }
}

bool SurfacePath::at_surface(SurfacePoint& at) {
    if (!tracer_.below_.empty())
        if (const Translucency* below = tracer_.below_[at.shape].get()) {
            // From below one would look out through the boundary, as if the object were empty.
            if (!(dot(ray_.d, at.ng) < 0.f)) return false;
            turn_to_viewer(at, -ray_.d, below->boundary().eta() != 1.f);
            return at_translucent(at, *below, at.shading.to_local(-ray_.d));
        }
    const Material& material = *scene_.shapes[at.shape].material;
    if (!(material.flags() & transmits)) turn_to_viewer(at, -ray_.d, !material.is_lambertian());
    return scatter(at, material, at.shading.to_local(-ray_.d));
}

bool SurfacePath::at_translucent(const SurfacePoint& at, const Translucency& below,
                                 const Vec3f& wo) {
    if (const Material* rough = below.boundary().rough()) return at_rough(at, below, *rough, wo);
    const float eta = below.boundary().eta();
    const float reflected = eta == 1.f ? 0.f : fresnel_dielectric(wo.z, eta);
    if (depth_ == 0 && reflected > 0.f) {
        split_at_first_boundary(*this, reflected, 1.f - reflected, [&](SurfacePath& reflection) {
            if (reflection.reflect(at, wo)) reflection.follow();
        });
    } else if (sampler_.next1d() < reflected) {
        return reflect(at, wo);
    }
    return enter(at, below, wo);
}

bool SurfacePath::at_rough(const SurfacePoint& at, const Translucency& below, const Material& rough,
                           const Vec3f& wo) {
    // Lights below the surface are hidden by it: of the lobes the reflecting one is left.
    const Vec3f up = at.ng;
    BsdfScratch scratch;
    const Bsdf& bsdf = rough.at(at, wavelengths_, scratch);
    if (within_depth(1)) result_ += throughput_ * direct_light(at, bsdf, wo, &up);
    const float u1 = sampler_.next1d();
    const auto sample = bsdf.sample(wo, u1, sampler_.next2d());
    if (!sample || !(max_lane(sample->weight) > 0.f)) return false;
    if (sample->wi.z > 0.f) {
        throughput_ *= sample->weight;
        leave(at, at.shading.to_world(sample->wi));
        specular_bounce_ = false;
        pdf_ = sample->pdf;
        from_ = at.p;
        return goes_on();
    }
    // What emerges is the same whichever facet refracts it, so that the weight, as a share of
    // power, is an estimate of the transmittance.
    throughput_ *= sample->weight * Spectral(sample->eta * sample->eta);
    return enter(at, below, wo);
}

bool SurfacePath::enter(const SurfacePoint& at, const Translucency& below, const Vec3f& wo) {
    const Translucency::Emergence e = below.emerge(at, wo, sampler_, wavelengths_, counts_);
    result_ += throughput_ * e.radiance;
    if (!e.entry || !(max_lane(e.weight) > 0.f)) return false;
    throughput_ *= e.weight;
    return scatter(*e.entry, below.entry(), wo);
}

bool SurfacePath::reflect(const SurfacePoint& at, const Vec3f& wo) {
    leave(at, at.shading.to_world({-wo.x, -wo.y, wo.z}));
    specular_bounce_ = true;
    pdf_ = 0.f;
    return goes_on();
}

bool SurfacePath::scatter(const SurfacePoint& at, const Material& material, const Vec3f& wo) {
    BsdfScratch scratch;
    const Bsdf& bsdf = material.at(at, wavelengths_, scratch);
    if ((material.flags() & has_smooth) &&
        tracer_.estimators_ != PathTracer::Estimators::material_only && within_depth(1))
        result_ += throughput_ * direct_light(at, bsdf, wo);

    const float u1 = sampler_.next1d();
    const auto sample = bsdf.sample(wo, u1, sampler_.next2d());
    if (!sample || !(max_lane(sample->weight) > 0.f)) return false;
    if (tracer_.recursive_only_ && !sample->delta) return false;
    throughput_ *= sample->weight;
    if (sample->single_wavelength && !single_wavelength_) {
        // The other lanes would have gone elsewhere: the first goes on for all of them.
        single_wavelength_ = true;
        throughput_ *= Spectral(1.f / wavelengths_.weight[0], 0.f, 0.f, 0.f);
    }
    eta_ *= sample->eta;
    leave(at, at.shading.to_world(sample->wi));
    // A surface that light passes as if it were not there makes no difference to either.
    if (sample->null) return true;
    specular_bounce_ = sample->delta;
    pdf_ = sample->pdf;
    from_ = at.p;
    return goes_on();
}

bool SurfacePath::goes_on() {
    if (depth_ >= tracer_.rr_depth_) {
        const float chance = surface_chance(max_lane(throughput_) * eta_ * eta_);
        if (!survives(chance, sampler_.next1d(), throughput_)) return false;
    }
    ++depth_;
    return true;
}

void SurfacePath::leave(const SurfacePoint& at, const Vec3f& direction) {
    ray_ = {at.spawn(direction), direction};
}

void SurfacePath::add_emission(const Light& light, const SurfacePoint* on_light) {
    using Estimators = PathTracer::Estimators;
    const bool found_by_chance =
        specular_bounce_ ||
        (!tracer_.recursive_only_ && tracer_.estimators_ != Estimators::light_only);
    if (!found_by_chance) return;
    const Spectral emitted = light.radiance(on_light, ray_.d, wavelengths_);
    if (!(max_lane(emitted) > 0.f)) return;
    const bool alone = specular_bounce_ || tracer_.estimators_ == Estimators::material_only;
    const float light_pdf =
        alone ? 0.f
              : tracer_.lights_.probability(from_, &light) * light.pdf(from_, ray_.d, on_light);
    result_ += throughput_ * emitted * Spectral(alone ? 1.f : pdf_ / (pdf_ + light_pdf));
}

Spectral SurfacePath::direct_light(const SurfacePoint& at, const Bsdf& bsdf, const Vec3f& wo,
                                   const Vec3f* above) {
    const LightChooser::Choice choice = tracer_.lights_.choose(at.p, sampler_.next1d());
    const Vec2f u = sampler_.next2d();
    if (!choice.light) return Spectral(0.f);
    const LightSample light = choice.light->sample(at.p, u, wavelengths_);
    if (!(light.pdf > 0.f) || !(max_lane(light.radiance) > 0.f)) return Spectral(0.f);
    const Vec3f wi = at.shading.to_local(light.wi);
    if (above && !(wi.z > 0.f && dot(light.wi, *above) > 0.f)) return Spectral(0.f);
    // Recursive ray tracing never finds a light by chance, so its light samples count in full.
    const bool alone = light.delta || tracer_.recursive_only_ ||
                       tracer_.estimators_ == PathTracer::Estimators::light_only;
    const auto [f, material_pdf] =
        alone ? BsdfValue{bsdf.eval(wi, wo), 0.f} : bsdf.eval_pdf(wi, wo);
    if (!(max_lane(f) > 0.f)) return Spectral(0.f);
    const float light_pdf = light.pdf * choice.probability;
    const ShadowRay shadow = shadow_ray(at, light);
    const Spectral kept =
        surface_transmittance(scene_, tracer_.has_null_, shadow, wavelengths_, counts_);
    return f * light.radiance * kept / Spectral(light_pdf + material_pdf);
}

}  // namespace nacre
