#pragma once
// Filters that take a pixel for what its like say.
#include "nacre/denoise/patch_weights.h"

namespace nacre::denoising {

/// Weighted means of `values`.
Planes weighted_mean(const Planes& values, const PatchWeights& weights);

/// At every pixel p the three planes of `values` are fitted as linear functions of the features,
///
///   min over b of  sum over q of w(p, q) |y_q - b_0 - b (f_q - f_p)|^2 + ridge,
///
/// and each q is the mean of what all fits around it predict there, weighted alike (B. Bitterli, F.
/// Rousselle, B. Moon, J. A. Iglesias-Guitian, D. Adler, K. Mitchell, W. Jarosz, J. Novak 2016,
/// Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings, EGSR). Unlike
/// the paper, a fit counts for less where its prediction is far from what the guide of the weights
/// says, as its variance goes: else fits at the noisy side of an edge put a halo on the other. The
/// ridge makes features that vary by less than `feature_noise` (a standard deviation) count for
/// little. At most `most_features` features.
inline constexpr int most_features = 8;
Planes first_order(const Planes& values, const Planes& features, float feature_noise,
                   const PatchWeights& weights);

}  // namespace nacre::denoising
