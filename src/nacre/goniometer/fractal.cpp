// Random surfaces without a size of their own: spectral synthesis of fractional Brownian heights.
#include <cmath>

#include "nacre/goniometer/height_waves.h"
#include "nacre/goniometer/microgeometry.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

Microgeometry make_fractal(const ParameterValues& v) {
    const int n = v.whole("points"), longest = v.whole("longest"), shortest = v.whole("shortest");
    if (longest > shortest)
        throw InputError(
            fmt::format("fractal: the longest waves, {} of a period, must not be shorter than the "
                        "shortest, {}",
                        longest, shortest));
    if (n < 4 * shortest)
        throw InputError(
            fmt::format("fractal: {} points do not resolve waves of which {} are a period: at "
                        "least {}, or a smaller 'shortest'",
                        n, shortest, 4 * shortest));
    Random random(stream_key(std::uint64_t(v.whole("seed")), 0x66726163));
    // The height differences at a distance d grow as d^H: in the plane the power density of a wave
    // falls as k^-2(H+1).
    const double fall = v.number("hurst") + 1.;
    std::vector<double> heights = sum_of_waves(
        n, shortest,
        [&](int a, int b) {
            const double k = std::hypot(double(a), double(b));
            return k < longest || k > shortest ? 0. : std::pow(k, -fall);
        },
        random);
    const double step = double(shortest) / n;
    scale_to_slope(heights, n, step, v.number("alpha"));
    return height_field(n, n, step, heights);
}

}  // namespace

const MicrogeometryDescription fractal_geometry{
    .name = "fractal",
    .title = "Fractal height field",
    .meaning =
        "normally distributed heights whose spectrum is a power law between a longest and a "
        "shortest wave; lengths in the shortest wave",
    .parameters = {{.name = "alpha",
                    .meaning =
                        "root mean square slope, the roughness of Beckmann's distribution: sqrt(2) "
                        "times the standard deviation of slope along one direction",
                    .high = 10.,
                    .above_low = true,
                    .otherwise = 0.3},
                   {.name = "hurst",
                    .meaning =
                        "exponent H: heights a distance d apart differ as d^H; fractal dimension "
                        "3 - H",
                    .above_low = true,
                    .otherwise = 0.8},
                   {.name = "longest",
                    .meaning = "of the longest waves so many are a period",
                    .kind = ParameterKind::integer,
                    .low = 1.,
                    .high = 1000.,
                    .otherwise = 1.},
                   {.name = "shortest",
                    .meaning = "of the shortest waves so many are a period",
                    .kind = ParameterKind::integer,
                    .low = 1.,
                    .high = 1000.,
                    .otherwise = 64.},
                   {.name = "points",
                    .meaning = "of the grid, along one side",
                    .kind = ParameterKind::integer,
                    .low = 16.,
                    .high = 4096.,
                    .otherwise = 512.},
                   {.name = "seed",
                    .meaning = "of its random numbers",
                    .kind = ParameterKind::integer,
                    .high = 1e9}},
    .references =
        {"R. F. Voss 1985, Random Fractal Forgeries, Fundamental Algorithms for Computer Graphics",
         "D. Saupe 1988, Algorithms for Random Fractals, The Science of Fractal Images"},
    .make = make_fractal,
};

}  // namespace nacre
