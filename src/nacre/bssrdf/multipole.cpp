#include "nacre/bssrdf/multipole.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "nacre/bssrdf/dipole.h"
#include "nacre/math/error.h"

namespace nacre {

namespace {

using std::numbers::pi;

// Images of either sign on each side at most, and the exponents at which images and modes have
// died.
constexpr int most_images = 256;
constexpr double dead = 40.;

// sinh(x) / sinh(y) for 0 <= x <= y, without overflow and with its limit x / y at 0.
double sinh_ratio(double x, double y) {
    return std::exp(x - y) * x * point_source::mean_attenuation(2. * x) /
           (y * point_source::mean_attenuation(2. * y));
}

}  // namespace

Multipole::Multipole(const ProfileMedium& medium, double thickness, double eta_below,
                     BoundaryModel boundary)
    : thickness_(thickness) {
    const Dipole<double> dipole(medium.sigma_s_prime(), medium.sigma_a, medium.eta, boundary);
    albedo_ = dipole.albedo;
    sigma_tr_ = dipole.sigma_tr;
    depth_ = dipole.z_r;
    if (!(thickness >= depth_) || !std::isfinite(thickness))
        throw InputError(
            fmt::format("multipole: thickness = {:g} mm must be finite and at least the transport "
                        "mean free path, {:g} mm",
                        thickness, depth_));
    if (!(eta_below > 0.) || !std::isfinite(eta_below))
        throw InputError(
            fmt::format("multipole: eta_below = {:g} must be positive and finite", eta_below));
    upper_shift_ = 0.5 * (dipole.z_v - dipole.z_r);
    lower_shift_ = 2. / 3. * depth_ * boundary_parameter(eta_below, boundary);
    period_ = thickness + upper_shift_ + lower_shift_;
}

template <class F>
double Multipole::over_images(Face face, F&& of) const {
    // Height of the plane over a source at depth z is z seen from above, and thickness - z from
    // below.
    const auto pair = [&](int i) {
        const double real = 2. * i * period_ + depth_;
        const double image = 2. * i * period_ - depth_ - 2. * upper_shift_;
        return face == upper ? of(real) - of(image)
                             : of(thickness_ - real) - of(thickness_ - image);
    };
    double sum = pair(0);
    for (int i = 1; i <= most_images && 2. * (i - 1) * period_ * sigma_tr_ < dead; ++i)
        sum += pair(i) + pair(-i);
    return sum;
}

template <class F>
double Multipole::over_modes(Face face, double r, F&& of) const {
    double sum = 0.;
    for (int i = 1; i * pi * r / period_ < dead; ++i) {
        const double wave = i * pi / period_;
        const double k = std::sqrt(sigma_tr_ * sigma_tr_ + wave * wave);
        if (k * r > 600.) break;  // K_0 and K_1 are below 1e-260
        const double slope = face == upper ? std::cos(wave * upper_shift_)
                                           : -std::cos(wave * (thickness_ + upper_shift_));
        sum += wave * std::sin(wave * (depth_ + upper_shift_)) * slope * of(k);
    }
    return albedo_ / (pi * period_) * sum;
}

double Multipole::profile(double r, Face face) const {
    if (r > 0.5 * period_)
        return over_modes(face, r, [&](double k) { return std::cyl_bessel_k(0., k * r); });
    return albedo_ * 0.25 * std::numbers::inv_pi *
           over_images(face, [&](double z) { return point_source::at(r * r, z, sigma_tr_).flux; });
}

double Multipole::within(double r, Face face) const {
    if (r > 0.5 * period_)
        return total(face) - over_modes(face, r, [&](double k) {
                   return 2. * pi * r * std::cyl_bessel_k(1., k * r) / k;
               });
    return albedo_ * over_images(face, [&](double z) {
               return std::copysign(point_source::flux_within(r * r, std::abs(z), sigma_tr_), z);
           });
}

double Multipole::total(Face face) const {
    const double near = face == upper ? upper_shift_ : lower_shift_;
    const double rest = face == upper ? thickness_ - depth_ + lower_shift_ : depth_ + upper_shift_;
    // cosh(near) sinh(rest) = (sinh(rest + near) + sinh(rest - near)) / 2
    const double y = sigma_tr_ * period_;
    if (y == 0.) return albedo_ * rest / period_;
    const auto part = [&](double x) { return std::copysign(sinh_ratio(std::abs(x), y), x); };
    return 0.5 * albedo_ * (part(sigma_tr_ * (rest + near)) + part(sigma_tr_ * (rest - near)));
}

}  // namespace nacre
