#pragma once
// The inner loop of slab_monte_carlo: one batch of photons.
#include <cstdint>
#include <vector>

#include "nacre/layers/slab_monte_carlo.h"

namespace nacre::slab {

/// A layer as the walk needs it. The depth within it is optical.
struct WalkLayer {
    float tau;     ///< optical thickness
    float absorb;  ///< 1 - albedo; 0 in clear layers
    float g;
    float eta_up, eta_down;     ///< the neighbours' indices over this one's
    float length;               ///< of a unit of optical depth, mm; 0 in clear layers
    float clear;                ///< thickness of clear layers, mm; else 0
    float top_bin, depth_bins;  ///< the bin of depth z is top_bin + z * depth_bins
};

/// Where the sums of a batch begin in its row of numbers.
struct TallyLayout {
    SlabBins bins;
    std::size_t layers;
    std::size_t reflected, transmitted, all_absorbed, absorbed;
    std::size_t reflected_radius, transmitted_radius, reflected_angle, transmitted_angle;
    std::size_t absorbed_depth, absorbed_radius_depth;
    std::size_t reflected_radius_angle, transmitted_radius_angle;
    std::size_t size;

    TallyLayout(const SlabBins& bins, std::size_t layers);
};

struct WalkProblem {
    std::vector<WalkLayer> layers;
    bool isotropic = true;         ///< in every layer
    float cosine = 1., sine = 0.;  ///< of launched photons, whose weight is 1
    float roulette_weight = 0., roulette_gain = 0.;
};

/// Walks `photons` photons and adds what becomes of their weights to the `layout.size` numbers of
/// `tally`. `phase` counts photons that have ended.
void walk_batch(const WalkProblem& problem, const TallyLayout& layout, std::uint64_t key,
                std::uint64_t photons, WorkPhase& phase, double* tally);

}  // namespace nacre::slab
