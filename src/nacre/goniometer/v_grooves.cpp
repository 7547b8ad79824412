// V-shaped grooves side by side: the surface of Torrance and Sparrow.
#include <cmath>
#include <numbers>

#include "nacre/goniometer/microgeometry.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

/// Angles of equal shares of the projected area, whose normals have Torrance and Sparrow's
/// distribution exp(-a^2 / (2 m^2)): the density of a is that times sin(a) cos(a).
std::vector<double> spread_angles(double m, int count) {
    constexpr int steps = 200'000;
    const double end = std::min(0.5 * std::numbers::pi, 12. * m);
    const auto density = [&](double a) {
        return std::sin(a) * std::cos(a) * std::exp(-0.5 * a * a / (m * m));
    };
    double total = 0.;
    for (int i = 0; i < steps; ++i) total += density(end * (i + 0.5) / steps);
    std::vector<double> angles;
    double sum = 0.;
    for (int i = 0; i < steps && int(angles.size()) < count; ++i) {
        sum += density(end * (i + 0.5) / steps);
        while (int(angles.size()) < count && sum >= total * (angles.size() + 0.5) / count)
            angles.push_back(end * (i + 0.5) / steps);
    }
    return angles;
}

Microgeometry make_v_grooves(const ParameterValues& v) {
    const double m = v.number("m"), degree = std::numbers::pi / 180.;
    if (m > 0. && v.given("angle"))
        throw InputError("v_grooves: give either angle, for grooves that are alike, or m");
    const int grooves = m > 0. ? v.whole("grooves") : 1;
    const std::vector<double> angles =
        m > 0. ? spread_angles(m, grooves) : std::vector<double>{v.number("angle") * degree};
    // Grooves as wide as each other, with their edges at one height.
    std::vector<Vec2<double>> profile;
    for (int i = 0; i < grooves; ++i) {
        profile.push_back({double(i), 0.});
        profile.push_back({i + 0.5, -0.5 * std::tan(angles[std::size_t(i)])});
    }
    return extruded_profile(profile, double(grooves));
}

}  // namespace

const MicrogeometryDescription v_groove_geometry{
    .name = "v_grooves",
    .title = "V-shaped grooves",
    .meaning = "symmetric grooves along x, their edges at one height; widths of 1",
    .parameters = {{.name = "angle",
                    .meaning = "between the sides of all grooves and the surface",
                    .unit = "degrees",
                    .high = 89.,
                    .otherwise = 30.},
                   {.name = "m",
                    .meaning = "or, above 0: grooves of many angles, with Torrance and Sparrow's "
                               "distribution of this standard deviation",
                    .unit = "radians",
                    .high = 10.},
                   {.name = "grooves",
                    .meaning = "of a period, with m",
                    .kind = ParameterKind::integer,
                    .low = 1.,
                    .high = 100'000.,
                    .otherwise = 400.}},
    .references = {"K. E. Torrance, E. M. Sparrow 1967, JOSA 57(9)"},
    .make = make_v_grooves,
};

}  // namespace nacre
