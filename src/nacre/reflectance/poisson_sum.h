#pragma once
// Sums over a Poisson distribution, of He-Torrance: the number of rough scatterings that a
// surface's phase variation g stands for.
#include <array>

#include "nacre/math/lanes_math.h"
#include "nacre/reflectance/model.h"

namespace nacre {

namespace poisson_detail {

/// log(j!) - ((j + 1/2) log j - j + log(2 pi)/2): Stirling's series from 10 on.
inline double stirling_error(int j) {
    if (j >= 10) {
        const double x = 1. / j, x2 = x * x;
        return x * (1. / 12 - x2 * (1. / 360 - x2 * (1. / 1260 - x2 * (1. / 1680 - x2 / 1188))));
    }
    double factorial = 1.;
    for (int i = 2; i <= j; ++i) factorial *= i;
    return std::log(factorial) - (j + 0.5) * std::log(j) + j -
           0.5 * std::log(2. * std::numbers::pi);
}

/// e^-j j^j / (j! j): the weight of j for the mean j, over j.
inline double central_weight(int j) {
    const auto compute = [](int i) {
        return std::exp(-stirling_error(i)) / (i * std::sqrt(2. * std::numbers::pi * i));
    };
    static const auto first = [&] {
        std::array<double, 512> r{};
        for (int i = 1; i < 512; ++i) r[i] = compute(i);
        return r;
    }();
    return j < 512 ? first[j] : compute(j);
}

/// Smallest and largest lane, as plain numbers.
template <class T>
std::pair<double, double> range(const T& x) {
    if constexpr (requires { T::size; })
        return {double(min_lane(x)), double(max_lane(x))};
    else if constexpr (requires { x.a; })  // a dual number
        return {double(x.a), double(x.a)};
    else
        return {double(x), double(x)};
}

/// Which j are summed.
struct Terms {
    int first, last, step;
};
template <class T>
Terms terms_of(const T& g) {
    const auto [low, high] = range(g);
    return {std::max(1, int(low - 10. * std::sqrt(low))), int(high + 14. * std::sqrt(high) + 60.),
            std::max(1, int(std::sqrt(low) / 2.5))};
}

}  // namespace poisson_detail

/// sum_{j>=1} g^j e^-g / (j! j) exp(-q/j) for g, q >= 0.
///
/// The weights are computed by their deviance (C. Loader 2000, Fast and Accurate Computation of
/// Binomial Probabilities), which neither overflows nor loses digits for large g, and those below
/// 1e-20 of the largest are left out. Terms change over sqrt(g): for large g steps of up to
/// sqrt(g)/2.5 sum to the same, as the trapezoidal rule on a bell curve does (error exp(-2 pi^2
/// 2.5^2), more where q sharpens it, and still below 1e-12).
template <class T>
T poisson_sum(const T& g, const T& q) {
    using std::exp, std::log;
    const auto [first, last, step] = poisson_detail::terms_of(g);
    const T mean = at_least(g, 1e-30);
    T sum = T(0.f);
    for (int j = first; j <= last; j += step) {
        const T ratio = T(float(j)) / mean;
        const T deviance = mean * (ratio * log(ratio) - (ratio - T(1.f)));
        const double constant = step * poisson_detail::central_weight(j);
        sum += T(constant) * exp(T(T(0.f) - deviance - q / T(float(j))));
    }
    return sum;
}

/// The same with its derivatives.
struct PoissonSum {
    double value = 0., by_g = 0., by_q = 0.;
};
inline PoissonSum poisson_sum_with_slopes(double g, double q) {
    const auto [first, last, step] = poisson_detail::terms_of(g);
    const double mean = std::max(g, 1e-30);
    PoissonSum sum;
    double before = 0.;
    for (int j = first; j <= last; j += step) {
        const double ratio = j / mean, deviance = mean * (ratio * std::log(ratio) - (ratio - 1.));
        const double term = step * poisson_detail::central_weight(j) * std::exp(-deviance - q / j);
        sum.value += term;
        sum.by_g += term * (ratio - 1.);
        sum.by_q -= term / j;
        // They rise once and fall once, ever faster.
        if (term < before && term * (1. + ratio) < 1e-17 * sum.value) break;
        before = term;
    }
    return sum;
}
/// Of dual numbers: quicker than term by term.
template <class T>
requires requires(T x) { x.a, x.v; }
T poisson_sum(const T& g, const T& q) {
    const PoissonSum sum = poisson_sum_with_slopes(g.a, q.a);
    T r(sum.value);
    r.v = sum.by_g * g.v + sum.by_q * q.v;
    return r;
}

/// The mixture of two-dimensional normal distributions to sample such a sum: of variance s j/2 a
/// direction, j >= 1 Poisson distributed with the mean g. From g = 50 on j = g stands for all: the
/// mixture has become one, to a factor of exp(x^2/(2 g)) at a distance of sqrt(2 x) deviations.
class PoissonNormals {
  public:
    PoissonNormals(double g, double s)
        : g_(std::max(g, 1e-12)), s_(s), last_(std::ceil(g_ + 14. * std::sqrt(g_) + 20.)) {}

    /// Distance from the centre, for two uniform numbers in [0, 1).
    double radius(double u, double v) const {
        double j = g_;
        if (g_ < many) {
            double weight = g_ / std::expm1(g_);
            for (j = 1.; u >= weight && j < last_; weight *= g_ / j) {
                u -= weight;
                j += 1.;
            }
        }
        return std::sqrt(-s_ * j * std::log(1. - v));
    }
    /// Density over the plane at the squared distance r2.
    double density(double r2) const {
        const auto normal = [&](double j) {
            return std::exp(-r2 / (s_ * j)) / (std::numbers::pi * s_ * j);
        };
        if (!(g_ < many)) return normal(g_);
        double sum = 0., weight = g_ / std::expm1(g_);
        for (double j = 1.; j <= last_; weight *= g_ / j) {
            sum += weight * normal(j);
            j += 1.;
        }
        return sum;
    }

  private:
    static constexpr double many = 50.;
    double g_, s_, last_;
};

}  // namespace nacre
