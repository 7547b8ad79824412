// Random surfaces with normally distributed heights: a sum of waves that fit the period.
#include <cmath>
#include <numbers>

#include "nacre/goniometer/height_waves.h"
#include "nacre/goniometer/microgeometry.h"
#include "nacre/math/error.h"
#include "nacre/math/normal_number.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

void check_resolution(const char* name, int points, double lengths) {
    if (points < 4. * lengths)
        throw InputError(fmt::format(
            "{}: {} points do not resolve {:.6g} correlation lengths: at least {:.0f}, or fewer "
            "lengths",
            name, points, lengths, std::ceil(4. * lengths)));
}

/// Amplitudes of the waves 0..most along one axis of a period of `lengths` correlation lengths: the
/// square root of the spectrum of the correlation exp(-d^2/l^2), exp(-(k l)^2/4).
std::vector<double> amplitudes(double lengths) {
    std::vector<double> r;
    for (int n = 0; n == 0 || r.back() > 1e-5; ++n) {
        const double k = 2. * pi * n / lengths;
        r.push_back(std::exp(-0.125 * k * k));
    }
    return r;
}

Microgeometry make_gaussian(const ParameterValues& v) {
    const int n = v.whole("points");
    const double lengths = v.number("lengths"), alpha = v.number("alpha");
    check_resolution("gaussian", n, lengths);
    Random random(stream_key(std::uint64_t(v.whole("seed")), 0x67617573));
    const std::vector<double> amplitude = amplitudes(lengths);
    const int most = int(amplitude.size()) - 1;
    std::vector<double> heights = sum_of_waves(
        n, most,
        [&](int a, int b) {
            return amplitude[std::size_t(a)] * amplitude[std::size_t(std::abs(b))];
        },
        random);
    const double step = lengths / n;
    scale_to_slope(heights, n, step, alpha);
    return height_field(n, n, step, heights);
}

Microgeometry make_brushed(const ParameterValues& v) {
    const int n = v.whole("points");
    const double lengths = v.number("lengths");
    check_resolution("brushed", n, lengths);
    Random random(stream_key(std::uint64_t(v.whole("seed")), 0x62727573));
    const std::vector<double> amplitude = amplitudes(lengths);
    std::vector<double> heights(std::size_t(n), 0.);
    for (std::size_t a = 1; a < amplitude.size(); ++a) {
        const double c = amplitude[a] * normal_number(random),
                     s = amplitude[a] * normal_number(random);
        for (int i = 0; i < n; ++i) {
            const double phase = 2. * pi * ((std::int64_t(a) * i) % n) / n;
            heights[std::size_t(i)] += c * std::cos(phase) + s * std::sin(phase);
        }
    }
    const double step = lengths / n;
    const double scale = v.number("alpha") / slope_of(heights, n, 1, step, true);
    std::vector<Vec2<double>> profile;
    for (int i = 0; i < n; ++i) profile.push_back({i * step, scale * heights[std::size_t(i)]});
    return extruded_profile(profile, lengths);
}

std::vector<Parameter> random_parameters(double points, double lengths) {
    return {{.name = "alpha",
             .meaning = "roughness as of Beckmann's distribution: sqrt(2) times the standard "
                        "deviation of slope along one direction",
             .high = 10.,
             .above_low = true,
             .otherwise = 0.3},
            {.name = "lengths",
             .meaning = "correlation lengths of a period: heights a distance d apart correlate as "
                        "exp(-d^2), d in lengths",
             .low = 2.,
             .high = 10'000.,
             .otherwise = lengths},
            {.name = "points",
             .meaning = "of the grid, along one side",
             .kind = ParameterKind::integer,
             .low = 16.,
             .high = 20'000.,
             .otherwise = points},
            {.name = "seed",
             .meaning = "of its random numbers",
             .kind = ParameterKind::integer,
             .high = 1e9}};
}

}  // namespace

const MicrogeometryDescription gaussian_geometry{
    .name = "gaussian",
    .title = "Gaussian height field",
    .meaning =
        "heights normally distributed, with a Gaussian correlation; lengths in correlation "
        "lengths. Its slopes have Beckmann's distribution",
    .parameters = random_parameters(512., 24.),
    .references = {"P. Beckmann, A. Spizzichino 1963, The Scattering of Electromagnetic Waves from "
                   "Rough Surfaces",
                   "B. G. Smith 1967, Geometrical Shadowing of a Random Rough Surface, IEEE Trans. "
                   "AP 15(5)"},
    .make = make_gaussian,
};

const MicrogeometryDescription brushed_geometry{
    .name = "brushed",
    .title = "Brushed grooves",
    .meaning =
        "random grooves along x whose profile is a Gaussian random function; lengths in "
        "correlation lengths",
    .parameters = random_parameters(4096., 200.),
    .make = make_brushed,
};

}  // namespace nacre
