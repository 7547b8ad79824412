#pragma once
// The medium whose random walks give a wanted surface albedo.
//
//   M. J.-Y. Chiang, P. Kutz, B. Burley 2016, Practical and Controllable Subsurface Scattering for
//   Production Path Tracing, SIGGRAPH 2016 Talks.
//
//   alpha = 1 - e^(-5.09406 A + 2.61188 A^2 - 4.31805 A^3),   s = 1.9 - A + 3.5 (A - 0.8)^2,
//   sigma_t = 1 / (d s),   sigma_s = alpha sigma_t
//
// A in [0, 1] is the multiple-scattering albedo of a half space, d (mm) the scattering distance.
// The fit holds for isotropic scattering, light that enters in the cosine's distribution, and a
// boundary of equal indices. It ends at alpha(1) = 0.99888, whose half space returns 0.926 by van
// de Hulst's formula: near A = 1 the walks are darker than asked for.
#include <fmt/format.h>

#include <cmath>

#include "nacre/bssrdf/normalised_diffusion.h"
#include "nacre/math/error.h"

namespace nacre {

/// Single-scattering albedo of surface albedo A.
template <class T>
T chiang2016_single_albedo(T a) {
    using std::exp;
    return T(1) - exp(-a * (T(5.09406) - a * (T(2.61188) - a * T(4.31805))));
}

/// Coefficients in mm^-1.
template <class T>
struct RandomWalkMedium {
    T sigma_t, sigma_s;
};

/// For A in [0, 1] and distance d > 0 (mm); nothing is checked. Red, green and blue at once as
/// Spectral.
template <class T>
RandomWalkMedium<T> chiang2016_medium(T a, T d) {
    const T sigma_t = T(1) / (d * normalised_diffusion_scale(a, NormalisedDiffusionFit::diffuse));
    return {sigma_t, chiang2016_single_albedo(a) * sigma_t};
}

/// Throws InputError unless A is in [0, 1] and d > 0.
inline void check_chiang2016(double a, double d) {
    if (!(a >= 0. && a <= 1.))
        throw InputError(fmt::format("chiang2016: albedo = {:g} must be between 0 and 1", a));
    if (!(d > 0.) || !std::isfinite(d))
        throw InputError(fmt::format("chiang2016: distance = {:g} must be positive and finite", d));
}

/// The surface albedo A of single-scattering albedo alpha in [0, 1]: the inverse of the fit, which
/// grows with A; 1 where alpha is above what the fit reaches.
inline double chiang2016_surface_albedo(double alpha) {
    double low = 0., high = 1.;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (chiang2016_single_albedo(middle) < alpha ? low : high) = middle;
    }
    return alpha > 0. ? 0.5 * (low + high) : 0.;
}

}  // namespace nacre
