#include "nacre/render/volume_path.h"

#include <algorithm>
#include <cmath>

#include "nacre/render/first_boundary.h"
#include "nacre/render/roulette.h"
#include "nacre/render/shading_normal.h"
#include "nacre/render/walk.h"

namespace nacre {

struct VolumePath::WalkSurroundings {
    VolumePath& path;
    const VolumePathTracer::MediumInfo& info;
    const VolumePathTracer::Piece& piece;
    const MediumLanes& lanes;
    // A stream of its own: the walk's numbers have already decided where the collision is, and a
    // proposal must not know them.
    Random random;
    std::optional<Hit> hit{};

    DistanceGrid::Cell locate(const Point3f& p) const { return piece.grid.locate(p); }

    bool surface(const Point3f& p, const Vec3f& d, float s, float& t) {
        ++path.counts_.rays;
        hit = path.scene_.rays.intersect({p, d, 0.f, s});
        if (hit) t = hit->t;
        return hit.has_value();
    }

    void collided(const Walker& w, const DistanceGrid::Cell& cell) {
        if (!path.within_depth(static_cast<int>(w.collisions) + 1)) return;
        if (!path.tracer_.beams_.empty()) connect_through_boundary(w, cell.clearance);
        if (cell.guide >= 0)
            path.guided_exit({w.p, w.d, &lanes, w.collisions, w.length}, cell.guide, random);
    }

