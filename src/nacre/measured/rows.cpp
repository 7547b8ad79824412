#include "nacre/measured/rows.h"

#include <cmath>
#include <numbers>

#include "nacre/measured/number_text.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180.;
constexpr std::size_t most_samples = 100000;
/// The last angle of a grid, degrees: at the horizon itself BRDFs need not have a value.
constexpr double near_horizon = 89.;

double phi_of(const Vec3d& w) { return w.x == 0. && w.y == 0. ? 0. : std::atan2(w.y, w.x); }

void own_samples(const Measured& data, const std::function<void(const MeasuredRow&)>& visit) {
    const MeasuredInfo& info = data.info();
    data.for_each_sample([&](const MeasuredSample& s) {
        const bool known = s.state != SampleState::missing;
        if (!known && !(s.wi.z > 0. && (s.wo.z > 0. || info.transmission_front))) return;
        if (!(s.wi.z > 0.)) return;
        AngleRow a{theta_of(s.wi), phi_of(s.wi), theta_of(s.wo), phi_of(s.wo)};
        if (info.isotropic) {
            // What is turned by a whole circle is the same row.
            a.phi_o = std::remainder(a.phi_o - a.phi_i, 2. * pi);
            a.phi_i = 0.;
        }
        visit({a, s.value, known});
    });
}

/// Whole steps that fill `length`.
std::vector<double> steps(double length, double step, bool with_end) {
    const int n = std::max(int(std::lround(length / step)), 1);
    std::vector<double> values;
    for (int i = 0; i < n + with_end; ++i) values.push_back(length * i / n);
    return values;
}

void grid(const Measured& data, double step, const std::function<void(const MeasuredRow&)>& visit) {
    const MeasuredInfo& info = data.info();
    std::vector<double> theta = steps(90., step, false);
    if (theta.back() < near_horizon) theta.push_back(near_horizon);
    const double around = std::max(step, 15.);
    const std::vector<double> phi_i =
        info.isotropic ? std::vector<double>{0.} : steps(360., around, false);
    const std::vector<double> phi_o =
        info.isotropic ? steps(180., step, true) : steps(360., around, false);
    std::vector<double> theta_o = theta;
    if (info.transmission_front)
        for (auto t = theta.rbegin(); t != theta.rend(); ++t) theta_o.push_back(180. - *t);
    std::vector<double> value(std::size_t(info.channels));
    for (const double ti : theta)
        for (const double pi_ : phi_i)
            for (const double to : theta_o)
                for (const double po : phi_o) {
                    const AngleRow a{ti * degree, pi_ * degree, to * degree, po * degree};
                    const bool known = data.eval(polar_direction(a.theta_i, a.phi_i),
                                                 polar_direction(a.theta_o, a.phi_o), value);
                    visit({a, value, known});
                }
}

}  // namespace

void for_each_row(const Measured& data, const WriteOptions& options,
                  const std::function<void(const MeasuredRow&)>& visit) {
    const std::size_t samples = data.info().samples;
    // Nodes of a warp lie well for the warp, and badly for interpolation between the nearest.
    const bool own = data.info().format != "rgl" && samples > 0 && samples <= most_samples;
    if (options.samples && own)
        own_samples(data, visit);
    else
        grid(data, options.step, visit);
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32) c = ' ';
    return text;
}

}  // namespace nacre
