// Guided connections of a path below a rough boundary: a direction from a collision that leads to
// where the boundary shows a light, and next-event estimation there.
//
// A path collision -> boundary -> light can be made in three ways: by a proposal and a drawn light,
// by the walk and a drawn light, by the walk and the boundary's own scattering. All three are
// weighted by the balance heuristic, here, in `connect_to_light` and in `add_emission`.
#include <cmath>

#include "nacre/optics/fresnel.h"
#include "nacre/render/first_boundary.h"
#include "nacre/render/volume_path.h"
#include "nacre/render/walk.h"

namespace nacre {

bool VolumePath::split_at_rough_boundary(const SurfacePoint& at, const Bsdf& bsdf, const Vec3f& wo,
                                         float eta, Vec2f u) {
    // The same facet, first as a mirror and then as a window. Either may send light nowhere.
    auto reflected = bsdf.sample(wo, 0.f, u), refracted = bsdf.sample(wo, 0x1.fffffep-1f, u);
    if (reflected && !(reflected->wi.z > 0.f)) reflected.reset();
    if (refracted && !(refracted->wi.z < 0.f)) refracted.reset();
    if (!reflected && !refracted) return false;
    const Vec3f h = normalize(reflected ? wo + reflected->wi : wo + refracted->wi * eta);
    const float share = fresnel_dielectric(std::abs(dot(wo, h)), eta);
    // Weights of multiple importance sampling go on with the densities of a single choice: any
    // number serves that both strategies agree on.
    if (reflected && refracted) {
        split_at_first_boundary(*this, share, 1.f - share, [&](VolumePath& reflection) {
            if (reflection.follow(at, bsdf, wo, *reflected)) reflection.trace();
        });
        return follow(at, bsdf, wo, *refracted);
    }
    throughput_ *= Spectral(reflected ? share : 1.f - share);
    return follow(at, bsdf, wo, reflected ? *reflected : *refracted);
}

void VolumePath::guided_connection(const ExitGuide::Proposal& proposal, const Walker& walker,
                                   const MediumLanes& lanes, Random& random) {
    const auto inside = proposal.sample(random);
    if (!inside) return;
    const Ray chord{walker.p, *inside};
    ++counts_.rays;
    const auto hit = scene_.rays.intersect(chord);
    if (!hit) return;
    const ShapeBinding& shape = scene_.shapes[hit->shape];
    const SurfacePoint at = scene_.rays.surface_point(chord, *hit);
    const Vec3f wo = at.shading.to_local(-*inside);
    if (shape.interior != medium_ || dot(*inside, at.ng) <= 0.f || wo.z >= 0.f) return;

    const LightChooser::Choice choice = tracer_.lights_.choose(at.p, random.next());
    if (!choice.light) return;
    const LightSample light = choice.light->sample(at.p, random.next2(), wavelengths_);
    if (!(light.pdf > 0.f) || dot(light.wi, at.ng) <= 0.f) return;
    BsdfScratch scratch;
    const BsdfValue value =
        shape.material->at(at, wavelengths_, scratch).eval_pdf(at.shading.to_local(light.wi), wo);
    if (!(max_lane(value.f * light.radiance) > 0.f)) return;
    const Connection c = connection(shadow_ray(at, light), shape.exterior, random);
    if (!(max_lane(c.kept) > 0.f)) return;

    const Spectral left = lanes.transmittance(hit->t),
                   phase(medium_->phase.eval(dot(walker.d, *inside))), kept = left * phase,
                   passing = lanes.passing(left) * phase;
    const Spectral throughput = throughput_ * lanes.survival(walker.collisions);
    const Spectral density = density_ * lanes.walk_density(walker.collisions, walker.length);
    const float guided = proposal.probability() * proposal.pdf(*inside);
    const float light_pdf = light.pdf * choice.probability;
    const float own_pdf = light.delta ? 0.f : value.pdf;
    const float total = mean_of(density * ((passing + Spectral(guided)) * Spectral(light_pdf) +
                                           passing * c.density * Spectral(own_pdf)));
    if (total > 0.f)
        result_ +=
            throughput * density * kept * value.f * c.kept * light.radiance * Spectral(1.f / total);
}

Spectral VolumePath::guided_arrival(const SurfacePoint& at, const Vec3f& wo) const {
    if (!last_collision_.valid || !medium_ || wo.z >= 0.f) return Spectral(0.f);
    const VolumePathTracer::MediumInfo& info = tracer_.info(medium_);
    if (!info.guide.active() || !info.guide.rough() || dot(ray_.d, at.ng) <= 0.f ||
        scene_.shapes[at.shape].interior != medium_)
        return Spectral(0.f);
    const DistanceGrid::Cell cell = info.grid.locate(last_collision_.p);
    if (cell.guide < 0) return Spectral(0.f);
    const ExitGuide::Proposal proposal = info.guide.at(last_collision_.p, cell.guide);
    if (!(proposal.probability() > 0.f)) return Spectral(0.f);
    const float phase = medium_->phase.eval(dot(last_collision_.d_in, ray_.d));
    return last_collision_.density *
           Spectral(proposal.probability() * proposal.pdf(ray_.d) / phase);
}

}  // namespace nacre
