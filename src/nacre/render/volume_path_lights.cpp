// How a path of the complete simulation meets lights: by chance, by next-event estimation, by
// guided exits.
#include <algorithm>
#include <cmath>

#include "nacre/optics/fresnel.h"
#include "nacre/render/shadow_walk.h"
#include "nacre/render/volume_path.h"
#include "nacre/render/walk.h"

namespace nacre {

void VolumePath::add_emission(const Light& light, const SurfacePoint* on_light) {
    const Spectral emitted = light.radiance(on_light, ray_.d, wavelengths_);
    if (!(max_lane(emitted) > 0.f)) return;
    float density = mean_of(density_);
    if (other_strategy_ == Strategy::light_sampling && vertex_pdf_ > 0.f)
        density += mean_of(other_density_) * tracer_.lights_.probability(vertex_, &light) *
                   light.pdf(vertex_, ray_.d, on_light) / vertex_pdf_;
    else if (other_strategy_ == Strategy::guided_exit)
        density += mean_of(other_density_);
    if (density > 0.f) result_ += throughput_ * density_ * emitted * Spectral(1.f / density);
}

void VolumePath::connect_to_light(const SurfacePoint* at, const Bsdf* bsdf, const Vec3f& wo) {
    const Point3f from = at ? at->p : ray_.o;
    const LightChooser::Choice choice =
        tracer_.lights_.choose(from, at ? sampler_.next1d() : sampler_.random().next());
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

/// What lies on the way of a shadow ray: surfaces that let pass, and the media between them.
struct VolumePath::WayToLight {
    VolumePath& path;
    const Medium* medium;
    Random& random;
    Connection c{Spectral(1.f), Spectral(1.f)};

    bool opaque_only() const { return !path.tracer_.has_null_ && !medium; }
    bool passes(const ShapeBinding& shape) const { return shape.material->flags() & has_null; }
    bool segment(const Ray& ray, float length) {
        if (medium && medium->homogeneous()) {
            const MediumLanes lanes = path.lanes_of(*medium, ray.o);
            const Spectral t = lanes.transmittance(length);
            c.kept *= t;
            c.density *= lanes.passing(t);
        } else if (medium) {
            ratio_tracking(ray, length);
        }
        return max_lane(c.kept) > 0.f;
    }
    bool surface(const ShapeBinding& shape, const SurfacePoint& at, const Vec3f& d) {
        BsdfScratch scratch;
        const Spectral passing = shape.material->at(at, path.wavelengths_, scratch)
                                     .null_transmission(at.shading.to_local(-d));
        c.kept *= passing;
        c.density *= Spectral(path.mean_of(passing));
        if (shape.separates_media) medium = dot(d, at.ng) > 0.f ? shape.exterior : shape.interior;
        return true;
    }

    // Novak, Selle, Jarosz 2014, Residual Ratio Tracking for Estimating Attenuation in
    // Participating Media, TOG 33(6).
    void ratio_tracking(const Ray& ray, float length) {
        const VolumePathTracer::MediumInfo& info = path.tracer_.info(medium);
        const VolumeTracking tracking(info, *medium, path.wavelengths_);
        c.kept *= tracking.remaining(ray, length);
        MajorantSegments segments(info.majorants, *medium, ray, length, path.wavelengths_);
        while (const auto s = segments.next()) {
            const float majorant = s->majorant * tracking.largest;
            if (!(majorant > 0.f)) continue;
            for (float t = s->begin;;) {
                t += -fast_log(1.f - random.next()) / majorant;
                if (t >= s->end) break;
                const Spectral sigma_t =
                    medium->coefficients(ray.o + ray.d * t, path.wavelengths_).sigma_t;
                const Spectral passed =
                    max(Spectral(0.f),
                        Spectral(1.f) - sigma_t * tracking.tracked * Spectral(1.f / majorant));
                c.kept *= passed;
                c.density *= passed;
            }
        }
    }
};

VolumePath::Connection VolumePath::connection(const ShadowRay& shadow, const Medium* medium,
                                              Random& random) {
    WayToLight way{*this, medium, random};
    return walk_to_light(scene_, shadow, counts_, way) ? way.c : Connection{};
}

void VolumePath::guided_exit(const ExitGuide::Proposal& proposal, const Walker& walker,
                             const MediumLanes& lanes, Random& random) {
    const auto inside = proposal.sample(random);
    if (!inside) return;
    const Ray chord{walker.p, *inside};
    ++counts_.rays;
    const auto hit = scene_.rays.intersect(chord);
    if (!hit) return;
    const ShapeBinding& shape = scene_.shapes[hit->shape];
    const float eta = shape.material->smooth_boundary_eta();
    const SurfacePoint at = scene_.rays.surface_point(chord, *hit);
    const float cos_in = dot(*inside, at.shading.n);
    if (shape.interior != medium_ || !(eta > 0.f) || dot(*inside, at.ng) <= 0.f || cos_in <= 0.f)
        return;

    // The true boundary refracts the proposed direction outwards, as the walk would at this place.
    const float sin2_out = eta * eta * (1.f - cos_in * cos_in);
    if (sin2_out >= 1.f) return;
    const float cos_out = std::sqrt(1.f - sin2_out);
    const Vec3f outside = (*inside - at.shading.n * cos_in) * eta + at.shading.n * cos_out;
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
    const Spectral kept = lanes.transmittance(hit->t), passing = lanes.passing(kept);
    const float phase = medium_->phase.eval(dot(walker.d, *inside));
    const Spectral throughput = throughput_ * lanes.survival(walker.collisions);
    const Spectral density = density_ * lanes.walk_density(walker.collisions, walker.length);
    const float guided = proposal.probability() * proposal.pdf(*inside);
    const float total =
        mean_of(density * (passing * Spectral(phase * transmittance) + Spectral(guided)));
    if (!(total > 0.f)) return;
    result_ +=
        throughput * density * kept * emitted * Spectral(phase * transmittance * eta * eta / total);
}

void VolumePath::expect_guided_exit(float transmittance) {
    // The path leaves right after a collision, as a guided exit at that collision might have made
    // it do.
    const VolumePathTracer::MediumInfo* info = medium_ ? &tracer_.info(medium_) : nullptr;
    if (!info || !info->guide.active()) return;
    const DistanceGrid::Cell cell = info->grid.locate(last_collision_.p);
    if (cell.guide < 0) return;
    const ExitGuide::Proposal proposal = info->guide.at(last_collision_.p, cell.guide);
    if (!(proposal.probability() > 0.f)) return;
    const float phase = medium_->phase.eval(dot(last_collision_.d_in, ray_.d));
    other_strategy_ = Strategy::guided_exit;
    other_density_ =
        last_collision_.density *
        Spectral(proposal.probability() * proposal.pdf(ray_.d) / (phase * transmittance));
}

}  // namespace nacre
