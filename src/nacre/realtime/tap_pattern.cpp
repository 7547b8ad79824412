#include "nacre/realtime/tap_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int columns = 48, steps = 512;

/// Light that comes from between rho_0 and each of `rho`, in each band: integrals of R 2 pi rho by
/// Simpson's rule over logarithmic steps.
struct Cumulated {
    std::vector<double> rho;
    std::array<std::vector<double>, 3> sum;

    Cumulated(const TapKernel& kernel, double z, double first, double last) {
        const double h = std::log(last / first) / steps;
        std::array<double, 3> total{};
        const auto density = [&](int b, double r) { return kernel(b, r, z) * 2 * pi * r * r; };
        rho.push_back(first);
        for (auto& s : sum) s.push_back(0);
        for (int i = 0; i < steps; ++i) {
            const double a = first * std::exp(i * h), m = first * std::exp((i + 0.5) * h),
                         e = first * std::exp((i + 1) * h);
            rho.push_back(e);
            for (int b = 0; b < 3; ++b) {
                total[std::size_t(b)] +=
                    h / 6 * (density(b, a) + 4 * density(b, m) + density(b, e));
                sum[std::size_t(b)].push_back(total[std::size_t(b)]);
            }
        }
    }
    double mean(std::size_t i) const {
        // Each band by its share of itself, so that none is left out for being faint.
        double s = 0;
        for (const auto& band : sum) s += band.back() > 0 ? band[i] / band.back() : 0;
        return s / 3;
    }
    double at(int b, double r) const {
        const auto upper = std::ranges::lower_bound(rho, r);
        const std::size_t i = std::size_t(
            std::clamp<std::ptrdiff_t>(upper - rho.begin(), 1, std::ptrdiff_t(rho.size()) - 1));
        const double t = std::clamp((r - rho[i - 1]) / (rho[i] - rho[i - 1]), 0., 1.);
        const auto& s = sum[std::size_t(b)];
        return s[i - 1] + t * (s[i] - s[i - 1]);
    }
    double radius_of(double share) const {
        std::size_t i = 1;
        while (i + 1 < rho.size() && mean(i) < share) ++i;
        const double a = mean(i - 1), b = mean(i);
        return rho[i - 1] +
               (b > a ? std::clamp((share - a) / (b - a), 0., 1.) : 0.) * (rho[i] - rho[i - 1]);
    }
};

}  // namespace

TapPattern make_tap_pattern(const TapKernel& kernel, int rings, double near, double reach,
                            double deepest) {
    TapPattern p{.rings = rings, .columns = columns};
    // The square has the area of the disk of radius `near`.
    p.square = near * std::sqrt(pi) / square_taps;
    p.depth_scale = near;
    p.depth_range = std::log2(1 + std::max(deepest, near) / near);
    const int rows = 1 + 2 * rings;
    p.table.assign(std::size_t(4 * columns * rows), 0.f);
    const auto put = [&](int row, int column, std::size_t c, double v) {
        p.table[std::size_t(4 * (row * columns + column)) + c] = float(v);
    };
    for (int column = 0; column < columns; ++column) {
        const double z = p.depth_scale * (std::exp2(p.depth_range * column / (columns - 1.)) - 1);
        const Cumulated inside(kernel, z, 1e-3 * near, near);
        for (int b = 0; b < 3; ++b) {
            double taps = 0;
            constexpr int half = square_taps / 2;
            for (int j = -half; j <= half; ++j)
                for (int i = -half; i <= half; ++i)
                    taps += kernel(b, p.square * std::hypot(i, j), z) * p.square * p.square;
            put(0, column, std::size_t(b), taps > 0 ? inside.sum[std::size_t(b)].back() / taps : 1);
        }
        // From deep below, light comes from farther to the sides.
        const Cumulated outside(kernel, z, near, near + 2 * (reach + z));
        for (int k = 0; k < rings; ++k) {
            const double from = k == 0 ? near : outside.radius_of(double(k) / rings);
            const double to =
                k + 1 == rings ? outside.rho.back() : outside.radius_of((k + 1.) / rings);
            const double radius = outside.radius_of((k + 0.5) / rings);
            // The last ring has no end: what it stands for ends where its light does.
            const double end = k + 1 == rings ? outside.radius_of((k + 0.9) / rings) : to;
            const double area = pi * (end * end - from * from) / ring_taps;
            put(1 + 2 * k, column, 0, radius);
            put(1 + 2 * k, column, 1, area);
            for (int b = 0; b < 3; ++b) {
                const double exact = outside.at(b, to) - outside.at(b, from);
                const double taps = ring_taps * area * kernel(b, radius, z);
                put(2 + 2 * k, column, std::size_t(b), taps > 0 ? exact / taps : 0);
            }
        }
    }
    return p;
}

Texture TapPattern::texture() const {
    Texture t(TexelFormat::rgba32f, columns, 1 + 2 * rings);
    t.upload(table);
    return t;
}

}  // namespace nacre
