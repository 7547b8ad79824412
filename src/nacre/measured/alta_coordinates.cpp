#include "nacre/measured/alta_coordinates.h"

#include <numbers>

#include "nacre/measured/number_text.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// One line of a file, with the checks of its angles.
struct Row {
    const MeasuredSource& source;
    std::size_t line;

    double theta(std::string_view name, double value) const {
        return checked_theta(source, line, name, value, 0.5 * pi);
    }
    double phi(std::string_view name, double value) const {
        return checked_phi(source, line, name, value);
    }
    /// An angle from its cosine.
    double arc(std::string_view name, double cosine) const {
        if (!(std::abs(cosine) <= 1. + 1e-6))
            source.fail(line,
                        fmt::format("the cosine of {} is {:g}, which no angle has", name, cosine));
        return theta(name, std::acos(std::clamp(cosine, -1., 1.)));
    }
    /// A direction by its angle to `z`, laid out in the plane: theta cos(phi), theta sin(phi).
    Vec3d projected(std::string_view name, double x, double y) const {
        return polar_direction(theta(name, std::hypot(x, y)), std::atan2(y, x));
    }
    DirectionPair half(double theta_h, double phi_h, double theta_d, double phi_d) const {
        return from_half_angle({.theta_h = theta("theta_h", theta_h),
                                .phi_h = phi("phi_h", phi_h),
                                .theta_d = theta("theta_d", theta_d),
                                .phi_d = phi("phi_d", phi_d)});
    }
};

using Source = const MeasuredSource&;
using X = std::span<const double>;

/// Unit vectors, as long as their digits allow.
Vec3d unit(const Row& row, std::string_view name, double x, double y, double z) {
    const Vec3d v{x, y, z};
    if (!(std::abs(length(v) - 1.) < 1e-3))
        row.source.fail(row.line,
                        fmt::format("the {} vector has the length {:g}, not 1", name, length(v)));
    return normalize(v);
}

constexpr AltaCoordinates all[] = {
    {"COS_TH", 1, true, "cos(theta_h), theta_d = 0",
     [](Source s, std::size_t line, X x) {
         const Row r{s, line};
         return r.half(r.arc("theta_h", x[0]), 0., 0., 0.);
     }},
    {"COS_TH_TD", 2, true, "cos(theta_h), cos(theta_d), phi_d = 0",
     [](Source s, std::size_t line, X x) {
         const Row r{s, line};
         return r.half(r.arc("theta_h", x[0]), 0., r.arc("theta_d", x[1]), 0.);
     }},
    {"RUSIN_TH_TD", 2, true, "theta_h, theta_d, phi_d = pi/2",
     [](Source s, std::size_t line, X x) {
         return Row{s, line}.half(x[0], 0., x[1], 0.5 * pi);
     }},
    {"ISOTROPIC_TV_PROJ_DPHI", 2, true, "theta_v cos(dphi), theta_v sin(dphi), theta_l = 0",
     [](Source s, std::size_t line, X x) {
         return DirectionPair{{0., 0., 1.}, Row{s, line}.projected("theta_v", x[0], x[1])};
     }},
    {"RUSIN_TH_TD_PD", 3, true, "theta_h, theta_d, phi_d",
     [](Source s, std::size_t line, X x) {
         return Row{s, line}.half(x[0], 0., x[1], x[2]);
     }},
    {"ISOTROPIC_TV_TL_DPHI", 3, true, "theta_v, theta_l, phi_l - phi_v",
     [](Source s, std::size_t line, X x) {
         const Row r{s, line};
         return DirectionPair{polar_direction(r.theta("theta_l", x[1]), r.phi("dphi", x[2])),
                              polar_direction(r.theta("theta_v", x[0]), 0.)};
     }},
    {"ISOTROPIC_TL_TV_PROJ_DPHI", 3, true, "theta_l, theta_v cos(dphi), theta_v sin(dphi)",
     [](Source s, std::size_t line, X x) {
         const Row r{s, line};
         return DirectionPair{polar_direction(r.theta("theta_l", x[0]), 0.),
                              r.projected("theta_v", x[1], x[2])};
     }},
    {"RUSIN_TH_PH_TD_PD", 4, false, "theta_h, phi_h, theta_d, phi_d",
     [](Source s, std::size_t line, X x) {
         return Row{s, line}.half(x[0], x[1], x[2], x[3]);
     }},
    {"SPHERICAL_TL_PL_TV_PV", 4, false, "theta_l, phi_l, theta_v, phi_v",
     [](Source s, std::size_t line, X x) {
         const Row r{s, line};
         return DirectionPair{polar_direction(r.theta("theta_l", x[0]), r.phi("phi_l", x[1])),
                              polar_direction(r.theta("theta_v", x[2]), r.phi("phi_v", x[3]))};
     }},
    {"CARTESIAN", 6, false, "view x, y, z, light x, y, z",
     [](Source s, std::size_t line, X x) {
         const Row r{s, line};
         return DirectionPair{unit(r, "light", x[3], x[4], x[5]),
                              unit(r, "view", x[0], x[1], x[2])};
     }},
};

}  // namespace

const AltaCoordinates& find_alta_coordinates(const MeasuredSource& source, std::string_view name) {
    std::string known;
    for (const AltaCoordinates& c : all) {
        if (c.name == name) return c;
        known += (known.empty() ? "" : ", ") + std::string(c.name);
    }
    source.fail(fmt::format("#PARAM_IN '{}' cannot be read; known are {}", name, known));
}

}  // namespace nacre
