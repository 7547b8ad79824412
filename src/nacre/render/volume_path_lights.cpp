// How a path of the complete simulation meets lights by chance and by next-event estimation.
#include <cmath>

#include "nacre/render/shadow_walk.h"
#include "nacre/render/way_to_light.h"

namespace nacre {

void VolumePath::add_emission(const Light& light, const SurfacePoint* on_light) {
    const Spectral emitted = light.radiance(on_light, ray_.d, wavelengths_);
    if (!(max_lane(emitted) > 0.f)) return;
    float density = mean_of(density_);
    if (other_strategy_ == Strategy::light_sampling && vertex_pdf_ > 0.f)
        density += mean_of(other_density_) * vertex_lights_->probability(vertex_, &light) *
                   light.pdf(vertex_, ray_.d, on_light) / vertex_pdf_;
    else if (other_strategy_ == Strategy::guided_exit)
        density += mean_of(other_density_);
    if (density > 0.f) result_ += throughput_ * density_ * emitted * Spectral(1.f / density);
}

void VolumePath::connect_to_light(const SurfacePoint* at, const Bsdf* bsdf, const Vec3f& wo) {
    const Point3f from = at ? at->p : ray_.o;
    const LightChooser& lights = at ? tracer_.lights_ : reachable();
    const LightChooser::Choice choice =
        lights.choose(from, at ? sampler_.next1d() : sampler_.random().next());
    const Vec2f u = at ? sampler_.next2d() : sampler_.random().next2();
    if (!choice.light) return;
    const LightSample light = choice.light->sample(from, u, wavelengths_);
    if (!(light.pdf > 0.f) || !(max_lane(light.radiance) > 0.f)) return;

    Spectral f;
    float own_pdf;
    const Medium* medium = medium_;
    ShadowRay shadow{from, light.wi, light.distance};
    if (at) {
        const Vec3f wi = at->shading.to_local(light.wi);
        const BsdfValue value = bsdf->eval_pdf(wi, wo);
        f = value.f;
        own_pdf = value.pdf;
        shadow = shadow_ray(*at, light);
        const ShapeBinding& shape = scene_.shapes[at->shape];
        if (shape.separates_media)
            medium = dot(light.wi, at->ng) > 0.f ? shape.exterior : shape.interior;
    } else {
        own_pdf = medium_->phase.eval(dot(ray_.d, light.wi));
        f = Spectral(own_pdf);
    }
    if (!(max_lane(f) > 0.f)) return;
    const Connection c = connection(shadow, medium, sampler_.random());
    if (!(max_lane(c.kept) > 0.f)) return;
    const float light_pdf = light.pdf * choice.probability;
    float density = mean_of(
        density_ * (Spectral(light_pdf) + c.density * Spectral(light.delta ? 0.f : own_pdf)));
    // At a rough boundary the same light might have been drawn after a guided arrival.
    if (at) density += mean_of(guided_) * light_pdf;
    if (density > 0.f)
        result_ += throughput_ * density_ * f * c.kept * light.radiance * Spectral(1.f / density);
}

VolumePath::Connection VolumePath::connection(const ShadowRay& shadow, const Medium* medium,
                                              Random& random) {
    WayToLight way{*this, medium, random};
    return walk_to_light(scene_, shadow, counts_, way) ? way.c : Connection{};
}

}  // namespace nacre
