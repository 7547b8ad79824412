// Parallel cylinders and grooves: the surfaces of poulin_fournier (reflectance/poulin_fournier.h),
// as triangles and made without its formulas.
#include <cmath>

#include "nacre/goniometer/microgeometry.h"

namespace nacre {
namespace {

Microgeometry make_cylinders(const ParameterValues& v) {
    const bool raised = v.word("profile") == "raised";
    const double spacing = v.number("spacing"), depth = v.number("depth");
    const int pieces = v.whole("pieces");
    const double half_width = std::min(std::sqrt(depth * (2. - depth)), 0.5 * spacing);
    const double end = std::asin(std::min(1., half_width));
    std::vector<Vec2<double>> profile;
    const double first = raised ? std::cos(end) : -std::cos(end);
    if (half_width <= 0.) return extruded_profile({{0., first}, {0.5 * spacing, first}}, spacing);
    for (int i = 0; i < pieces; ++i) {
        const double t = end * (2. * i / pieces - 1.);
        profile.push_back({half_width + std::sin(t), raised ? std::cos(t) : -std::cos(t)});
    }
    profile.front().x = 0.;
    if (spacing > 2. * half_width * (1. + 1e-6)) profile.push_back({2. * half_width, first});
    return extruded_profile(profile, spacing);
}

}  // namespace

const MicrogeometryDescription cylinder_geometry{
    .name = "cylinders",
    .title = "Parallel cylinders",
    .meaning = "cylinders along x on a floor, or cut into it; lengths in radii",
    .parameters = {choice_parameter("profile", "what stands in the surface",
                                    {{"raised", "cylinders above a floor", {"positive"}},
                                     {"grooved", "cylinders cut into it", {"negative"}}}),
                   {.name = "spacing",
                    .meaning = "distance between the axes of neighbours",
                    .unit = "radii",
                    .low = 0.1,
                    .high = 1000.,
                    .otherwise = 2.},
                   {.name = "depth",
                    .meaning = "from the tops of the cylinders to the floor, or from the surface "
                               "to the bottom of the grooves",
                    .unit = "radii",
                    .otherwise = 0.5},
                   {.name = "pieces",
                    .meaning = "flat pieces of an arc",
                    .kind = ParameterKind::integer,
                    .low = 4.,
                    .high = 100'000.,
                    .otherwise = 256.}},
    .references = {"P. Poulin, A. Fournier 1990, A Model for Anisotropic Reflection, SIGGRAPH 90"},
    .make = make_cylinders,
};

}  // namespace nacre
