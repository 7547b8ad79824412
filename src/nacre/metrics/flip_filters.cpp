#include "nacre/metrics/flip_filters.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace nacre::flip_steps {

namespace {

constexpr double pi = 3.14159265358979323846;

// Values of f at -radius to radius.
std::vector<double> sample(int radius, const std::function<double(double)>& f) {
    std::vector<double> r;
    for (int i = -radius; i <= radius; ++i) r.push_back(f(i));
    return r;
}

double sum(const std::vector<double>& taps) {
    double r = 0.;
    for (const double t : taps) r += t;
    return r;
}

// Positive taps over their sum and, if there are any, negative taps over theirs.
std::vector<float> normalised(const std::vector<double>& taps) {
    double positive = 0., negative = 0.;
    for (const double t : taps) (t > 0. ? positive : negative) += std::abs(t);
    std::vector<float> r;
    for (const double t : taps)
        r.push_back(float(t > 0. ? t / positive : t < 0. ? t / negative : 0.));
    return r;
}

}  // namespace

Plane filter(const Plane& plane, std::span<const float> across, std::span<const float> down) {
    const int width = plane.width, height = plane.height;
    const int radius_x = int(across.size()) / 2, radius_y = int(down.size()) / 2;
    Plane rows{width, height, std::vector<float>(plane.data.size())}, result = rows;
    const auto row = [width](auto& p, int y) { return p.data.data() + std::size_t(y) * width; };
    tbb::parallel_for(0, height, [&](int y) {
        // The row with its ends continued, so that the sums below need no tests.
        const float* from = row(plane, y);
        std::vector<float> padded(std::size_t(width) + 2 * radius_x);
        std::fill_n(padded.begin(), radius_x, from[0]);
        std::copy_n(from, width, padded.begin() + radius_x);
        std::fill_n(padded.end() - radius_x, radius_x, from[width - 1]);
        float* to = row(rows, y);
        for (std::size_t k = 0; k < across.size(); ++k) {
            // A convolution mirrors its filter.
            const float tap = across[across.size() - 1 - k];
            const float* at = padded.data() + k;
            for (int x = 0; x < width; ++x) to[x] += tap * at[x];
        }
    });
    tbb::parallel_for(0, height, [&](int y) {
        float* to = row(result, y);
        for (int k = -radius_y; k <= radius_y; ++k) {
            const float tap = down[std::size_t(radius_y - k)];
            const float* from = row(rows, std::clamp(y + k, 0, height - 1));
            for (int x = 0; x < width; ++x) to[x] += tap * from[x];
        }
    });
    return result;
}

std::vector<SpatialFilter> contrast_sensitivity(Opponent channel, double pixels_per_degree) {
    struct Gaussian {
        double a, b;
    };
    static const std::vector<Gaussian> table[] = {
        {{1., 0.0047}}, {{1., 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}};
    constexpr double widest = 0.04;
    const int radius = int(std::ceil(3. * std::sqrt(widest / (2. * pi * pi)) * pixels_per_degree));
    std::vector<SpatialFilter> r;
    double total = 0.;
    for (const auto& [a, b] : table[int(channel)]) {
        const double falloff = pi * pi / (b * pixels_per_degree * pixels_per_degree);
        const auto taps = sample(radius, [=](double i) { return std::exp(-falloff * i * i); });
        // The sum over the square of a product is the square of the sum over a side.
        const double volume = a * std::sqrt(pi / b) * sum(taps) * sum(taps);
        r.push_back({float(volume), normalised(taps)});
        total += volume;
    }
    for (SpatialFilter& f : r) f.weight = float(double(f.weight) / total);
    return r;
}

FeatureTaps feature_taps(double pixels_per_degree) {
    const double sigma = 0.5 * 0.082 * pixels_per_degree, s2 = sigma * sigma;
    const int radius = int(std::ceil(3. * sigma));
    const auto gaussian = [=](double x) { return std::exp(-x * x / (2. * s2)); };
    return {normalised(sample(radius, gaussian)),
            normalised(sample(radius, [=](double x) { return -x * gaussian(x); })),
            normalised(sample(radius, [=](double x) { return (x * x / s2 - 1.) * gaussian(x); }))};
}

}  // namespace nacre::flip_steps
