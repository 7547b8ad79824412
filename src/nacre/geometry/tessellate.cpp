#include "nacre/geometry/tessellate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "nacre/geometry/analytic.h"
#include "nacre/geometry/mesh_build.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

// Largest distance of the triangles of an icosphere from the unit sphere.
double chord_error_of(const Mesh& icosphere) {
    double least = 1;
    for (const Mesh::Triangle& t : icosphere.triangles) {
        const Vec3d a(icosphere.positions[t[0]]);
        const Vec3d n =
            cross(Vec3d(icosphere.positions[t[1]]) - a, Vec3d(icosphere.positions[t[2]]) - a);
        least = std::min(least, dot(a, normalize(n)));
    }
    return 1 - least;
}

Mesh tessellate_sphere(const Sphere& sphere, double chord_error) {
    Mesh mesh = make_icosphere(0);
    for (int level = 1; chord_error_of(mesh) > chord_error; ++level) mesh = make_icosphere(level);
    for (Point3f& p : mesh.positions)
        p = Point3f(Vec3d(sphere.center) + Vec3d(p) * double(sphere.radius));
    if (sphere.flip_normals)
        for (Vec3f& n : mesh.normals) n = -n;
    return mesh;
}

// Steps around a circle whose chords stay within the error.
std::uint32_t steps_around(double chord_error) {
    return std::max(
        3u, static_cast<std::uint32_t>(std::ceil(std::numbers::pi / std::acos(1 - chord_error))));
}

void add_vertex(const AnalyticPoint& at, Mesh& mesh) {
    mesh.positions.emplace_back(at.p);
    mesh.normals.emplace_back(at.n);
}

// Turns the triangles that do not face the way of the normals.
void orient(Mesh& mesh) {
    for (Mesh::Triangle& t : mesh.triangles) {
        const Vec3d a(mesh.positions[t[0]]);
        const Vec3d n = cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a);
        const Vec3f outside = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
        if (dot(n, Vec3d(outside)) < 0) std::swap(t[1], t[2]);
    }
}

Mesh tessellate_disk(const AnalyticShape& disk, double chord_error) {
    const std::uint32_t steps = steps_around(chord_error);
    Mesh mesh;
    mesh.positions.reserve(steps + 2);  // with Embree's room
    for (std::uint32_t i = 0; i < steps; ++i) {
        const double azimuth = 2 * std::numbers::pi * i / steps;
        add_vertex(
            disk.at(static_cast<float>(std::cos(azimuth)), static_cast<float>(std::sin(azimuth))),
            mesh);
        mesh.triangles.push_back({steps, i, (i + 1) % steps});
    }
    add_vertex(disk.at(0.f, 0.f), mesh);
    return mesh;
}

Mesh tessellate_cylinder(const AnalyticShape& cylinder, double chord_error) {
    const std::uint32_t steps = steps_around(chord_error);
    Mesh mesh;
    mesh.positions.reserve(2 * steps + 1);
    for (std::uint32_t i = 0; i < steps; ++i) {
        for (const float z : {0.f, 1.f})
            add_vertex(cylinder.at(static_cast<float>(i) / static_cast<float>(steps), z), mesh);
        const std::uint32_t low = 2 * i, next = 2 * ((i + 1) % steps);
        mesh.triangles.push_back({low, next, next + 1});
        mesh.triangles.push_back({low, next + 1, low + 1});
    }
    return mesh;
}

}  // namespace

Mesh tessellate(const Primitive& primitive, double chord_error) {
    if (!(chord_error >= 1e-5 && chord_error <= 0.5))
        throw InputError(
            fmt::format("chord error {} of a tessellation; give a fraction of the "
                        "radius from 0.00001 to 0.5",
                        chord_error));
    const AnalyticShape shape(primitive);
    Mesh mesh;
    if (const auto* sphere = std::get_if<Sphere>(&primitive)) {
        mesh = tessellate_sphere(*sphere, chord_error);
        mesh.name = "sphere";
    } else if (std::holds_alternative<Disk>(primitive)) {
        mesh = tessellate_disk(shape, chord_error);
        mesh.name = "disk";
    } else {
        mesh = tessellate_cylinder(shape, chord_error);
        mesh.name = "cylinder";
    }
    orient(mesh);
    return mesh;
}

}  // namespace nacre
