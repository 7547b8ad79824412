#include "nacre/geometry/figure.h"

#include <fmt/format.h>

#include "nacre/geometry/figure_parts.h"
#include "nacre/geometry/sdf.h"
#include "nacre/geometry/surface_nets.h"
#include "nacre/math/error.h"
#include "nacre/text/names.h"

namespace nacre {
namespace figure {
using namespace sdf;

namespace {
// The head turns on the top of the neck: to its left, a little down, a little to the side.
const Point3f kPivot{0, 232, -20};  // figure's frame
const Point3f kPivotInHead{0, -62, -20};
const Turn kTurn = Turn::degrees(14), kBow = Turn::degrees(3), kIncline = Turn::degrees(-4);
Turn inverse(Turn t) { return {t.c, -t.s}; }
}  // namespace

Point3f to_head(const Point3f& p) {
    const Point3f q = turn_x(turn_y(p - kPivot, inverse(kTurn)), inverse(kBow));
    return turn_z(q, inverse(kIncline)) + kPivotInHead;
}
Point3f from_head(const Point3f& h) {
    return turn_y(turn_x(turn_z(h - kPivotInHead, kIncline), kBow), kTurn) + kPivot;
}

}  // namespace figure

float figure_distance(const Point3f& p) {
    const Point3f h = figure::to_head(p);
    // Flesh flows together; hair, collar and foot are set against it with a narrow seam.
    float d = figure::torso(p);
    if (h.y > -150.f) {  // the chin is at -115
        d = sdf::smooth_union(d, figure::face(h), 16);
        d = sdf::smooth_union(d, figure::ears(h), 5);
        d = sdf::smooth_union(d, figure::hair(h), 2);
    }
    d = sdf::smooth_union(d, figure::collar(p), 4);
    return sdf::smooth_union(d, figure::base(p), 5);
}

Box3f figure_box() { return {{-150, -6, -190}, {150, 450, 130}}; }

Mesh make_figure(float resolution_mm, std::string_view name) {
    if (!(resolution_mm >= 0.2f && resolution_mm <= 8.f))
        throw InputError(fmt::format(
            "figure: a resolution of {:.4g} mm is not possible; give 0.2 to 8 mm", resolution_mm));
    if (name == "drape") return make_drape(resolution_mm);
    if (name != "bust" && name != "pot")
        throw InputError(unknown_name("figure", name, {"bust", "pot", "drape"}));
    const bool bust = name == "bust";
    // The steepest places, locks and pleats, stay below a slope of 1.5.
    Mesh mesh = surface_nets(bust ? figure_distance : pot_distance,
                             {bust ? figure_box() : pot_box(), resolution_mm, 1.5f});
    mesh.name = "figure";
    return mesh;
}

}  // namespace nacre
