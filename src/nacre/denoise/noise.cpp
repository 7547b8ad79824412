#include "nacre/denoise/noise.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace nacre::denoising {
namespace {

/// 5 x 5 pixels without the middle: f(dx, dy).
template <class F>
void for_each_neighbour(F&& f) {
    constexpr int r = 2;
    for (int dy = -r; dy <= r; ++dy)
        for (int dx = -r; dx <= r; ++dx)
            if (dx || dy) f(dx, dy);
}
constexpr int neighbours = 24;

float brightness(const Planes& planes, int x, int y) {
    return *planes.at(0, x, y) + *planes.at(1, x, y) + *planes.at(2, x, y);
}

/// How bright both halves are around a pixel, in order, without the brightest, which may be of the
/// same kind.
void around(const std::array<Planes, 2>& halves, int x, int y, std::vector<float>& values) {
    values.clear();
    for_each_neighbour([&](int dx, int dy) {
        for (const Planes& half : halves) values.push_back(brightness(half, x + dx, y + dy));
    });
    std::sort(values.begin(), values.end());
    values.pop_back();
}

/// The most that goes for noise among such values.
float usual(const std::vector<float>& values) {
    double sum = 0, squares = 0;
    for (const float v : values) sum += v, squares += double(v) * v;
    const double n = double(values.size()), mean = sum / n;
    return float(mean + 8 * std::sqrt(std::max(0., squares / n - mean * mean)));
}

float mean_around(const Planes& planes, int c, int x, int y) {
    float sum = 0;
    for_each_neighbour([&](int dx, int dy) { sum += *planes.at(c, x + dx, y + dy); });
    return sum / neighbours;
}

/// Sums over squares of 2 r + 1 pixels a side.
Planes box_sums(const Planes& values, int r) {
    Planes rows(values.width(), values.height(), 1), result = rows;
    tbb::parallel_for(0, values.height(), [&](int y) {
        for (int x = 0; x < values.width(); ++x) {
            double sum = 0;
            for (int i = -r; i <= r; ++i) sum += *values.at(0, x + i, y);
            *rows.at(0, x, y) = float(sum);
        }
    });
    rows.mirror();
    tbb::parallel_for(0, values.height(), [&](int y) {
        for (int x = 0; x < values.width(); ++x) {
            double sum = 0;
            for (int i = -r; i <= r; ++i) sum += *rows.at(0, x, y + i);
            *result.at(0, x, y) = float(sum);
        }
    });
    return result;
}

}  // namespace

void remove_fireflies(std::array<Planes, 2>& halves, Planes& variance) {
    const std::array<Planes, 2> before = halves;
    const Planes variance_before = variance;
    tbb::parallel_for(0, variance.height(), [&](int y) {
        std::vector<float> values;
        for (int x = 0; x < variance.width(); ++x)
            for (int h = 0; h < 2; ++h) {
                const float own = brightness(before[h], x, y),
                            other = brightness(before[1 - h], x, y);
                if (!(own > 2.f * other)) continue;
                around(before, x, y, values);
                const float brightest = values.back();
                if (!(own > 3.f * brightest && own > usual(values))) continue;
                for (int c = 0; c < 3; ++c) {
                    *halves[h].at(c, x, y) *= std::max(other, brightest) / own;
                    *variance.at(c, x, y) = std::min(*variance_before.at(c, x, y),
                                                     mean_around(variance_before, c, x, y));
                }
            }
    });
    for (Planes& half : halves) half.mirror();
    variance.mirror();
}

Planes calibrated_variance(const std::array<Planes, 2>& halves, const Planes& variance,
                           const std::array<float, 2>& share) {
    constexpr int r = 10;
    const int width = variance.width(), height = variance.height();
    Planes seen(width, height, 1), said(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float d2 = 0.f, v = 0.f, m = 0.f;
            for (int c = 0; c < 3; ++c) {
                const float a = *halves[0].at(c, x, y), b = *halves[1].at(c, x, y);
                d2 += (a - b) * (a - b) * share[0] * share[1];
                v += *variance.at(c, x, y);
                m += a * a + b * b;
            }
            const float scale = 1.f / (m + v + 1e-30f);
            *seen.at(0, x, y) = d2 * scale;
            *said.at(0, x, y) = v * scale;
        }
    seen.mirror();
    said.mirror();
    const Planes seen_around = box_sums(seen, r), said_around = box_sums(said, r);
    Planes result = variance;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float s = *said_around.at(0, x, y);
                if (s > 0.f)
                    *result.at(c, x, y) *= std::clamp(*seen_around.at(0, x, y) / s, 0.01f, 2.f);
            }
    result.mirror();
    return result;
}

}  // namespace nacre::denoising
