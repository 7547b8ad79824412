// Guided exits of a path: a direction from a collision that leads out towards a light.
//
// Through a smooth boundary the light is what is met there. A path collision -> boundary -> light
// can be made by a proposal or by the walk; both are weighted by the balance heuristic, here and in
// `add_emission`. At a rough boundary the light is drawn, and the path can be made in three ways: by
// a proposal and a drawn light, by the walk and a drawn light, by the walk and the boundary's own
// scattering. All three are weighted, here, in `connect_to_light` and in `add_emission`.
//
// Which of the two a chord leads to is found by tracing it; proposals know nothing of it, and their
// density serves both.
#include <cmath>

#include "nacre/optics/fresnel.h"
#include "nacre/render/way_to_light.h"

namespace nacre {

using Exit = VolumePathTracer::Exit;

void VolumePath::guided_exit(const Collision& from, std::int32_t cell, Random& random) {
    const ExitGuide::Proposal proposal = piece_->proposal(from.p, cell);
    if (!(random.next() < proposal.probability())) return;
    const auto inside = proposal.sample(random);
    if (!inside) return;
    const Ray chord{from.p, *inside};
    ++counts_.rays;
    const auto hit = scene_.rays.intersect(chord);
    if (!hit || scene_.shapes[hit->shape].interior != medium_) return;
    const Exit exit = tracer_.exit(hit->shape);
    if (exit == Exit::none) return;
    const SurfacePoint at = scene_.rays.surface_point(chord, *hit);
    if (dot(*inside, at.ng) <= 0.f) return;
    const float guided = proposal.probability() * proposal.pdf(*inside);
    if (exit == Exit::smooth)
        exit_smoothly(from, chord, hit->t, at, guided, random);
    else
        exit_roughly(from, chord, hit->t, at, guided, random);
}

VolumePath::Carried VolumePath::carried(const Collision& from, const Ray& chord, float length,
                                        Random& random) {
    if (!from.lanes) {
        WayToLight way{*this, medium_, random};
        way.segment(chord, length);
        return {throughput_, density_, way.c.kept, way.c.density};
    }
    const Spectral kept = from.lanes->transmittance(length);
    return {throughput_ * from.lanes->survival(from.collisions),
            density_ * from.lanes->walk_density(from.collisions, from.length), kept,
            from.lanes->passing(kept)};
}

void VolumePath::exit_smoothly(const Collision& from, const Ray& chord, float length,
                               const SurfacePoint& at, float guided, Random& random) {
    const ShapeBinding& shape = scene_.shapes[at.shape];
    const float eta = shape.material->smooth_boundary_eta();
    const float cos_in = dot(chord.d, at.shading.n);
    if (cos_in <= 0.f) return;

    // The true boundary refracts the proposed direction outwards, as the walk would at this place.
    const float sin2_out = eta * eta * (1.f - cos_in * cos_in);
    if (sin2_out >= 1.f) return;
    const float cos_out = std::sqrt(1.f - sin2_out);
    const Vec3f outside = (chord.d - at.shading.n * cos_in) * eta + at.shading.n * cos_out;
    const float transmittance = 1.f - fresnel_dielectric(cos_out, eta);
    if (dot(outside, at.ng) <= 0.f) return;

    const Ray out{at.spawn(outside), outside};
    ++counts_.rays;
    const auto met = scene_.rays.intersect(out);
    const Light* light = met ? scene_.shapes[met->shape].light : scene_.environment;
    if (!light) return;
    SurfacePoint on_light;
    if (met) on_light = scene_.rays.surface_point(out, *met);
    const Spectral emitted = light->radiance(met ? &on_light : nullptr, outside, wavelengths_);
    if (!(max_lane(emitted) > 0.f)) return;

    // Radiance grows by eta^2 on its way in. Both strategies' densities at the collision, for each
    // lane.
    Carried c = carried(from, chord, length, random);
    if (shape.exterior) {
        WayToLight way{*this, shape.exterior, random};
        if (!way.segment(out, met ? met->t : 1e30f)) return;
        c.kept *= way.c.kept;
        c.passing *= way.c.density;
    }
    const float phase = medium_->phase.eval(dot(from.d, chord.d));
    const float total =
        mean_of(c.density * (c.passing * Spectral(phase * transmittance) + Spectral(guided)));
    if (!(total > 0.f)) return;
    result_ += c.throughput * c.density * c.kept * emitted *
               Spectral(phase * transmittance * eta * eta / total);
}

void VolumePath::exit_roughly(const Collision& from, const Ray& chord, float length,
                              const SurfacePoint& at, float guided, Random& random) {
    const Vec3f wo = at.shading.to_local(-chord.d);
    if (wo.z >= 0.f) return;
    const ShapeBinding& shape = scene_.shapes[at.shape];
    const LightChooser::Choice choice = tracer_.lights_.choose(at.p, random.next());
    if (!choice.light) return;
    const LightSample light = choice.light->sample(at.p, random.next2(), wavelengths_);
    if (!(light.pdf > 0.f) || dot(light.wi, at.ng) <= 0.f) return;
    BsdfScratch scratch;
    const BsdfValue value =
        shape.material->at(at, wavelengths_, scratch).eval_pdf(at.shading.to_local(light.wi), wo);
    if (!(max_lane(value.f * light.radiance) > 0.f)) return;
    const Connection way = connection(shadow_ray(at, light), shape.exterior, random);
    if (!(max_lane(way.kept) > 0.f)) return;

    const Carried c = carried(from, chord, length, random);
    const Spectral phase(medium_->phase.eval(dot(from.d, chord.d))), kept = c.kept * phase,
                                                                     passing = c.passing * phase;
    const float light_pdf = light.pdf * choice.probability;
    const float own_pdf = light.delta ? 0.f : value.pdf;
    const float total = mean_of(c.density * ((passing + Spectral(guided)) * Spectral(light_pdf) +
                                             passing * way.density * Spectral(own_pdf)));
    if (total > 0.f)
        result_ += c.throughput * c.density * kept * value.f * way.kept * light.radiance *
                   Spectral(1.f / total);
}

float VolumePath::guided_density() const {
    const DistanceGrid::Cell cell = piece_->grid.locate(last_collision_.p);
    if (cell.guide < 0) return 0.f;
    const ExitGuide::Proposal proposal = piece_->proposal(last_collision_.p, cell.guide);
    return proposal.probability() > 0.f ? proposal.probability() * proposal.pdf(ray_.d) : 0.f;
}

Spectral VolumePath::guided_arrival(const SurfacePoint& at, const Vec3f& wo) const {
    if (!last_collision_.valid || !medium_ || wo.z >= 0.f || dot(ray_.d, at.ng) <= 0.f ||
        tracer_.exit(at.shape) != Exit::rough || scene_.shapes[at.shape].interior != medium_)
        return Spectral(0.f);
    const float guided = guided_density();
    if (!(guided > 0.f)) return Spectral(0.f);
    const float phase = medium_->phase.eval(dot(last_collision_.d_in, ray_.d));
    return last_collision_.density * Spectral(guided / phase);
}

void VolumePath::expect_guided_exit(const SurfacePoint& at, float transmittance) {
    // The path leaves right after a collision, as a guided exit at that collision might have made
    // it do.
    if (!medium_ || tracer_.exit(at.shape) != Exit::smooth ||
        scene_.shapes[at.shape].interior != medium_)
        return;
    const float guided = guided_density();
    if (!(guided > 0.f)) return;
    const float phase = medium_->phase.eval(dot(last_collision_.d_in, ray_.d));
    other_strategy_ = Strategy::guided_exit;
    other_density_ = last_collision_.density * Spectral(guided / (phase * transmittance));
}

}  // namespace nacre
