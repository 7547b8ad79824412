// Threads in plain weave.
#include <cmath>
#include <numbers>

#include "nacre/goniometer/microgeometry.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

struct Thread {
    double half_width, half_height;
    int around, along;
};

/// The tube about the curve (s, place, height sin(pi s)), s from -0.25 to 2.25, with an elliptic
/// section in planes across s; for `across` x and y are exchanged.
void add_thread(Mesh& mesh, const Thread& t, double place, double height, bool across) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (int i = 0; i <= t.along; ++i) {
        const double s = -0.25 + 2.5 * i / t.along, z = height * std::sin(pi * s);
        for (int k = 0; k < t.around; ++k) {
            const double phi = 2. * pi * k / t.around;
            const double beside = place + t.half_width * std::cos(phi);
            const float up = float(z + t.half_height * std::sin(phi));
            if (across)
                mesh.positions.push_back({float(beside), float(s), up});
            else
                mesh.positions.push_back({float(s), float(beside), up});
        }
    }
    const auto n = std::uint32_t(t.around);
    for (std::uint32_t i = 0; i < std::uint32_t(t.along); ++i)
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = first + i * n + k, b = first + i * n + (k + 1) % n;
            if (across) {
                mesh.triangles.push_back({a, b + n, b});
                mesh.triangles.push_back({a, a + n, b + n});
            } else {
                mesh.triangles.push_back({a, b, b + n});
                mesh.triangles.push_back({a, b + n, a + n});
            }
        }
}

Microgeometry make_weave(const ParameterValues& v) {
    const double half_height = 0.5 * v.number("thickness");
    const Thread warp{0.5 * v.number("warp"), half_height, v.whole("pieces"),
                      2 * v.whole("pieces")};
    const Thread weft{0.5 * v.number("weft"), half_height, v.whole("pieces"),
                      2 * v.whole("pieces")};
    Microgeometry g{.mesh = {}, .width = 2., .height = 2.};
    g.mesh.name = "weave";
    // Where a warp thread is up the weft is down, and the next crossing is the other way round.
    for (int k = -1; k <= 2; ++k) {
        const double turn = k % 2 == 0 ? half_height : -half_height;
        add_thread(g.mesh, warp, k + 0.5, turn, false);
        add_thread(g.mesh, weft, k + 0.5, -turn, true);
    }
    g.mesh.positions.reserve(g.mesh.positions.size() + 1);
    return g;
}

Parameter width_parameter(std::string_view name, std::string_view meaning) {
    return {.name = name,
            .meaning = meaning,
            .unit = "distances of threads",
            .high = 1.,
            .above_low = true,
            .otherwise = 0.9};
}

}  // namespace

const MicrogeometryDescription weave_geometry{
    .name = "weave",
    .title = "Plain weave",
    .meaning =
        "threads of elliptic section over and under each other, without a floor: between "
        "them light passes; lengths in the distance of threads",
    .parameters = {width_parameter("warp", "width of the threads along x"),
                   width_parameter("weft", "width of the threads along y"),
                   {.name = "thickness",
                    .meaning = "height of a thread",
                    .unit = "distances of threads",
                    .high = 1.,
                    .above_low = true,
                    .otherwise = 0.35},
                   {.name = "pieces",
                    .meaning = "flat pieces around a thread",
                    .kind = ParameterKind::integer,
                    .low = 6.,
                    .high = 1000.,
                    .otherwise = 48.}},
    .make = make_weave,
};

}  // namespace nacre
