// How a path of the complete simulation meets, through a smooth boundary, lights that have no
// extent.
#include <cmath>

#include "nacre/math/fast.h"
#include "nacre/render/shadow_ray.h"
#include "nacre/render/volume_path.h"

namespace nacre {

namespace {

// The chance that the shortest way is kept. On a ball of five free paths variance times time was
// least here (of 0.1, 0.25, 0.5, 1, 2, 4), and on the marble bunny less than with 1.
constexpr float most_chance = 0.5f;
// Surfaces that are seen after more than a mirror or a boundary look for chains with this chance.
constexpr float deep_chain_chance = 0.25f;

}  // namespace

VolumePath::Reach VolumePath::draw_reach(const MediumLanes& lanes, Random& random) {
    const float sigma = lanes.least_sigma();
    if (!(sigma > 0.f)) return {};
    return {-fast_log((1.f - random.next()) * (1.f / most_chance)) / sigma, sigma};
}

float VolumePath::Reach::chance(float way) const {
    return sigma > 0.f ? most_chance * std::exp(-sigma * way) : 1.f;
}

/// What comes to the start of `way`, with what lies on it.
Spectral VolumePath::arriving(const LightBeams::Way& way, const Point3f& origin,
                              const Medium* medium, Random& random) {
    const LightSample light = way.light->sample(way.at.p, {}, wavelengths_);
    if (!(light.pdf > 0.f) || !(max_lane(light.radiance) > 0.f)) return Spectral(0.f);
    const Spectral inside = connection({origin, way.inside, way.length}, medium, random).kept;
    if (!(max_lane(inside) > 0.f)) return inside;
    const Medium* outer = scene_.shapes[way.at.shape].exterior;
    const Spectral outside = connection(shadow_ray(way.at, light), outer, random).kept;
    return inside * outside * light.radiance * Spectral(way.gain);
}

Spectral VolumePath::arriving(const SpecularChains::Chain& chain, const Point3f& origin,
                              const Medium* medium, Random& random) {
    const SurfacePoint& first = chain.vertex[0].at;
    const LightSample light = chain.light->sample(first.p, {}, wavelengths_);
    if (!(light.pdf > 0.f)) return Spectral(0.f);
    Spectral kept = light.radiance * Spectral(static_cast<float>(chain.gain * chain.weight));
    Point3f from = origin;
    // Towards the light, leg by leg.
    for (int i = chain.vertices; i-- > 0 && max_lane(kept) > 0.f;) {
        const SurfacePoint& at = chain.vertex[std::size_t(i)].at;
        const Vec3f to = at.p - from;
        const float distance = length(to);
        kept *= connection({from, to * (1.f / distance), distance}, medium, random).kept;
        const Vec3f on = i > 0 ? chain.vertex[std::size_t(i - 1)].at.p - at.p : light.wi;
        from = at.spawn(on);
        const ShapeBinding& shape = scene_.shapes[at.shape];
        medium = dot(on, at.ng) > 0.f ? shape.exterior : shape.interior;
    }
    return kept * connection(shadow_ray(first, light), medium, random).kept;
}

void VolumePath::connect_collision_through_boundary(const Point3f& p, const Vec3f& d_in,
                                                    const Spectral& weight, const Reach& reach,
                                                    Random& random) {
    tracer_.beams_.find(p, reach.length, ways_, boxes_);
    for (const LightBeams::Way& way : ways_)
        result_ += weight *
                   Spectral(medium_->phase.eval(dot(d_in, way.inside)) / reach.chance(way.length)) *
                   arriving(way, p, medium_, random);
}

void VolumePath::meet_lights_through_boundary() {
    Random& random = sampler_.random();
    const VolumePathTracer::MediumInfo& info = tracer_.info(medium_);
    const bool chain =
        info.chain_chance > 0.f && within_depth(2) && random.next() < info.chain_chance;
    if (chain || !tracer_.beams_.empty()) {
        const Spectral carried = throughput_ * density_ * Spectral(1.f / mean_of(density_));
        if (!tracer_.beams_.empty())
            connect_collision_through_boundary(ray_.o, ray_.d, carried, {}, random);
        if (chain)
            connect_collision_by_chain(ray_.o, ray_.d, carried * Spectral(1.f / info.chain_chance),
                                       {}, random);
    }
    if (const DistanceGrid::Cell cell = piece_->grid.locate(ray_.o); cell.guide >= 0)
        guided_exit({ray_.o, ray_.d}, cell.guide, random);
}

void VolumePath::connect_collision_by_chain(const Point3f& p, const Vec3f& d_in,
                                            const Spectral& weight, const Reach& reach,
                                            Random& random) {
    const auto chain =
        tracer_.chains_.draw(p, tracer_.info(medium_).chain_ends_inside, random, counts_);
    if (!chain) return;
    const Vec3f to = chain->vertex[std::size_t(chain->vertices - 1)].at.p - p;
    const float way = length(to);
    if (way > reach.length) return;
    result_ += weight *
               Spectral(medium_->phase.eval(dot(d_in, normalize(to))) / reach.chance(way)) *
               arriving(*chain, p, medium_, random);
}

void VolumePath::connect_surface_through_boundary(const SurfacePoint& at, const Bsdf& bsdf,
                                                  const Vec3f& wo) {
    const ShapeBinding& shape = scene_.shapes[at.shape];
    const Spectral carried = throughput_ * density_ * Spectral(1.f / mean_of(density_));
    Random& random = sampler_.random();
    const auto connect = [&](const Vec3f& towards, const auto& way, float weight) {
        const Spectral f = bsdf.eval(at.shading.to_local(towards), wo);
        if (!(max_lane(f) > 0.f)) return;
        const Medium* medium = !shape.separates_media      ? medium_
                               : dot(towards, at.ng) > 0.f ? shape.exterior
                                                           : shape.interior;
        result_ +=
            carried * f * Spectral(weight) * arriving(way, at.spawn(towards), medium, random);
    };
    tracer_.beams_.find(at.p, 1e30f, ways_, boxes_);
    for (const LightBeams::Way& way : ways_) connect(way.inside, way, 1.f);

    const float chance = depth_ <= 1 ? 1.f : deep_chain_chance;
    if (!within_depth(3) || !(random.next() < chance)) return;
    if (const auto chain = tracer_.chains_.draw(at.p, false, random, counts_))
        connect(normalize(chain->vertex[std::size_t(chain->vertices - 1)].at.p - at.p), *chain,
                1.f / chance);
}

}  // namespace nacre
