#include "nacre/subsurface/single_scattering.h"

#include "nacre/bssrdf/single_scattering.h"
#include "nacre/render/path_state.h"
#include "nacre/render/shadow_walk.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {

SingleScatteringTerm::SingleScatteringTerm(const Scene& scene, std::uint32_t shape,
                                           const ObjectBoundary& boundary)
    : scene_(scene),
      medium_(*scene.shapes[shape].interior),
      shape_(shape),
      boundary_(boundary),
      eta_(boundary.eta()),
      lights_(scene.lights, scene.rays.bounds()),
      has_null_(has_null_surfaces(scene)) {}

Spectral SingleScatteringTerm::radiance(const SurfacePoint& exit, const Vec3f& wo, Sampler& sampler,
                                        const Wavelengths& w, RayCounts& counts) const {
    const int hero = draw_hero(w, sampler);
    const MediumLanes lanes(medium_.coefficients(exit.p, w), w, hero);
    const float u = sampler.next1d();
    const float u_light = sampler.next1d();
    const Vec2f u_place = sampler.next2d();
    if (!(lanes.hero_sigma > 0.f)) return Spectral(0.f);

    // A place on the refracted view ray, before it leaves the object again.
    const Vec3f inwards = exit.shading.to_world(refract(wo, Vec3f{0.f, 0.f, 1.f}, eta_));
    const float s = sample_scattering_distance(lanes.hero_sigma, u);
    const Point3f start = exit.spawn(inwards);
    ++counts.rays;
    if (scene_.rays.occluded({start, inwards, 0.f, s})) return Spectral(0.f);
    const Point3f p = start + inwards * s;
    const Spectral transmittance = lanes.transmittance(s);
    const float density = mean(lanes.sigma_t * transmittance, w);

    const LightChooser::Choice choice = lights_.choose(p, u_light);
    if (!choice.light) return Spectral(0.f);
    const LightSample light = choice.light->sample(p, u_place, w);
    if (!(light.pdf > 0.f) || !(max_lane(light.radiance) > 0.f)) return Spectral(0.f);
    const Ray way_out{p, light.wi, 0.f, light.distance};
    ++counts.rays;
    const auto hit = scene_.rays.intersect(way_out);
    if (!hit || hit->shape != shape_) return Spectral(0.f);
    const SurfacePoint entry = scene_.rays.surface_point(way_out, *hit);
    const float cos_i = dot(light.wi, entry.shading.n);
    if (!(cos_i > 0.f) || !(dot(light.wi, entry.ng) > 0.f)) return Spectral(0.f);
    const float mu_i = refracted_cosine(cos_i, eta_);
    const Point3f outside = entry.spawn(light.wi);
    const ShadowRay shadow{outside, light.wi, light.distance - dot(outside - p, light.wi)};
    const Spectral kept = surface_transmittance(scene_, has_null_, shadow, w, counts);
    if (!(max_lane(kept) > 0.f)) return Spectral(0.f);

    const float s_i = refracted_light_distance(hit->t, cos_i, eta_);
    const Vec3f to_light =
        (light.wi - entry.shading.n * cos_i) * (1.f / eta_) + entry.shading.n * mu_i;
    const float phase = medium_.phase.eval(dot(to_light, inwards));
    const float through = boundary_.transmittance(cos_i) / (eta_ * eta_) * cos_i / mu_i;
    return lanes.sigma_t * lanes.albedo * transmittance * lanes.transmittance(s_i) * kept *
           light.radiance * Spectral(phase * through / (density * light.pdf * choice.probability));
}

std::shared_ptr<const SingleScatteringTerm> single_scattering_of(const ShapeInput& in,
                                                                 bool profile_includes_it) {
    const auto choice = in.options.choice<SingleScatteringChoice>("single_scattering");
    if (choice == SingleScatteringChoice::off ||
        (choice == SingleScatteringChoice::automatic && profile_includes_it))
        return nullptr;
    return std::make_shared<SingleScatteringTerm>(in.scene, in.shape, in.boundary);
}

}  // namespace nacre
