#pragma once
// Integrals of radial profiles over disks, by quadrature.
#include <cmath>
#include <numbers>

#include "nacre/math/quadrature.h"

namespace nacre {

/// Integral of 2 pi r f(r) over r in [from, to], 0 < from: panels that grow by half of `from`, so
/// that powers of r and exponentials that change on the scale of r are met to about 1e-8.
template <class F>
double ring_integral(double from, double to, F&& f) {
    static const GaussLegendre rule(8);
    double sum = 0.;
    for (double low = from; low < to;) {
        const double high = low * 1.5 >= to ? to : low * 1.5;
        sum += rule.integrate(low, high, [&](double r) { return r * f(r); });
        low = high;
    }
    return 2. * std::numbers::pi * sum;
}

/// Over the disk of radius `to`, of a profile that grows no faster than 1/r towards 0 and whose
/// lengths are of the order of `scale`: what lies within 1e-8 scale is taken as 1/r.
template <class F>
double disk_integral(double to, double scale, F&& f) {
    const double innermost = std::fmin(1e-8 * scale, to);
    return 2. * std::numbers::pi * innermost * innermost * f(innermost) +
           ring_integral(innermost, to, f);
}

}  // namespace nacre
