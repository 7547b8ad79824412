#include "nacre/reflectance/albedo.h"

#include <queue>

#include "nacre/math/quadrature.h"

namespace nacre {
namespace {

struct Cell {
    double t0, t1, p0, p1;  ///< polar angle, azimuth
    double value, error;
    bool operator<(const Cell& o) const { return error < o.error; }
};

using Function = std::function<double(const Vec3d&)>;

double rule(const Function& f, double t0, double t1, double p0, double p1) {
    static const GaussLegendre nodes(7);
    std::array<double, 7> c, s;
    for (int j = 0; j < 7; ++j) {
        const double phi = 0.5 * (p0 + p1) + 0.5 * (p1 - p0) * nodes.node[j];
        c[j] = std::cos(phi);
        s[j] = std::sin(phi);
    }
    return nodes.integrate(t0, t1, [&](double theta) {
        const double st = std::sin(theta), ct = std::cos(theta);
        double sum = 0.;
        for (int j = 0; j < 7; ++j) sum += nodes.weight[j] * f({st * c[j], st * s[j], ct});
        return 0.5 * (p1 - p0) * st * sum;
    });
}

/// `whole` is the rule over the cell.
double refined(const Function& f, double t0, double t1, double p0, double p1, double whole,
               double tolerance, int depth) {
    const double t = 0.5 * (t0 + t1), p = 0.5 * (p0 + p1);
    const double a = rule(f, t0, t, p0, p), b = rule(f, t0, t, p, p1);
    const double c = rule(f, t, t1, p0, p), d = rule(f, t, t1, p, p1);
    if (depth == 0 || std::abs(a + b + c + d - whole) <= tolerance) return a + b + c + d;
    return refined(f, t0, t, p0, p, a, tolerance / 2., depth - 1) +
           refined(f, t0, t, p, p1, b, tolerance / 2., depth - 1) +
           refined(f, t, t1, p0, p, c, tolerance / 2., depth - 1) +
           refined(f, t, t1, p, p1, d, tolerance / 2., depth - 1);
}

}  // namespace

double integrate_cell(const Function& f, double theta0, double theta1, double phi0, double phi1,
                      double tolerance) {
    return refined(f, theta0, theta1, phi0, phi1, rule(f, theta0, theta1, phi0, phi1), tolerance,
                   8);
}

Integral integrate_hemisphere(const Function& f, const Vec3d& wi, double tolerance) {
    const double pi = std::numbers::pi;
    const double theta = std::acos(std::clamp(wi.z, 0., 1.)), phi = std::atan2(wi.y, wi.x);
    std::vector<double> thetas{0.};
    for (double t : {0.25 * pi, theta, 0.5 * pi})
        if (t > thetas.back() + 1e-6) thetas.push_back(t);
    thetas.back() = 0.5 * pi;

    std::priority_queue<Cell> cells;
    double total = 0., error = 0.;
    const auto split = [&](double t0, double t1, double p0, double p1, double whole) {
        const double t = 0.5 * (t0 + t1), p = 0.5 * (p0 + p1);
        Cell parts[4] = {{t0, t, p0, p, 0., 0.},
                         {t0, t, p, p1, 0., 0.},
                         {t, t1, p0, p, 0., 0.},
                         {t, t1, p, p1, 0., 0.}};
        double sum = 0.;
        for (Cell& c : parts) sum += c.value = rule(f, c.t0, c.t1, c.p0, c.p1);
        for (Cell& c : parts) {
            c.error = std::abs(sum - whole) * 0.25;
            total += c.value;
            error += c.error;
            cells.push(c);
        }
    };
    // Eight azimuths, from that of wi on, and two levels of quarters to begin with.
    for (std::size_t i = 0; i + 1 < thetas.size(); ++i)
        for (int k = 0; k < 8; ++k) {
            const double p0 = phi + k * pi / 4;
            for (int q = 0; q < 4; ++q) {
                const double dt = (thetas[i + 1] - thetas[i]) / 2, dp = pi / 8;
                const double a = thetas[i] + (q / 2) * dt, b = p0 + (q % 2) * dp;
                split(a, a + dt, b, b + dp, rule(f, a, a + dt, b, b + dp));
            }
        }
    while (error > tolerance && cells.size() < 20000) {
        const Cell c = cells.top();
        cells.pop();
        total -= c.value;
        error -= c.error;
        split(c.t0, c.t1, c.p0, c.p1, c.value);
    }
    // Sums without the rounding of adding and taking away.
    Integral r;
    for (; !cells.empty(); cells.pop()) {
        r.value += cells.top().value;
        r.error += cells.top().error;
    }
    return r;
}

Albedo directional_albedo(const AnyModel& model, const Vec3d& wi, double nm, double tolerance) {
    const ValuesD values = model.values_double(nm);
    const Evaluator& evaluator = model.evaluator();
    return integrate_hemisphere(
        [&](const Vec3d& wo) { return evaluator.eval(values, wi, wo) * wo.z; }, wi, tolerance);
}

}  // namespace nacre
