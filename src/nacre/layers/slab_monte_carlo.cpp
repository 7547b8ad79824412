#include "nacre/layers/slab_monte_carlo.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/layers/interfaces.h"
#include "nacre/layers/slab_walk.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/optics/fresnel.h"

namespace nacre {

namespace {

// Enough photons in a batch that its last walks, when lanes have run dry, do not count; enough
// batches that their scatter tells the standard error (to 9 %).
constexpr std::uint64_t photons_per_batch = 16384, least_batches = 64;
// Batches whose rows of numbers are held at a time.
constexpr std::uint64_t batches_at_a_time = 64;

double optical_thickness(const LayerStack& stack) {
    double tau = 0.;
    for (const Layer& l : stack.layers) tau += l.optical_thickness();
    return tau;
}

void check(const LayerStack& stack, const SlabMonteCarloOptions& o) {
    check(stack);
    const auto demand = [](bool holds, const char* name, double value, const char* range) {
        if (!holds) throw InputError(fmt::format("{} = {:g} must be {}", name, value, range));
    };
    demand(o.photons >= least_batches, "photons", double(o.photons), "at least 64");
    demand(o.cosine > 0. && o.cosine <= 1., "cosine", o.cosine, "above 0 and at most 1");
    demand(o.roulette_weight >= 0. && o.roulette_weight <= 1., "roulette_weight", o.roulette_weight,
           "from 0 to 1");
    demand(o.roulette_gain > 1. && o.roulette_gain <= 1000., "roulette_gain", o.roulette_gain,
           "above 1 and at most 1000");
    const auto bins = [&](const char* what, int count, double width) {
        demand(count >= 0 && count <= 10000, fmt::format("bins of {}", what).c_str(), count,
               "from 0 to 10000");
        if (count > 0)
            demand(width > 0. && std::isfinite(width),
                   fmt::format("width of {} bins", what).c_str(), width, "positive and finite");
    };
    bins("radius", o.bins.radius, o.bins.radius_width);
    bins("depth", o.bins.depth, o.bins.depth_width);
    bins("angle", o.bins.angle, 1.);
    const Layer& last = stack.layers.back();
    if (std::isinf(last.thickness) && last.sigma_t() > 0. && 1. - last.albedo() < 1e-7)
        throw InputError(fmt::format(
            "layer {}: walks in a half space that absorbs {:g} of the light per collision need not "
            "end; give it more absorption or a finite thickness",
            stack.layers.size(), 1. - last.albedo()));
    if (const double walk = longest_walk_estimate(stack, o); walk > longest_walk)
        throw InputError(fmt::format(
            "Monte Carlo: walks through layers of an optical thickness of {:.3g} with so little "
            "absorption take up to {:.1g} collisions, hours each: adding-doubling answers at once; "
            "or make the layers thinner or their absorption stronger",
            optical_thickness(stack), walk));
}

slab::WalkProblem make_problem(const LayerStack& stack, const SlabMonteCarloOptions& o) {
    slab::WalkProblem p;
    const std::vector<double> eta = media_indices(stack);
    double top = 0.;
    for (std::size_t i = 0; i < stack.layers.size(); ++i) {
        const Layer& l = stack.layers[i];
        const bool clear = l.sigma_t() == 0.;
        const double length = clear ? 0. : 1. / l.sigma_t();
        const double per_mm = o.bins.depth > 0 ? 1. / o.bins.depth_width : 0.;
        p.layers.push_back(
            {float(l.optical_thickness()), clear ? 0.f : float(l.sigma_a / l.sigma_t()), float(l.g),
             float(eta[i] / eta[i + 1]), float(eta[i + 2] / eta[i + 1]), float(length),
             clear && std::isfinite(l.thickness) ? float(l.thickness) : 0.f, float(top * per_mm),
             float(length * per_mm)});
        p.isotropic = p.isotropic && l.g == 0.;
        top += l.thickness;
    }
    p.cosine = float(refracted_cosine(o.cosine, eta[1] / eta[0]));
    p.sine = float(std::sqrt(1. - o.cosine * o.cosine) * eta[0] / eta[1]);
    p.roulette_weight = float(o.roulette_weight);
    p.roulette_gain = float(o.roulette_gain);
    return p;
}

/// Sums over batches of their means and of the squares of these.
struct Sums {
    std::vector<double> first, second;
    double batches = 0.;

    explicit Sums(std::size_t size) : first(size), second(size) {}

