#include "nacre/reflectance/albedo.h"

#include <algorithm>
#include <queue>

#include "nacre/math/quadrature.h"
#include "nacre/math/random.h"
#include "nacre/reflectance/model.h"

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

/// A seed in polar coordinates.
struct Point {
    double t, p, density;
};

/// Halves a cell's longer side until no point in it speaks of a mass far above the share of the
/// points there (`share` a point), and hands the parts to `leaf`.
void plant(double t0, double t1, double p0, double p1, std::span<Point> points, double share,
           int depth, const std::function<void(double, double, double, double)>& leaf) {
    const double width = t1 - t0, across = std::sin(0.5 * (t0 + t1)) * (p1 - p0);
    const double size = 2. * across * std::sin(0.5 * width);
    double highest = 0.;
    for (const Point& x : points) highest = std::max(highest, x.density);
    if (depth == 0 || highest * size <= 16. * share * double(points.size()))
        return leaf(t0, t1, p0, p1);
    const bool by_polar = width >= across;
    const double middle = by_polar ? 0.5 * (t0 + t1) : 0.5 * (p0 + p1);
    const auto end = std::partition(points.begin(), points.end(), [&](const Point& x) {
        return (by_polar ? x.t : x.p) < middle;
    });
    const std::size_t n = std::size_t(end - points.begin());
    plant(t0, by_polar ? middle : t1, p0, by_polar ? p1 : middle, points.first(n), share, depth - 1,
          leaf);
    plant(by_polar ? middle : t0, t1, by_polar ? p0 : middle, p1, points.subspan(n), share,
          depth - 1, leaf);
}

}  // namespace

double integrate_cell(const Function& f, double theta0, double theta1, double phi0, double phi1,
                      double tolerance) {
    return refined(f, theta0, theta1, phi0, phi1, rule(f, theta0, theta1, phi0, phi1), tolerance,
                   8);
}

Integral integrate_hemisphere(const Function& f, const Vec3d& wi, double tolerance,
                              std::span<const Seed> seeds) {
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
    std::vector<Point> points;
    for (const Seed& seed : seeds) {
        const Vec3d& w = seed.direction;
        double p = std::atan2(w.y, w.x);
        while (p < phi) p += 2. * pi;
        points.push_back({std::atan2(std::hypot(w.x, w.y), w.z), p, seed.density});
    }
    const double share = 1. / double(std::max<std::size_t>(points.size(), 1));
    const auto begin = [&](double t0, double t1, double p0, double p1) {
        const auto end = std::partition(points.begin(), points.end(), [&](const Point& x) {
            return x.t >= t0 && x.t < t1 && x.p >= p0 && x.p < p1;
        });
        plant(t0, t1, p0, p1, {points.begin(), end}, share, 80,
              [&](double a, double b, double c, double d) {
                  split(a, b, c, d, rule(f, a, b, c, d));
              });
    };
    // Eight azimuths, from that of wi on, and two levels of quarters to begin with.
    for (std::size_t i = 0; i + 1 < thetas.size(); ++i)
        for (int k = 0; k < 8; ++k) {
            const double p0 = phi + k * pi / 4;
            for (int q = 0; q < 4; ++q) {
                const double dt = (thetas[i + 1] - thetas[i]) / 2, dp = pi / 8;
                const double a = thetas[i] + (q / 2) * dt, b = p0 + (q % 2) * dp;
                begin(a, a + dt, b, b + dp);
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
    constexpr int count = 1024;
    const ValuesD values = model.values_double(nm);
    const ValuesS drawn_from = model.values(Wavelengths::at(Spectral(float(nm))));
    const Evaluator& evaluator = model.evaluator();
    const Function f = [&](const Vec3d& wo) { return evaluator.eval(values, wi, wo) * wo.z; };

    std::vector<Seed> seeds;
    double sum = 0., squares = 0.;
    Random random(stream_key(1, 51));
    for (int i = 0; i < count; ++i) {
        const float u1 = (float(i) + 0.5f) / float(count);
        const Vec3d w =
            normalize(Vec3d(evaluator.sample(drawn_from, Vec3f(wi), u1, random.next2())));
        if (!(w.z > 0.)) continue;
        const double density = evaluator.pdf(values, w, wi), value = f(w);
        const double weight = density > 0. ? value / density : 0.;
        sum += weight;
        squares += weight * weight;
        seeds.push_back({w, std::max(density, value)});
    }
    // Lobes too faint for the sampler to choose.
    for (const Vec3d& w : {mirrored(wi), wi})
        if (w.z > 0.) seeds.push_back({w, std::max(evaluator.pdf(values, w, wi), f(w))});

    Albedo a = integrate_hemisphere(f, wi, tolerance, seeds);
    const double mean = sum / count;
    const double deviation = std::sqrt(std::max(0., squares / count - mean * mean) / count);
    const double off = std::abs(a.value - mean);
    if (!(off <= 6. * deviation + 1e-6 * mean)) a.error = std::max(a.error, off);
    return a;
}

}  // namespace nacre
