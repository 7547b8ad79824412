#include "nacre/compare/verdict.h"

#include <algorithm>
#include <cmath>

#include "nacre/metrics/flip.h"

namespace nacre {
namespace {

double mean_of(const std::array<double, 3>& v) { return (v[0] + v[1] + v[2]) / 3; }

/// The root of a mean square of which noise was taken off, and its standard error.
Uncertain root(const Metric& square) {
    const double value = square.corrected(), sigma = square.standard_error.value_or(0.);
    if (!(value > 0)) return {0, std::sqrt(sigma)};
    const double r = std::sqrt(value);
    // d sqrt(x) = dx / (2 sqrt(x)) as long as dx is small beside x; else no more than sqrt(dx).
    return {r, std::min(0.5 * sigma / r, std::sqrt(sigma))};
}

}  // namespace

Verdict judge(const Measurement& m, const Image& reference, const Image& reference_variance,
              const PixelMask& mask, int block) {
    MetricOptions options;
    options.block = block;
    Verdict v;
    v.metrics = compare({m.mean, &m.variance}, {reference, &reference_variance}, mask, options);
    v.systematic = root(v.metrics.block.mean_square);
    const double reference_mean = mean_of(v.metrics.mean_reference);
    if (reference_mean > 0)
        v.bias = {v.metrics.bias.value / reference_mean,
                  v.metrics.bias.standard_error.value_or(0.) / reference_mean};
    // The noise of the measurement alone: that of the reference is no part of a frame.
    const Metrics own = compare({m.mean, &m.variance}, {reference}, mask, options);
    v.noise = std::sqrt(own.rel_mse.noise.value_or(0.) * m.repeats());
    const Uncertain pixels = root(v.metrics.rel_mse);
    v.pixel_systematic = pixels.value;
    v.pixel_sigma = pixels.sigma;
    v.frame = std::hypot(v.noise, v.pixel_systematic);
    HdrFlipResult flip = flip_hdr(m.frame, reference, mask);
    v.flip = flip.mean;
    v.flip_map = std::move(flip.map);
    return v;
}

}  // namespace nacre
