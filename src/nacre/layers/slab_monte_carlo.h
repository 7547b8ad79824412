#pragma once
// Photons that walk through a stack of layers: the job of MCML.
// L. Wang, S. L. Jacques, L. Zheng 1995, MCML - Monte Carlo modeling of light transport in
// multi-layered tissues, Computer Methods and Programs in Biomedicine 47(2).
//
// A narrow beam enters at the origin, inclined towards +x. The specular reflection of the first
// surface is taken off before; the rest is launched. At a collision a photon loses the share
// 1 - albedo of its weight to absorption; below a threshold it is ended or made heavier at random
// (Russian roulette), which keeps means true. At an interface it is reflected as a whole with
// Fresnel's probability, or refracted. All is unbiased, with a standard error from the scatter of
// independent batches.
//
// Unless radii are asked for, only depth is followed, which is the same walk seen from the side and
// much faster. Photons walk in packs, positions in float by optical depth from the top of their
// layer; sums are in double. At 3e7 photons no bias is seen against adding and doubling. Each batch
// has its own random numbers, so the result is the same for any number of threads.
#include <cstdint>
#include <vector>

#include "nacre/layers/layer.h"
#include "nacre/math/work.h"

namespace nacre {

/// Which profiles to record: those with a number of bins. Bins are equally wide and start at 0;
/// what falls beyond the last is in the totals but in no profile.
struct SlabBins {
    int radius = 0;
    double radius_width = 0.;  ///< mm
    int depth = 0;
    double depth_width = 0.;  ///< mm
    int angle = 0;            ///< over exit angles from 0 to 90 degrees
    /// Also the tables over two of them, where both have bins.
    bool pairs = false;
};

struct SlabMonteCarloOptions {
    std::uint64_t photons = 1'000'000;
    std::uint64_t seed = 0;
    double cosine = 1.;  ///< of incidence, in the medium above, in (0, 1]
    SlabBins bins;
    /// Photons lighter than this share of a launched one survive with probability 1 / `gain` and
    /// become `gain` times as heavy. MCML has 1e-4 and 10; the defaults reach the same error of the
    /// totals of a half space of albedo 0.9 in two fifths of the time. Profiles at great depths
    /// want a lower threshold.
    double roulette_weight = 0.1, roulette_gain = 5.;
};

/// Shares of the power that falls in; profiles are densities, their bins in the order of the names,
/// the second index running faster.
struct SlabMonteCarloResult {
    std::uint64_t photons = 0;
    /// `specular` and `unscattered` are exact. Reflectance, transmittance and absorptance add up to
    /// 1: a photon that roulette ends counts as absorbed, one that it makes heavier the reverse.
    LayerTotals totals;
    LayerTotals error;
    std::vector<Estimate> absorbed;                              ///< by each layer
    std::vector<Estimate> reflected_radius, transmitted_radius;  ///< mm^-2, without `specular`
    std::vector<Estimate> reflected_angle, transmitted_angle;    ///< sr^-1
    std::vector<Estimate> absorbed_depth;                        ///< mm^-1
    std::vector<Estimate> absorbed_radius_depth;                 ///< mm^-3
    std::vector<Estimate> reflected_radius_angle, transmitted_radius_angle;  ///< mm^-2 sr^-1
};

/// Throws InputError for a stack that `check` refuses, for options out of range, for a half space
/// that absorbs less than 1e-7 of the light per collision, where walks need not end, and for stacks
/// in which one of them may take more than `longest_walk` collisions. `work` is told the share of
/// photons that have ended; throws Stopped if it says so.
SlabMonteCarloResult slab_monte_carlo(const LayerStack& stack,
                                      const SlabMonteCarloOptions& options = {},
                                      const Work& work = {});

/// Collisions of a walk through all of the stack, about: the square of the optical thickness by
/// transport, or what absorption and roulette leave of a walk if that is less. Photons that get so
/// far are few, but each is waited for: 1e10 take minutes.
double longest_walk_estimate(const LayerStack& stack, const SlabMonteCarloOptions& options = {});
/// Beyond it the walk of one photon takes an hour or more.
constexpr double longest_walk = 1e11;

}  // namespace nacre
