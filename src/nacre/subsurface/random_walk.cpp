#include "nacre/subsurface/random_walk.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

#include "nacre/math/sampling.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/render/profile_tables.h"
#include "nacre/render/walk.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {

namespace {

// A free path meets at most so many surfaces of other shapes.
constexpr int most_other_surfaces = 64;

}  // namespace

RandomWalkMedium<double> random_walk_medium(const ProfileMedium& m, FreePath keep) {
    const double a = half_space_albedo(m);
    double l = 1. / m.sigma_t_prime();
    if (keep == FreePath::diffuse) {
        const double inside = diffuse_reflectance_internal(m.eta);
        const double boundary = (1. + inside) / (1. - inside);
        const double lost = m.sigma_a / m.sigma_t_prime();
        const double ratio = std::sqrt((1. - chiang2016_single_albedo(a)) / lost);
        l *= std::min(ratio, (3. + 2. * boundary) / 5.);
    }
    return chiang2016_medium(a, l / normalised_diffusion_scale(a, NormalisedDiffusionFit::diffuse));
}

/// What a walk meets: the shape's own surface, and the end of the box around it.
struct RandomWalk::Surroundings {
    const RandomWalk& of;
    RayCounts& counts;
    Ray ray{};
    std::optional<Hit> hit{};

    struct Place {
        float clearance;
        bool outside;
    };
    Place locate(const Point3f& p) const {
        const auto within = [](float x, float low, float high) { return x >= low && x <= high; };
        const Box3f& b = of.bounds_;
        return {0.f, !(within(p.x, b.lower.x, b.upper.x) && within(p.y, b.lower.y, b.upper.y) &&
                       within(p.z, b.lower.z, b.upper.z))};
    }
    bool surface(const Point3f& p, const Vec3f& d, float s, float& t) {
        ray = {p, d, 0.f, s};
        for (int i = 0; i < most_other_surfaces; ++i) {
            ++counts.rays;
            hit = of.scene_.rays.intersect(ray);
            if (!hit || hit->shape == of.shape_) break;
            ray.tmin = hit->t * (1.f + 1e-6f);
        }
        if (hit) t = hit->t;
        return hit.has_value();
    }
    void collided(const Walker&, const Place&) const {}
};

RandomWalk::RandomWalk(const Scene& scene, std::uint32_t shape, const ObjectBoundary& boundary,
                       const Bands& bands, std::span<const RandomWalkMedium<double>> media,
                       float exit_scale, std::span<const double> factors)
    : Translucency(boundary),
      scene_(scene),
      shape_(shape),
      bands_(bands),
      exit_scale_(exit_scale),
      factors_(factors.begin(), factors.end()),
      bounds_(scene.rays.bounds(shape)) {
    for (const RandomWalkMedium<double>& m : media) {
        sigma_t_.push_back(float(m.sigma_t));
        sigma_s_.push_back(float(m.sigma_s));
    }
    // Rounding may put a collision beside a flat object's box.
    const Vec3f margin = bounds_.diagonal() * 1e-4f;
    bounds_.lower = bounds_.lower - margin;
    bounds_.upper = bounds_.upper + margin;
}

MediumLanes RandomWalk::lanes(const Wavelengths& w, int lane) const {
    return {{bands_.at(sigma_s_.data(), w), bands_.at(sigma_t_.data(), w)}, w, lane};
}

Translucency::Emergence RandomWalk::emerge(const SurfacePoint& exit, const Vec3f&, Sampler& sampler,
                                           const Wavelengths& w, RayCounts& counts) const {
    // Each walk of a path has its own lane: were it one for all, the weights of several would not
    // multiply to that of the path.
    float u = sampler.next1d();
    int lane = 0;
    while (lane < 3 && u >= w.weight[lane]) u -= w.weight[lane++];
    const MediumLanes medium = lanes(w, lane);
    const Vec3f d =
        -Framef::around(exit.ng).to_world(square_to_cosine_hemisphere(sampler.next2d()));

    Surroundings surroundings{*this, counts};
    Walker walker{exit.spawn(d), d, d, sampler.random()};
    float gain = 1.f;  // of the roulette
    WalkEnd end;
    Spectral weight;
    for (std::uint32_t limit = walk_chunk;; limit += walk_chunk) {
        end = walk(walker, medium.hero_sigma, PhaseFunction::isotropic(), limit, surroundings);
        Spectral density = medium.walk_density(walker.collisions, walker.length);
        if (end == WalkEnd::surface) density *= medium.transmittance(walker.free_path);
        weight = medium.survival(walker.collisions) * density * Spectral(gain / mean(density, w));
        if (end != WalkEnd::paused) break;
        const float chance = std::min(1.f, max_lane(weight));
        if (!(walker.random.next() < chance)) break;
        gain /= chance;
        walker.d_in = walker.d;
        walker.d = fast_uniform_sphere(walker.random.next2());
    }
    sampler.random() = walker.random;
    counts.scatterings += walker.collisions;
    if (end != WalkEnd::surface) return {};
    const SurfacePoint entry = scene_.rays.surface_point(surroundings.ray, *surroundings.hit);
    if (!(dot(walker.d, entry.ng) > 0.f)) return {};  // came back through a hole
    weight *= Spectral(exit_scale_);
    if (!factors_.empty()) weight *= bands_.at(factors_.data(), w);
    return {Spectral(0.f), entry, weight};
}

namespace {

TranslucencyPtr make_random_walk(const ShapeInput& in) {
    const Bands bands(in.scene.mode);
    const std::vector<ProfileMedium> media = medium_in_bands(in.medium(), in.eta(), bands);
    for (const ProfileMedium& m : media) check(m);
    const auto keep = in.options.choice<FreePath>("free_path");
    std::vector<RandomWalkMedium<double>> walks(media.size());
    WorkPhase phase(in.work, "inversion of the albedo", media.size());
    tbb::parallel_for(std::size_t(0), media.size(), [&](std::size_t i) {
        walks[i] = random_walk_medium(media[i], keep);
        phase.advance();
    });
    return std::make_shared<RandomWalk>(in.scene, in.shape, in.boundary, bands, walks,
                                        exit_scale(in), in.rough_return);
}

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& random_walk_technique() {
    static const TechniqueDescription description{
        .name = "random_walk",
        .title = "random walk from surface albedo",
        .authors = "M. J.-Y. Chiang, P. Kutz, B. Burley",
        .year = 2016,
        .paper =
            "Practical and Controllable Subsurface Scattering for Production Path Tracing, "
            "SIGGRAPH 2016 Talks",
        .how =
            "a walk without refraction, isotropic and of diffuse entry and exit, in the medium "
            "whose half space would return the same share of the light, by their fit",
        .precomputes = "the half space's albedo, by adding and doubling",
        .keeps = {.view = true, .light = true},
        .parameters = {exit_fresnel_parameter(),
                       choice_parameter(
                           "free_path", "the object's mean free path that random walks keep",
                           {{"transport", "that of single paths"},
                            {"diffuse", "that with which light far from its entry fades"}})},
        .variants = "free_path=transport|free_path=diffuse",
        .prepare = prepare_path_technique,
        .below = make_random_walk};
    return description;
}

}  // namespace nacre
