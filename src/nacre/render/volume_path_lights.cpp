// How a path of the complete simulation meets lights: by chance, by next-event estimation, by
// guided exits.
#include <algorithm>
#include <cmath>

#include "nacre/optics/fresnel.h"
#include "nacre/render/shadow_ray.h"
#include "nacre/render/volume_path.h"
#include "nacre/render/walk.h"

namespace nacre {

namespace {

// A shadow ray stops this share of its length before the light, so that rounding cannot make the
// light shade itself.
constexpr float shadow_margin = 1e-4f;

}  // namespace

void VolumePath::add_emission(const Light& light, const SurfacePoint* on_light) {
    const Spectral emitted = light.radiance(on_light, ray_.d, wavelengths_);
    if (!(max_lane(emitted) > 0.f)) return;
    float density = mean_of(density_);
    if (partner_ == Partner::light_sampling && vertex_pdf_ > 0.f)
        density += mean_of(partner_density_) * tracer_.lights_.probability(vertex_, &light) *
                   light.pdf(vertex_, ray_.d, on_light) / vertex_pdf_;
    else if (partner_ == Partner::guided_exit)
        density += mean_of(partner_density_);
    if (density > 0.f) result_ += throughput_ * density_ * emitted * Spectral(1.f / density);
}

void VolumePath::connect_to_light(const SurfacePoint* at, const Material* material,
                                  const Vec3f& wo) {
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
        f = material->eval(*at, wo, wi, wavelengths_);
        own_pdf = material->pdf(*at, wo, wi, wavelengths_);
        shadow = shadow_ray(*at, light);
        const ShapeBinding& shape = scene_.shapes[at->shape];
        if (shape.separates_media)
            medium = dot(light.wi, at->ng) > 0.f ? shape.exterior : shape.interior;
    } else {
        own_pdf = medium_->phase.eval(dot(ray_.d, light.wi));
        f = Spectral(own_pdf);
    }
    if (!(max_lane(f) > 0.f)) return;
    const Connection c = connection(shadow.origin, shadow.direction, shadow.distance, medium);
    if (!(max_lane(c.kept) > 0.f)) return;
    const float light_pdf = light.pdf * choice.probability;
    const float density = mean_of(
        density_ * (Spectral(light_pdf) + c.density * Spectral(light.delta ? 0.f : own_pdf)));
    if (density > 0.f)
        result_ += throughput_ * density_ * f * c.kept * light.radiance * Spectral(1.f / density);
}

VolumePath::Connection VolumePath::connection(Point3f p, const Vec3f& direction, float distance,
                                              const Medium* medium) {
    Connection c{Spectral(1.f), Spectral(1.f)};
    float left = distance * (1.f - shadow_margin);
    Random& random = sampler_.random();
    while (left > 0.f) {
        const Ray ray{p, direction, 0.f, left};
        ++counts_.rays;
        if (!tracer_.has_null_ && !medium) return scene_.rays.occluded(ray) ? Connection{} : c;
        const auto hit = scene_.rays.intersect(ray);
        const Material* material = hit ? scene_.shapes[hit->shape].material.get() : nullptr;
        if (material && !(material->flags() & has_null)) return {};
        const float segment = hit ? hit->t : left;
        if (medium && medium->homogeneous()) {
            const Spectral t =
                MediumLanes(medium->coefficients(p, wavelengths_), wavelengths_, hero_)
                    .transmittance(segment);
            c.kept *= t;
            c.density *= t;
        } else if (medium) {
            // Ratio tracking (Novak, Selle, Jarosz 2014).
            MajorantSegments segments(tracer_.info(medium).majorants, *medium, ray, segment,
                                      wavelengths_);
            while (const auto s = segments.next()) {
                if (!(s->majorant > 0.f)) continue;
                for (float t = s->begin;;) {
                    t += -fast_log(1.f - random.next()) / s->majorant;
                    if (t >= s->end) break;
                    const Spectral passed =
                        max(Spectral(0.f),
                            Spectral(1.f) -
                                medium->coefficients(p + direction * t, wavelengths_).sigma_t *
                                    Spectral(1.f / s->majorant));
                    c.kept *= passed;
                    c.density *= passed;
                }
            }
        }
        if (!hit || !(max_lane(c.kept) > 0.f)) break;
        const SurfacePoint at = scene_.rays.surface_point(ray, *hit);
        const Spectral passing =
            material->null_transmission(at, at.shading.to_local(-direction), wavelengths_);
        c.kept *= passing;
        c.density *= Spectral(mean_of(passing));
        const ShapeBinding& shape = scene_.shapes[hit->shape];
        if (shape.separates_media)
            medium = dot(direction, at.ng) > 0.f ? shape.exterior : shape.interior;
        const Point3f next = at.spawn(direction);
        left -= dot(next - p, direction);
        p = next;
    }
    return c;
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
    const Spectral kept = lanes.transmittance(hit->t);
    const float phase = medium_->phase.eval(dot(walker.d, *inside));
    const Spectral throughput = throughput_ * lanes.survival(walker.collisions);
    const Spectral density = density_ * lanes.walk_density(walker.collisions, walker.length);
    const float guided = proposal.probability() * proposal.pdf(*inside);
    const float total =
        mean_of(density * (kept * Spectral(phase * transmittance) + Spectral(guided)));
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
    partner_ = Partner::guided_exit;
    partner_density_ =
        last_collision_.density *
        Spectral(proposal.probability() * proposal.pdf(ray_.d) / (phase * transmittance));
}

}  // namespace nacre
