#include "nacre/bssrdf/quantised_diffusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/bssrdf/better_dipole.h"

namespace nacre {

namespace {

// e^(x^2) erfc(x) for x >= 0, to 3e-12: the product while erfc is normal, then four terms of its
// asymptotic series, the fifth of which is below 3e-12 at 20.
double scaled_erfc(double x) {
    if (x < 20.) return std::exp(x * x) * std::erfc(x);
    const double t = 0.5 / (x * x);
    return std::numbers::inv_sqrtpi / x * (1. - t * (1. - 3. * t * (1. - 5. * t * (1. - 7. * t))));
}

}  // namespace

GaussianSum quantised_diffusion(const ProfileMedium& medium, int count, MomentModel moments) {
    using std::exp, std::sqrt;
    const BetterDipole<double> dipole(medium.sigma_s_prime(), medium.sigma_a, medium.eta, moments);
    const double sigma_t = medium.sigma_t_prime(), sigma_a = medium.sigma_a;
    const double d = dipole.diffusion, b = dipole.z_v - dipole.z_r;

    const auto length = [&](double spread) { return spread * spread / (2. * d); };
    const double first = length(1e-3 / sigma_t);
    const double last = std::min(length(1e3 / sigma_t), sigma_a > 0. ? 14. / sigma_a : 1e300);
    const double ratio = std::pow(last / first, 1. / count);

    GaussianSum sum;
    double from = first;
    for (int i = 0; i < count; ++i) {
        const double to = from * ratio, span = to - from;
        const double survives =
            exp(-sigma_a * from) * span * point_source::mean_attenuation(sigma_a * span);
        const double v = 2. * d * span / std::log(ratio);  // the logarithmic mean of its ends
        const double spread = sqrt(2. * v), g = 1. / sqrt(2. * std::numbers::pi * v);
        const double shifted = exp(-b * b / (2. * v));
        const double w_real = 0.5 * sigma_t * scaled_erfc(sigma_t * v / spread);
        const double w_image = 0.5 * sigma_t * shifted * scaled_erfc((sigma_t * v + b) / spread);
        const double flux = d * sigma_t * (g * (1. + shifted) - w_real - w_image);
        sum.terms.push_back({v, dipole.albedo_squared * survives *
                                    (dipole.c_phi * (w_real - w_image) + dipole.c_e * flux)});
        from = to;
    }
    return sum;
}

}  // namespace nacre
