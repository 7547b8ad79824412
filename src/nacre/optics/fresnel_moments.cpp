#include "nacre/optics/fresnel_moments.h"

#include <fmt/format.h>

#include <cmath>

#include "nacre/math/error.h"
#include "nacre/math/quadrature.h"
#include "nacre/optics/fresnel.h"

namespace nacre {

namespace {

// Integral over [0, 1] on panels that shrink towards 0, where the integrands below bend within
// |eta - 1| of grazing incidence.
template <class F>
double integrate_from_grazing(F&& f) {
    static const GaussLegendre rule(24);
    double sum = 0., high = 1.;
    for (double low = 0.1; low > 1e-6; high = low, low *= 0.1) sum += rule.integrate(low, high, f);
    return sum + rule.integrate(0., high, f);
}

// Moment of light that comes from the thinner side of an interface of relative index n >= 1.
double external_moment(int k, double n) {
    return integrate_from_grazing(
        [=](double mu) { return std::pow(mu, k) * fresnel_dielectric(mu, n); });
}

// Walsh 1926, as given by Duntley 1942: diffuse reflectance of glass in air, n > 1.
double external_closed_form(double n) {
    const double n2 = n * n, n4 = n2 * n2, m = n - 1., p = n + 1., q = n2 + 1.;
    return 0.5 + m * (3. * n + 1.) / (6. * p * p) +
           n2 * (n2 - 1.) * (n2 - 1.) / (q * q * q) * std::log(m / p) -
           2. * n2 * n * (n2 + 2. * n - 1.) / (q * (n4 - 1.)) +
           8. * n4 * (n4 + 1.) / (q * (n4 - 1.) * (n4 - 1.)) * std::log(n);
}

double external(double n) {
    return n > 1.01 ? external_closed_form(n) : 2. * external_moment(1, n);
}

double polynomial(double x, std::initializer_list<double> coefficients) {
    double value = 0., power = 1.;
    for (const double c : coefficients) {
        value += c * power;
        power *= x;
    }
    return value;
}

}  // namespace

double fresnel_moment(int k, double eta) {
    if (eta == 1.) return 0.;
    if (eta < 1.) return external_moment(k, 1. / eta);
    // Total reflection up to the critical cosine; beyond it the outside cosine mu_o is the
    // variable, mu dmu = mu_o dmu_o / eta^2, which takes the root out of the integrand.
    const double critical = std::sqrt(1. - 1. / (eta * eta));
    const double partial = integrate_from_grazing([=](double mu_o) {
        const double mu = refracted_cosine(mu_o, eta);
        return std::pow(mu, k - 1) * fresnel_dielectric(mu_o, eta) * mu_o;
    });
    return std::pow(critical, k + 1) / (k + 1) + partial / (eta * eta);
}

double diffuse_reflectance_external(double eta) {
    if (eta == 1.) return 0.;
    return eta > 1. ? external(eta) : 1. - (1. - external(1. / eta)) * eta * eta;
}

double diffuse_reflectance_internal(double eta) { return diffuse_reflectance_external(1. / eta); }

double diffuse_reflectance_fit(double eta) {
    const double r = 1. / eta;
    return eta < 1. ? polynomial(r, {-0.4399, 0.7099, -0.3319, 0.0636})
                    : polynomial(r, {0.668, 0.710, -1.440}) + 0.0636 * eta;
}

double two_c1_fit(double eta) {
    return eta < 1. ? polynomial(eta, {0.919317, -3.4793, 6.75335, -7.80989, 4.98554, -1.36881})
                    : polynomial(eta, {-9.23372, 22.2272, -20.9292, 10.2291, -2.54396, 0.254913});
}

double three_c2_fit(double eta) {
    if (eta < 1.)
        return polynomial(eta, {0.828421, -2.62051, 3.36231, -1.95284, 0.236494, 0.145787});
    return polynomial(1. / eta, {-1641.1, 1376.53, -656.175, 135.926}) +
           polynomial(eta, {0., 1213.67, -568.556, 164.798, -27.0181, 1.91826});
}

void check_reflectance_fit(double eta) {
    if (!(eta >= 0.4 && eta <= 3.))
        throw InputError(
            fmt::format("the fit of diffuse Fresnel reflectance of Jensen et al. 2001 holds for "
                        "relative indices eta from 0.4 to 3, not {:g}; use the exact reflectance, "
                        "--set boundary=exact, or a profile without the fit, such as better_dipole",
                        eta));
}

void check_moment_fits(double eta) {
    if (!(eta >= 0.25 && eta <= 2.5))
        throw InputError(
            fmt::format("the fits of Fresnel moments of d'Eon and Irving 2011 hold for relative "
                        "indices eta from 0.25 to 2.5, not {:g}; use the exact moments: --set "
                        "moments=exact",
                        eta));
}

double boundary_parameter(double eta, BoundaryModel model) {
    if (eta == 1.) return 1.;
    if (model == BoundaryModel::fit) check_reflectance_fit(eta);
    const double one = model == BoundaryModel::fit ? diffuse_reflectance_fit(eta)
                                                   : diffuse_reflectance_internal(eta);
    const double other = model == BoundaryModel::two_moment ? 3. * fresnel_moment(2, eta) : one;
    return (1. + other) / (1. - one);
}

}  // namespace nacre
