#pragma once
// A profile written as a sum of Gaussians, each the spread of light after some time: cheap to blur
// with, closed in every integral.
//
//   E. d'Eon, D. Luebke 2007, Advanced Techniques for Realistic Real-Time Skin Rendering, GPU Gems
//   3, chapter 14 (the six Gaussians of skin); E. d'Eon, D. Luebke, E. Enderton 2007, Efficient
//   Rendering of Human Skin, EGSR.
//
//   R(r) = sum of w_i G(v_i, r),   G(v, r) = e^(-r^2 / (2 v)) / (2 pi v),   v in mm^2, w >= 0
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace nacre {

struct Gaussian {
    double variance;  ///< of either coordinate, mm^2, > 0
    double weight;    ///< its share of the light, >= 0
};

struct GaussianSum {
    std::vector<Gaussian> terms;

    /// R at squared distance r2 (mm^2), in mm^-2.
    double eval(double r2) const {
        double sum = 0.;
        for (const auto& [v, w] : terms) sum += w * std::exp(-0.5 * r2 / v) / v;
        return 0.5 * std::numbers::inv_pi * sum;
    }
    /// Integral of R over the disk of squared radius r2.
    double cumulative(double r2) const {
        double sum = 0.;
        for (const auto& [v, w] : terms) sum -= w * std::expm1(-0.5 * r2 / v);
        return sum;
    }
    double total() const {
        double sum = 0.;
        for (const Gaussian& t : terms) sum += t.weight;
        return sum;
    }
    /// Radius with density 2 pi r R(r) / total from one number u in [0, 1), for a total > 0: u
    /// chooses the term, and what is left of it the radius within.
    double sample(double u) const {
        u *= total();
        const Gaussian* last = nullptr;
        for (const Gaussian& t : terms) {
            if (t.weight == 0.) continue;
            last = &t;
            if (u < t.weight) return radius(t, u / t.weight);
            u -= t.weight;
        }
        return last ? radius(*last, 0.5) : 0.;  // only if u ran past the end by rounding
    }

  private:
    static double radius(const Gaussian& t, double u) {
        return std::sqrt(-2. * t.variance * std::log1p(-u));
    }
};

/// The six Gaussians of skin for channel 0 red, 1 green, 2 blue. The weights of each sum to 1: the
/// colour itself is left to a texture.
inline GaussianSum skin_gaussians(int channel) {
    constexpr std::array<double, 6> variance{0.0064, 0.0484, 0.187, 0.567, 1.99, 7.41};
    constexpr std::array<std::array<double, 6>, 3> weight{
        {{0.233, 0.100, 0.118, 0.113, 0.358, 0.078},
         {0.455, 0.336, 0.198, 0.007, 0.004, 0.},
         {0.649, 0.344, 0., 0.007, 0., 0.}}};
    GaussianSum sum;
    for (std::size_t i = 0; i < variance.size(); ++i)
        sum.terms.push_back({variance[i], weight[std::size_t(channel)][i]});
    return sum;
}

}  // namespace nacre
