#include "nacre/reflectance/ggx_albedo.h"

#include <numbers>

#include "nacre/math/quadrature.h"

namespace nacre {

double ggx_albedo_by_quadrature(double mu, double alpha) {
    // Over normals of slope r = alpha sinh(y), azimuth phi from that of the light. They mirror
    // upwards while r is below tan(b), b = atan2(mu, -sin cos(phi)) / 2; near grazing incidence
    // that falls from 1 to 0 around phi = pi/2, where the nodes gather.
    static const GaussLegendre azimuths(40), slopes(16);
    constexpr int panels = 3;
    const double pi = std::numbers::pi, sine = std::sqrt(std::max(0., 1. - mu * mu));
    const double a2 = alpha * alpha;
    const auto lambda = [&](double z) {
        return 0.5 * (std::sqrt(1. + a2 * std::max(0., 1. - z * z) / (z * z)) - 1.);
    };
    const double lambda_i = lambda(mu);
    double sum = 0.;
    for (int sign : {1, -1})
        for (std::size_t i = 0; i < azimuths.node.size(); ++i) {
            const double x = 0.5 + 0.5 * azimuths.node[i];
            const double c = sign * std::cos(0.5 * pi * (1. - x * x * x));
            const double weight = 0.5 * azimuths.weight[i] * 1.5 * pi * x * x;
            const double end = std::asinh(std::tan(0.5 * std::atan2(mu, -sine * c)) / alpha);
            double inner = 0.;
            for (int p = 0; p < panels; ++p)
                inner += slopes.integrate(end * p / panels, end * (p + 1) / panels, [&](double y) {
                    const double r = alpha * std::sinh(y), sec2 = 1. + r * r;
                    const double t = 1. / std::sqrt(sec2), q = a2 + r * r;
                    const double u = t * (mu + sine * c * r);
                    const double cos_o = std::clamp(2. * u * t - mu, 1e-100, 1.);
                    const double density = a2 * sec2 * sec2 / (pi * q * q);
                    return density * u / (1. + lambda_i + lambda(cos_o)) * r * t * t * t * alpha *
                           std::cosh(y);
                });
            sum += weight * inner;
        }
    return 2. * sum / mu;
}

namespace ggx_albedo_detail {
namespace {

Table make_table() {
    const double pi = std::numbers::pi;
    const auto node = [&](int i, int n) { return std::cos(pi * (i + 0.5) / n); };
    // Coefficients from values at the nodes: a cosine transform.
    const auto coefficient = [&](int k, int n, const auto& value) {
        double sum = 0.;
        for (int i = 0; i < n; ++i) sum += value(i) * std::cos(pi * k * (i + 0.5) / n);
        return sum * (k == 0 ? 1. : 2.) / n;
    };
    double values[widths][angles], series[widths][angles];
    for (int j = 0; j < widths; ++j) {
        const double alpha = 0.5 * widest * (1. + node(j, widths));
        for (int i = 0; i < angles; ++i) {
            const double z = 0.5 + 0.5 * node(i, angles);
            const double cot = alpha * z * z / (1. - z * z);
            values[j][i] = ggx_albedo_by_quadrature(cot / std::sqrt(1. + cot * cot), alpha);
        }
        for (int k = 0; k < angles; ++k)
            series[j][k] = coefficient(k, angles, [&](int i) { return values[j][i]; });
    }
    Table t;
    for (int k = 0; k < widths; ++k)
        for (int i = 0; i < angles; ++i)
            t.albedo[k][i] = coefficient(k, widths, [&](int j) { return series[j][i]; });

    double average[averages];
    const GaussLegendre nodes(64);
    for (int j = 0; j < averages; ++j) {
        const double root = 0.5 + 0.5 * node(j, averages), alpha = widest * root * root;
        double c[angles];
        for (int i = 0; i < angles; ++i) {
            double column[widths];
            for (int k = 0; k < widths; ++k) column[k] = t.albedo[k][i];
            c[i] = chebyshev<widths>(column, 2. / widest * alpha - 1.);
        }
        // 2 E mu dmu over angles, the nodes gathered towards grazing incidence.
        average[j] = nodes.integrate(0., 1., [&](double x) {
            const double grazing = 0.5 * pi * x * x * x, mu = std::sin(grazing);
            const double sine = std::cos(grazing), z = std::sqrt(mu / (mu + alpha * sine));
            return chebyshev<angles>(c, 2. * z - 1.) * 2. * mu * sine * 1.5 * pi * x * x;
        });
    }
    for (int k = 0; k < averages; ++k)
        t.average[k] = coefficient(k, averages, [&](int j) { return average[j]; });
    return t;
}

}  // namespace

const Table& table() {
    static const Table t = make_table();
    return t;
}

}  // namespace ggx_albedo_detail
}  // namespace nacre
