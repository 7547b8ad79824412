#include "nacre/compare/suite_objects.h"

#include <algorithm>
#include <cmath>

#include "nacre/geometry/figure.h"
#include "nacre/geometry/sdf.h"
#include "nacre/geometry/surface_nets.h"

namespace nacre {
namespace {

using namespace sdf;

/// 50 x 50 mm, 2 mm thick, waved like cloth in the wind.
float sheet(const Point3f& p) {
    const float wave = 4.f * std::sin(0.2f * p.x + 0.08f * p.y) * smoothstep(30.f, -10.f, p.y);
    // The slope of the wave is at most 0.86; the distance shrinks by 1 / sqrt(1 + 0.86^2).
    return 0.75f * rounded_box({p.x, p.y, p.z - wave}, {21.f, 21.f, 1.f}, 0.9f);
}

/// A hemisphere of 26 mm, 5 mm thick, tilted so that one sees into it.
float bowl(const Point3f& at) {
    const Point3f p = turn_x(at, Turn::degrees(25.f)) - Vec3f(0, 8, 0);
    const float shell = std::abs(length(p) - 23.5f) - 2.5f;
    return smooth_intersection(shell, p.y, 3.f);
}

/// 46 x 46 x 9 mm, turned so that the top, two sides and an edge are seen.
float slab(const Point3f& at) {
    const Point3f p = turn_y(at, Turn::degrees(30.f));
    return rounded_box(p, {20.f, 4.5f, 20.f}, 0.6f);
}

Mesh mesh_of(const DistanceField& field, float cell) {
    const float side = 32.f;
    return surface_nets(field, {{{-side, -side, -side}, {side, side, side}}, cell, 1.5f});
}

/// The built-in bust, 54 mm tall.
Mesh bust() {
    Mesh mesh = make_figure(3.f, "bust");
    const Box3f box = mesh.bounds();
    const Vec3f size = box.diagonal();
    const float scale = 54.f / std::max({size.x, size.y, size.z});
    for (Point3f& p : mesh.positions) p = (p - box.center()) * scale;
    return mesh;
}

}  // namespace

std::shared_ptr<Mesh> make_suite_object(std::string_view name) {
    if (name == "bust") return std::make_shared<Mesh>(bust());
    if (name == "sheet") return std::make_shared<Mesh>(mesh_of(sheet, 0.5f));
    if (name == "bowl") return std::make_shared<Mesh>(mesh_of(bowl, 0.8f));
    if (name == "slab") return std::make_shared<Mesh>(mesh_of(slab, 0.5f));
    return std::make_shared<Mesh>(mesh_of([](const Point3f& p) { return sphere(p, 25.f); }, 0.8f));
}

}  // namespace nacre
