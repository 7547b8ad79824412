#pragma once
// Probabilities that statistical tests need.
#include <cmath>

namespace nacre {

/// Q(a, x), the upper regularised incomplete gamma function, for a > 0: series below a + 1, Lentz's
/// continued fraction above (W. H. Press et al., Numerical Recipes, section 6.2). About 1e-14.
inline double gamma_q(double a, double x) {
    if (x <= 0.) return 1.;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1.) {
        double term = 1. / a, sum = term;
        for (int n = 1; n < 1000; ++n) sum += (term *= x / (a + n));
        return 1. - sum * front;
    }
    double b = x + 1. - a, c = 1e300, d = 1. / b, h = d;
    for (int n = 1; n < 1000; ++n) {
        const double an = -n * (n - a);
        b += 2.;
        d = 1. / (an * d + b);
        c = b + an / c;
        h *= c * d;
    }
    return front * h;
}

/// Probability that chi-square with `degrees` degrees of freedom exceeds `statistic`.
inline double chi_square_probability(double statistic, int degrees) {
    return gamma_q(0.5 * degrees, 0.5 * statistic);
}

}  // namespace nacre
