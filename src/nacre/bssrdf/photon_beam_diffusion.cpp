#include "nacre/bssrdf/photon_beam_diffusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/bssrdf/better_dipole.h"
#include "nacre/bssrdf/radial_integral.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/phase_henyey_greenstein.h"

namespace nacre {

namespace {

using std::numbers::inv_pi;
using std::numbers::pi;

// Optical depth below which nothing is left to add: e^-40 = 4e-18.
constexpr double deepest = 40.;

}  // namespace

PhotonBeamDiffusion::PhotonBeamDiffusion(const ProfileMedium& medium, bool kappa,
                                         MomentModel moments)
    : kappa_(kappa) {
    const BetterDipole<double> dipole(medium.sigma_s_prime(), medium.sigma_a, medium.eta, moments);
    sigma_t_prime_ = medium.sigma_t_prime();
    albedo_ = medium.reduced_albedo();
    diffusion_ = dipole.diffusion;
    sigma_tr_ = dipole.sigma_tr;
    image_shift_ = dipole.z_v - dipole.z_r;
    c_phi_ = dipole.c_phi;
    c_e_ = dipole.c_e;
}

template <class F>
double PhotonBeamDiffusion::along_beam(double r, F&& weight) const {
    static const GaussLegendre rule(10);
    const double end = deepest / sigma_t_prime_;
    // u with z = r sinh u takes the peak of width r at z = 0 out of the integrand. A panel spans at
    // most 0.75 in u and three mean free paths in z, on either of which the integrand is smooth.
    double sum = 0., z = 0.;
    while (z < end) {
        const double u = std::asinh(z / r);
        const double next = std::min({r * std::sinh(u + 0.75), z + 3. / sigma_t_prime_, end});
        sum += rule.integrate(u, std::asinh(next / r), [&](double v) {
            const double depth = r * std::sinh(v), d = r * std::cosh(v);
            const auto real = point_source::at(r * r, depth, sigma_tr_);
            const auto image = point_source::at(r * r, depth + image_shift_, sigma_tr_);
            return d * std::exp(-sigma_t_prime_ * depth) * weight(d + depth) *
                   (c_phi_ / diffusion_ * (real.fluence - image.fluence) +
                    c_e_ * (real.flux + image.flux));
        });
        z = next;
    }
    return 0.25 * inv_pi * albedo_ * albedo_ * sigma_t_prime_ * sum;
}

double PhotonBeamDiffusion::eval(double r) const {
    if (!kappa_) return along_beam(r, [](double) { return 1.; });
    return along_beam(r, [&](double way) { return -std::expm1(-2. * sigma_t_prime_ * way); });
}

double PhotonBeamDiffusion::total() const {
    // Without kappa: the totals of pairs, whose dependence on depth is e^(-sigma_tr z).
    const double share = sigma_t_prime_ / (sigma_t_prime_ + sigma_tr_);
    const double all = albedo_ * albedo_ * share *
                       (c_phi_ / diffusion_ *
                            point_source::fluence_of_pair_everywhere(0., image_shift_, sigma_tr_) +
                        c_e_ * (0.5 + point_source::flux_everywhere(image_shift_, sigma_tr_)));
    if (!kappa_) return all;
    // What kappa takes away lies within a few mean free paths, and nearer than 1e-5 of one only
    // 1e-5 of it, as that of a profile that grows as 1/r.
    const double path = 1. / sigma_t_prime_;
    return all - disk_integral(0.5 * deepest * path, 1e3 * path, [&](double r) {
               return along_beam(r, [&](double way) { return std::exp(-2. * way / path); });
           });
}

double BeamSingleScattering::eval(double r) const {
    static const GaussLegendre rule(10);
    const HenyeyGreensteinPhase<double> phase{medium_.g};
    const double sigma_t = medium_.sigma_t(), n = medium_.eta;
    // The angle on the denser side is the variable, where transmission is smooth up to grazing:
    //   R = sigma_s / r integral of e^(-sigma_t r (1 + mu) / s) p(-mu) (1 - F) m(theta),
    // with s = sqrt(1 - mu^2) inside; s = sin(theta) / n and m = cos(theta) / n for n > 1.
    const double inside_over_outside = n > 1. ? 1. / n : 1.;
    const auto integrand = [&](double theta) {
        const double c = std::cos(theta), s = std::sin(theta) * inside_over_outside;
        const double mu = std::sqrt(1. - s * s);
        const double transmitted =
            1. - (n > 1. ? fresnel_dielectric(c, n) : fresnel_dielectric(c, 1. / n));
        return std::exp(-sigma_t * r * (1. + mu) / s) * phase.eval(-mu) * transmitted * c *
               inside_over_outside;
    };
    // Panels from grazing down that at most halve the angle and change the exponent by about four,
    // until it has fallen by `deepest`.
    const double depth = sigma_t * r / inside_over_outside;
    double sum = 0., high = 0.5 * pi;
    while (depth * (1. / std::sin(high) - 1.) < deepest) {
        const double low = std::max(0.5 * high, std::asin(1. / (1. / std::sin(high) + 2. / depth)));
        sum += rule.integrate(low, high, integrand);
        high = low;
    }
    return medium_.sigma_s / r * sum;
}

double BeamSingleScattering::total() const {
    static const GaussLegendre rule(32);
    const HenyeyGreensteinPhase<double> phase{medium_.g};
    const double n = medium_.eta;
    // Again by the cosine on the denser side, mu dmu = m dm / n^2 for n > 1; panels towards 0 for
    // transmission near equal indices, and towards 1 for backward peaks.
    const auto integrand = [&](double m) {
        const double mu = n > 1. ? refracted_cosine(m, n) : m;
        const double measure = n > 1. ? m / (n * n) : m;
        return phase.eval(-mu) * (1. - fresnel_dielectric(m, n > 1. ? n : 1. / n)) * measure /
               (1. + mu);
    };
    double sum = 0.;
    for (double a = 0.5; a > 1e-7; a *= 0.25)
        sum += rule.integrate(0.25 * a, a, integrand) +
               rule.integrate(1. - a, 1. - 0.25 * a, integrand);
    return 2. * pi * medium_.sigma_s / medium_.sigma_t() * sum;
}

}  // namespace nacre