    void connect_through_boundary(const Walker& w, float clearance) {
        const Reach reach = draw_reach(lanes, random);
        // Light from the boundary comes at least as far as the boundary is away.
        const bool near = reach.length > clearance;
        bool chain = info.chain_chance > 0.f && random.next() < info.chain_chance &&
                     path.within_depth(static_cast<int>(w.collisions) + 2);
        // Numbers of its own, lest what is known of distances decide over those of later collisions.
        const bool by_reach = chain && info.chain_by_reach;
        Random own = by_reach ? Random(random.next_bits()) : random;
        chain &= near || !by_reach;
        if (!near && !chain) return;
        const Spectral density = path.density_ * lanes.walk_density(w.collisions, w.length);
        const Spectral carried = path.throughput_ * lanes.survival(w.collisions) * density *
                                 Spectral(1.f / path.mean_of(density));
        if (near) path.connect_collision_through_boundary(w.p, w.d, carried, reach, random);
        if (chain)
            path.connect_collision_by_chain(w.p, w.d, carried * Spectral(1.f / info.chain_chance),
                                            by_reach ? reach : Reach{}, by_reach ? own : random);
    }
};

VolumePath::VolumePath(const VolumePathTracer& tracer, const Ray& ray, Sampler& sampler,
                       const Wavelengths& wavelengths, RayCounts& counts)
    : tracer_(tracer),
      scene_(tracer.scene_),
      sampler_(sampler),
      wavelengths_(wavelengths),
      counts_(counts),
      max_depth_(tracer.scene_.integrator.max_depth),
      hero_(draw_hero(wavelengths, sampler)),
      ray_(ray),
      medium_(tracer.scene_.camera_medium),
      piece_(&tracer.unknown_) {}

Spectral VolumePath::trace() {
    while (within_depth(0)) {
        const Event event = travel();
        if (event == Event::ended) break;
        if (event == Event::escaped) {
            const Light* beyond = scene_.beyond(depth_);
            if (beyond && !(depth_ == 0 && scene_.integrator.hide_emitters))
                add_emission(*beyond, nullptr);
            break;
        }
        if (!(event == Event::surface ? at_surface() : at_collision())) break;
        if (split_reflection_ && depth_ > 1) {
            split_reflection_ = false;
            const float chance = reflection_chance(relative_weight());
            if (!survives(chance, sampler_.random().next(), throughput_)) break;
        }
    }
    return result_;
}

VolumePath::Event VolumePath::travel() {
    if (medium_) return medium_->homogeneous() ? travel_homogeneous() : travel_heterogeneous();
    ++counts_.rays;
    hit_ = scene_.rays.intersect(ray_);
    return hit_ ? Event::surface : Event::escaped;
}

VolumePath::Event VolumePath::travel_homogeneous() {
    const MediumLanes lanes = lanes_of(*medium_, ray_.o);
    if (!(lanes.hero_sigma * lanes.hero_chance > 0.f)) {
        ++counts_.rays;
        hit_ = scene_.rays.intersect(ray_);
        pass(lanes, hit_ ? hit_->t : 1e30f);
        return hit_ ? Event::surface : Event::escaped;
    }
    const VolumePathTracer::MediumInfo& info = tracer_.info(medium_);
    WalkSurroundings surroundings{*this, info, *piece_, lanes,
                                  Random(sampler_.random().next_bits())};
    Walker walker{ray_.o, ray_.d, ray_.d, sampler_.random()};
    const std::uint32_t chunk = lanes.chunk(walk_chunk);
    for (;;) {
        const std::uint32_t left =
            max_depth_ < 0 ? chunk : static_cast<std::uint32_t>(max_depth_ - depth_);
        walker.collisions = 0;
        walker.length = 0.f;
        const WalkEnd end =
            walk(walker, lanes.hero_sigma, medium_->phase,
                 piece_->connect ? 1 : std::min(chunk, left), surroundings, lanes.hero_chance);
        sampler_.random() = walker.random;
        counts_.scatterings += walker.collisions;
        depth_ += static_cast<int>(walker.collisions);
        ray_ = {walker.p, walker.d};
        if (walker.collisions > 0) {
            throughput_ *= lanes.survival(walker.collisions);
            density_ *= lanes.walk_density(walker.collisions, walker.length);
            other_strategy_ = Strategy::none;
            last_collision_ = {true, walker.p, walker.d_in, density_};
        }
        if (end == WalkEnd::lost) return Event::ended;
        if (end == WalkEnd::escaped) {
            hit_.reset();
            pass(lanes, walker.free_path);
            return Event::escaped;
        }
        if (end == WalkEnd::surface) {
            hit_ = surroundings.hit;
            pass(lanes, walker.free_path);
            return Event::surface;
        }
        if (piece_->connect) return Event::collision;
        if (!within_depth(0)) return Event::ended;
        const float chance = walk_chance(relative_weight(), depth_ > scene_.integrator.rr_depth);
        if (chance < 1.f && !survives(chance, walker.random.next(), throughput_))
            return Event::ended;
        walker.d_in = walker.d;
        walker.d = medium_->phase.sample(walker.d, walker.random.next2());
        last_collision_.d_in = walker.d_in;
    }
}

void VolumePath::pass(const MediumLanes& lanes, float length) {
    const Spectral left = lanes.transmittance(length), passing = lanes.passing(left);
    density_ *= passing;
    if (!lanes.always) throughput_ *= left / max(passing, Spectral(1e-30f));
}

VolumePath::Event VolumePath::travel_heterogeneous() {
    ++counts_.rays;
    hit_ = scene_.rays.intersect(ray_);
    const float end = hit_ ? hit_->t : 1e30f;
    Random& random = sampler_.random();
    // Delta tracking (Woodcock 1965) with the hero's probabilities; a majorant common to all lanes
    // keeps the density of the tentative collisions out of the book-keeping.
    const VolumePathTracer::MediumInfo& info = tracer_.info(medium_);
    const VolumeTracking tracking(info, *medium_, wavelengths_);
    MajorantSegments segments(info.majorants, *medium_, ray_, end, wavelengths_);
    float t = 0.f;
    while (const auto segment = segments.next()) {
        t = std::max(t, segment->begin);
        const float majorant = segment->majorant * tracking.largest;
        if (!(majorant > 0.f)) continue;
        for (;;) {
            t += -fast_log(1.f - random.next()) / majorant;
            if (t >= segment->end) break;
            const Point3f p = ray_.o + ray_.d * t;
            const MediumCoefficients c = medium_->coefficients(p, wavelengths_);
            const Spectral tracked = c.sigma_t * tracking.tracked;
            const Spectral real = tracked * Spectral(1.f / majorant);
            if (random.next() >= real[hero_]) {
                density_ *= max(Spectral(0.f), Spectral(1.f) - real);
                continue;
            }
            throughput_ *= select(tracked > Spectral(0.f),
                                  c.sigma_s / max(tracked, Spectral(1e-30f)), Spectral(0.f)) *
                           tracking.remaining(ray_, t);
            density_ *= real;
            density_ *= Spectral(1.f / max_lane(density_));
            ++counts_.scatterings;
            ++depth_;
            ray_.o = p;
            return Event::collision;
        }
        t = segment->end;
    }
    throughput_ *= tracking.remaining(ray_, end);
    return hit_ ? Event::surface : Event::escaped;
}

bool VolumePath::at_collision() {
    if (!within_depth(0)) return false;
    if (piece_->connect) connect_to_light(nullptr, nullptr, {});
    // Where extinction does not vary, the walk has done this.
    if (!medium_->homogeneous() && within_depth(1)) meet_lights_through_boundary();
    if (depth_ > scene_.integrator.rr_depth &&
        !survives(collision_chance(relative_weight()), sampler_.random().next(), throughput_))
        return false;
    const Vec3f d_in = ray_.d;
    const Vec3f d = medium_->phase.sample(d_in, sampler_.random().next2());
    other_strategy_ = piece_->connect ? Strategy::light_sampling : Strategy::none;
    other_density_ = density_;
    last_collision_ = {true, ray_.o, d_in, density_};
    vertex_ = ray_.o;
    vertex_lights_ = &reachable();
    vertex_pdf_ = medium_->phase.eval(dot(d_in, d));
    ray_ = {ray_.o, d};
    return true;
}

bool VolumePath::at_surface() {
    SurfacePoint at = scene_.rays.surface_point(ray_, *hit_);
    const ShapeBinding& shape = scene_.shapes[hit_->shape];
    if (shape.light && !(depth_ == 0 && scene_.integrator.hide_emitters))
        add_emission(*shape.light, &at);

    const Material& material = *shape.material;
    // Where light passes, paths go on below an interpolated normal; elsewhere they would end.
    if (!(material.flags() & transmits)) turn_to_viewer(at, -ray_.d, !material.is_lambertian());
    const Vec3f wo = at.shading.to_local(-ray_.d);
    BsdfScratch scratch;
    const Bsdf& bsdf = material.at(at, wavelengths_, scratch);
    guided_ = guided_arrival(at, wo);
    if ((material.flags() & has_smooth) && within_depth(1)) {
        connect_to_light(&at, &bsdf, wo);
        if (!tracer_.beams_.empty() && within_depth(2))
            connect_surface_through_boundary(at, bsdf, wo);
    }

    const float u1 = sampler_.next1d();
    const Vec2f u2 = sampler_.next2d();
    if (depth_ == 0 && wo.z > 0.f && material.smooth_boundary_eta() > 0.f) {
        const auto reflected = bsdf.sample(wo, 0.f, u2);
        const auto refracted = bsdf.sample(wo, 0x1.fffffep-1f, u2);
        if (reflected && refracted && reflected->wi.z > 0.f && refracted->wi.z < 0.f) {
            split_at_first_boundary(*this, reflected->pdf, refracted->pdf,
                                    [&](VolumePath& reflection) {
                                        if (reflection.follow(at, bsdf, wo, *reflected))
                                            reflection.trace();
                                    });
            return follow(at, bsdf, wo, *refracted);
        }
    }
    if (depth_ == 0 && wo.z > 0.f && tracer_.exit(at.shape) == VolumePathTracer::Exit::rough)
        return split_at_rough_boundary(at, bsdf, wo, material.facet_eta(), u2);
    const auto sample = bsdf.sample(wo, u1, u2);
    return sample && max_lane(sample->weight) > 0.f && follow(at, bsdf, wo, *sample);
}

bool VolumePath::follow(const SurfacePoint& at, const Bsdf& bsdf, const Vec3f& wo,
                        const BsdfSample& sample) {
    const Vec3f direction = at.shading.to_world(sample.wi);
    const float passing = sample.null ? mean_of(bsdf.null_transmission(wo)) : 0.f;
    if (passing > 0.f) {
        // Straight through: the segment goes on, and so does the chance that next-event estimation
        // had to make it.
        throughput_ *= sample.weight;
        density_ *= Spectral(passing);
        if (other_strategy_ == Strategy::guided_exit) other_strategy_ = Strategy::none;
    } else {
        ++depth_;
        throughput_ *= sample.weight;
        eta_ *= sample.eta;
        vertex_ = at.p;
        vertex_lights_ = &tracer_.lights_;
        vertex_pdf_ = sample.pdf;
        other_density_ = density_ + guided_;
        other_strategy_ = sample.delta ? Strategy::none : Strategy::light_sampling;
        // From outside as the interpolated normal sees it, no proposal would have come.
        if (sample.delta && last_collision_.valid && wo.z < 0.f && sample.wi.z > 0.f)
            expect_guided_exit(at, sample.pdf);
    }
    last_collision_.valid = false;
    if (sample.single_wavelength && !single_wavelength_) {
        // The other lanes would have gone elsewhere: the hero goes on alone.
        single_wavelength_ = true;
        hero_ = 0;
        density_ *= Spectral(1.f, 0.f, 0.f, 0.f);
        other_density_ *= Spectral(1.f, 0.f, 0.f, 0.f);
    }
    leave(at, direction);
    if (depth_ <= scene_.integrator.rr_depth || passing > 0.f) return true;
    return survives(surface_chance(relative_weight()), sampler_.next1d(), throughput_);
}

void VolumePath::leave(const SurfacePoint& at, const Vec3f& direction) {
    ray_ = {at.spawn(direction), direction};
    const ShapeBinding& shape = scene_.shapes[at.shape];
    if (!shape.separates_media) return;
    const bool inside = !(dot(direction, at.ng) > 0.f);
    medium_ = inside ? shape.interior : shape.exterior;
    piece_ = &tracer_.piece(at.shape, inside);
}

float VolumePath::relative_weight() const {
    return max_lane(throughput_ * density_) / std::max(1e-30f, mean_of(density_)) * eta_ * eta_;
}

}  // namespace nacre
