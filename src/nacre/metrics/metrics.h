#pragma once
// Numbers that say how far a picture p is from a reference t, with bias and noise told apart.
//
// With bias b and independent noise of variances v_p and v_t in the two pictures,
//
//   E[(p - t)^2] = b^2 + v_p + v_t,
//
// so the squared error of two pictures without bias is not 0 but the sum of their variances. Where
// the variance of a picture's pixels is known, each metric states how much of it is noise. A
// picture without a variance counts as exact.
//
// All metrics are means over the pixels that count and over R, G and B (a grey picture is three
// times the same).
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "nacre/metrics/pictures.h"

namespace nacre {

/// A picture and, where it is known, the variance of the mean that each of its values is.
struct UncertainPicture {
    UncertainPicture(const Image& mean, const Image* variance = nullptr)
        : mean(mean), variance(variance) {}
    const Image& mean;
    const Image* variance;
};

/// The variances of the mean in a picture that nacre rendered with moments: its channels
/// variance.R, variance.G, variance.B (or variance.Y), which are those of one sample
/// (render/output.h), over the samples a pixel. Nothing if the picture has no such channels, does
/// not say how many samples it has, or is incomplete (its pixels may then differ in samples).
/// Exact for independent samples; too large for stratified ones.
std::optional<Image> variance_of_mean(const Image& picture);

/// One metric. `noise` and `standard_error` are known where either picture has a variance.
struct Metric {
    double value = 0;
    /// The part of `value` that noise is expected to add.
    std::optional<double> noise;
    /// One sigma of `value`, if noise is Gaussian and independent between pixels. The channels of a
    /// pixel come from the same paths, so they are taken to vary together: for independent channels
    /// this is up to sqrt(3) too large.
    std::optional<double> standard_error;

    /// `value` without its noise; may be negative, as the estimate of something that is 0 must.
    double corrected() const { return value - noise.value_or(0.); }
};

struct MetricOptions {
    /// Added to the denominators of relMSE, MAPE and SMAPE, so that black pixels do not decide.
    double epsilon = 0.01;
    /// The part of the values, the worst ones, that `rel_mse_trimmed` leaves out: a single firefly
    /// would else decide the number.
    double trim = 0.001;
    /// Pixels a side of a block: 16 is large enough for noise to average out and small enough to
    /// see where light is lost.
    int block = 16;
    std::vector<double> percentiles = {50, 90, 95, 99, 100};
};

/// Relative errors of the means of blocks of pixels, sum(p) / sum(t) - 1, which tell bias from
/// noise even without variances. Blocks stand side by side from the top left; those that the mask
/// or the border cuts are left out, and so are channels of blocks whose sum(t) is not positive.
struct BlockError {
    int blocks = 0;      ///< counted once a channel
    Metric mean_square;  ///< 0 if there are no blocks
    double rms() const;
};

struct Metrics {
    std::size_t pixels = 0;
    std::array<double, 3> mean_picture{}, mean_reference{};  ///< R, G, B

    /// mean(p - t), a channel each and over all. Noise adds nothing.
    std::array<Metric, 3> channel_bias;
    Metric bias;
    /// mean((p - t)^2). Standard error from Var[d^2] = 4 b^2 v + 2 v^2, where b^2 is estimated by
    /// d^2 - v and the total is at least that of b = 0.
    Metric mse;
    /// mean((p - t)^2 / (t^2 + epsilon)): Rousselle, Knaus and Zwicker 2011, Adaptive Sampling and
    /// Reconstruction using Greedy Error Minimization, ACM TOG 30(6). Epsilon differs between
    /// papers. Noise and standard error take the denominator to be exact.
    Metric rel_mse;
    /// The same without the worst `trim` of the values, as bench/relmse.py prints it.
    double rel_mse_trimmed = 0;
    /// mean(|p - t| / (|t| + epsilon)), the mean absolute percentage error as a fraction. `noise`
    /// is what pictures without bias would show, E|d| = sqrt(2 v / pi); as E|b + n| <= |b| + E|n|,
    /// `corrected` is a lower bound of the error without noise. The standard error is from
    /// Var|d| <= v, an upper bound.
    Metric mape;
    /// mean(|p - t| / (|p| + |t| + epsilon)), the symmetric form, in [0, 1): Vogels et al. 2018,
    /// Denoising with Kernel Prediction and Asymmetric Loss Functions, ACM TOG 37(4). Noise and
    /// standard error as of `mape`, the denominator taken to be exact.
    Metric smape;
    BlockError block;
    /// Percentiles (percent, value) of the error of a pixel, sqrt(mean over channels of
    /// (p - t)^2 / (t^2 + epsilon)), linear between order statistics.
    std::vector<std::pair<double, double>> percentiles;
};

/// Throws InputError if the pictures, variances or the mask differ in size, if the mask leaves no
/// pixel, if a value that counts is not finite or a variance negative, or for wrong options.
Metrics compare(const UncertainPicture& picture, const UncertainPicture& reference,
                const PixelMask& mask = {}, const MetricOptions& options = {});

/// (p - t) / (|t| + epsilon), channels R, G, B: where the picture is too bright and where too dark.
Image signed_relative_error(const Image& picture, const Image& reference, double epsilon = 0.01);
/// (p - t)^2 / (t^2 + epsilon), channels R, G, B: what relMSE is the mean of.
Image squared_relative_error(const Image& picture, const Image& reference, double epsilon = 0.01);

}  // namespace nacre