    void add(const double* tally, double photons) {
        for (std::size_t i = 0; i < first.size(); ++i) {
            const double mean = tally[i] / photons;
            first[i] += mean;
            second[i] += mean * mean;
        }
        batches += 1.;
    }
    Estimate operator()(std::size_t i, double scale) const {
        const double mean = first[i] / batches;
        const double variance = std::max(0., second[i] / batches - mean * mean) / (batches - 1.);
        return {scale * mean, scale * std::sqrt(variance)};
    }
};

Sums run(const slab::WalkProblem& problem, const slab::TallyLayout& layout, std::uint64_t batches,
         std::uint64_t per_batch, std::uint64_t seed, const Work& work) {
    WorkPhase phase(work, "photons", batches * per_batch);
    Sums sums(layout.size);
    std::vector<double> rows;
    for (std::uint64_t begin = 0; begin < batches; begin += batches_at_a_time) {
        const std::uint64_t count = std::min(batches_at_a_time, batches - begin);
        rows.assign(std::size_t(count) * layout.size, 0.);
        tbb::parallel_for(std::uint64_t(0), count, [&](std::uint64_t i) {
            slab::walk_batch(problem, layout, stream_key(seed, begin + i), per_batch, phase,
                             rows.data() + std::size_t(i) * layout.size);
        });
        for (std::uint64_t i = 0; i < count; ++i)
            sums.add(rows.data() + std::size_t(i) * layout.size, double(per_batch));
    }
    return sums;
}

/// `count` bins from `begin`; what falls in bin i is `enter` times the share, over its size.
template <class Size>
std::vector<Estimate> profile(const Sums& sums, std::size_t begin, std::size_t count, double enter,
                              Size&& size) {
    std::vector<Estimate> p;
    for (std::size_t i = 0; i < count; ++i) p.push_back(sums(begin + i, enter / size(i)));
    return p;
}

}  // namespace

double longest_walk_estimate(const LayerStack& stack, const SlabMonteCarloOptions& o) {
    // Diffusion takes 3 / 2 L^2 steps of a transport mean free path to get over a distance L, each
    // of 1 / (1 - g) collisions; what absorption leaves of a photon falls below the threshold of
    // roulette before.
    double transport = 0., per_step = 1., absorbed = 0.;
    for (const Layer& l : stack.layers) {
        if (!(l.sigma_s > 0.)) continue;
        const double lost = 1. - l.albedo();
        transport += l.optical_thickness() * (1. - l.g);
        per_step = std::max(per_step, 1. / (1. - l.g));
        const double light = o.roulette_weight > 0. ? -std::log(o.roulette_weight) + 5. : 700.;
        absorbed = std::max(absorbed, light / lost);  // infinite without absorption
    }
    return std::min(absorbed, 1.5 * transport * transport * per_step);
}

SlabMonteCarloResult slab_monte_carlo(const LayerStack& stack, const SlabMonteCarloOptions& options,
                                      const Work& work) {
    check(stack, options);
    const slab::WalkProblem problem = make_problem(stack, options);
    const slab::TallyLayout layout(options.bins, stack.layers.size());
    const UnscatteredLight beam = unscattered_light(stack, options.cosine);
    const double enter = 1. - beam.specular;

    const std::uint64_t batches = std::max(least_batches, options.photons / photons_per_batch);
    const std::uint64_t per_batch = (options.photons + batches - 1) / batches;
    const Sums sums =
        enter > 0. ? run(problem, layout, batches, per_batch, options.seed, work) : [&] {
            Sums none(layout.size);
            none.batches = double(batches);
            return none;
        }();

    SlabMonteCarloResult result;
    result.photons = batches * per_batch;
    const Estimate reflected = sums(layout.reflected, enter);
    const Estimate transmitted = sums(layout.transmitted, enter);
    result.totals = {beam.specular + reflected.mean, transmitted.mean, 0., beam.specular,
                     beam.transmittance};
    result.totals.absorptance = 1. - result.totals.reflectance - result.totals.transmittance;
    result.error = {reflected.error, transmitted.error, sums(layout.all_absorbed, enter).error, 0.,
                    0.};
    for (std::size_t i = 0; i < layout.layers; ++i)
        result.absorbed.push_back(sums(layout.absorbed + i, enter));

    const SlabBins& b = options.bins;
    const auto radii = std::size_t(b.radius), depths = std::size_t(b.depth);
    const auto angles = std::size_t(b.angle);
    const auto ring = [&](std::size_t i) {
        const double w = b.radius_width;
        return std::numbers::pi * w * w * double(2 * i + 1);
    };
    const auto cone = [&](std::size_t i) {
        const double w = 0.5 * std::numbers::pi / b.angle;
        return 4. * std::numbers::pi * std::sin((double(i) + 0.5) * w) * std::sin(0.5 * w);
    };
    const auto slice = [&](std::size_t) { return b.depth_width; };
    const auto ring_cone = [&](std::size_t i) { return ring(i / angles) * cone(i % angles); };
    const auto ring_slice = [&](std::size_t i) { return ring(i / depths) * b.depth_width; };
    const auto take = [&](std::size_t begin, std::size_t count, const auto& size) {
        return profile(sums, begin, count, enter, size);
    };
    result.reflected_radius = take(layout.reflected_radius, radii, ring);
    result.transmitted_radius = take(layout.transmitted_radius, radii, ring);
    result.reflected_angle = take(layout.reflected_angle, angles, cone);
    result.transmitted_angle = take(layout.transmitted_angle, angles, cone);
    result.absorbed_depth = take(layout.absorbed_depth, depths, slice);
    if (!b.pairs) return result;
    result.absorbed_radius_depth = take(layout.absorbed_radius_depth, radii * depths, ring_slice);
    result.reflected_radius_angle = take(layout.reflected_radius_angle, radii * angles, ring_cone);
    result.transmitted_radius_angle =
        take(layout.transmitted_radius_angle, radii * angles, ring_cone);
    return result;
}

}  // namespace nacre
