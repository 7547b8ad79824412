#include "nacre/goniometer/height_waves.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "nacre/math/normal_number.h"

namespace nacre {

namespace {
constexpr double pi = std::numbers::pi;
}  // namespace

std::vector<double> sum_of_waves(int n, int most,
                                 const std::function<double(int a, int b)>& amplitude,
                                 Random& random) {
    std::vector<double> cosine(static_cast<std::size_t>(n)), sine(cosine);
    for (int k = 0; k < n; ++k) {
        cosine[std::size_t(k)] = std::cos(2. * pi * k / n);
        sine[std::size_t(k)] = std::sin(2. * pi * k / n);
    }
    const auto phase = [n](int wave, int i) {  // in steps of the tables
        return std::size_t((std::int64_t(wave) * i) % n);
    };
    // For each wave number along x and both of its phases a sum of waves along y, then their sum.
    std::vector<double> heights(std::size_t(n) * n, 0.);
    std::vector<double> even(static_cast<std::size_t>(n)), odd(even), x(even), y(even);
    for (int a = 0; a <= most; ++a) {
        std::fill(even.begin(), even.end(), 0.);
        std::fill(odd.begin(), odd.end(), 0.);
        for (int b = -most; b <= most; ++b) {
            if (a == 0 && b <= 0) continue;  // waves of opposite numbers are one
            const double size = amplitude(a, b);
            if (size == 0.) continue;
            const double c = size * normal_number(random), s = size * normal_number(random);
            for (int j = 0; j < n; ++j) {
                const double u = cosine[phase(std::abs(b), j)];
                const double v = std::copysign(1., double(b)) * sine[phase(std::abs(b), j)];
                even[std::size_t(j)] += c * u + s * v;
                odd[std::size_t(j)] += s * u - c * v;
            }
        }
        for (int i = 0; i < n; ++i) {
            x[std::size_t(i)] = cosine[phase(a, i)];
            y[std::size_t(i)] = sine[phase(a, i)];
        }
        for (std::size_t j = 0; j < std::size_t(n); ++j)
            for (std::size_t i = 0; i < std::size_t(n); ++i)
                heights[j * std::size_t(n) + i] += x[i] * even[j] + y[i] * odd[j];
    }
    return heights;
}

double slope_of(const std::vector<double>& heights, int columns, int rows, double step,
                bool along) {
    double sum = 0.;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const std::size_t at = std::size_t(j) * columns + i;
            const std::size_t next = along ? std::size_t(j) * columns + (i + 1) % columns
                                           : std::size_t((j + 1) % rows) * columns + i;
            const double slope = (heights[next] - heights[at]) / step;
            sum += slope * slope;
        }
    return std::sqrt(2. * sum / (double(columns) * rows));
}

void scale_to_slope(std::vector<double>& heights, int n, double step, double alpha) {
    const double along = slope_of(heights, n, n, step, true),
                 across = slope_of(heights, n, n, step, false);
    const double scale = alpha / std::sqrt(0.5 * (along * along + across * across));
    for (double& h : heights) h *= scale;
}

}  // namespace nacre
