#pragma once
// Noise is taken out of rendered pictures: nonlinearly weighted first-order regression,
//
//   B. Bitterli, F. Rousselle, B. Moon, J. A. Iglesias-Guitian, D. Adler, K. Mitchell, W. Jarosz,
//   J. Novak 2016, Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings,
//   Computer Graphics Forum (EGSR) 35(4).
//
// Where the picture is even but for noise, a pixel may be told from many around it. What is noise is
// known from the variance of the samples and from two halves of them; what is picture, from
// features: images of the same scene without light (albedo, normals, depth), of which the picture is
// a linear function nearby. docs/denoising.md says more.
#include "nacre/image/image.h"
#include "nacre/math/work.h"

namespace nacre {

struct DenoiseInput {
    /// R, G, B: means over two parts of the samples that are independent of each other.
    Image halves[2];
    float share = 0.5f;   ///< of the samples, in the first
    Image variance = {};  ///< R, G, B: of the mean over all samples
    /// At most eight channels, each of order 1, and the variance of each. No channels: colour alone.
    Image features = {}, feature_variance = {};
};

/// The picture with less noise; channels R, G, B. Not unbiased: where nothing tells one from the
/// other, detail goes with noise. Linear in the picture's scale. Same bits for any number of
/// threads. Throws InputError if sizes differ, a value is not finite or features are too many, Stopped if `work` says so.
Image denoise(const DenoiseInput& input, const Work& work = {});

}  // namespace nacre
