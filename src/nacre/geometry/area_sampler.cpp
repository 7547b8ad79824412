#include "nacre/geometry/area_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"

namespace nacre {

AreaSampler::AreaSampler(const Mesh& mesh) {
    const std::string who = mesh.name.empty() ? "mesh" : fmt::format("mesh '{}'", mesh.name);
    if (mesh.triangles.empty())
        throw InputError(who + " has no triangles; points can only be spread over a surface");
    sums_.reserve(mesh.triangles.size());
    double sum = 0;
    for (const Mesh::Triangle& t : mesh.triangles) {
        const Vec3d a(mesh.positions[t[0]]);
        sum +=
            0.5 * length(cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a));
        sums_.push_back(sum);
    }
    if (!std::isfinite(sum))
        throw InputError(who + " has coordinates that are not finite; export it again");
    if (!(sum > 0))
        throw InputError(who +
                         " has no area: all its triangles are flat; points can only be "
                         "spread over a surface");
}

std::uint32_t AreaSampler::first_triangle(double s) const {
    const auto found = std::upper_bound(sums_.begin(), sums_.end(), s * area());
    return static_cast<std::uint32_t>(found - sums_.begin());
}

SurfacePlace AreaSampler::at(double s, double t, std::uint32_t hint) const {
    // Just below the end, so that rounding does not lead beyond it or into flat triangles there.
    const double target = std::min(s * area(), std::nextafter(area(), 0.0));
    std::uint32_t i = hint;
    while (!(sums_[i] > target)) ++i;
    const double below = i == 0 ? 0.0 : sums_[i - 1];
    const double rest = std::clamp((target - below) / (sums_[i] - below), 0.0, 1.0);
    const double root = std::sqrt(rest);
    return {i, root * (1 - t), root * t};
}

Vec3d geometric_normal(const Mesh& mesh, std::uint32_t triangle) {
    const Mesh::Triangle& t = mesh.triangles[triangle];
    const Vec3d a(mesh.positions[t[0]]);
    return normalize(cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a));
}

void set_place(const Mesh& mesh, const SurfacePlace& place, std::size_t i,
               SurfacePointSet& points) {
    // Rounded first, so that the point is the one that the stored coordinates name.
    const float u = std::clamp(static_cast<float>(place.u), 0.f, 1.f);
    const float v = std::clamp(static_cast<float>(place.v), 0.f, 1.f - u);
    const Mesh::Triangle& t = mesh.triangles[place.triangle];
    const Vec3d a(mesh.positions[t[0]]);
    points.p[i] = Point3f(a + (Vec3d(mesh.positions[t[1]]) - a) * double(u) +
                          (Vec3d(mesh.positions[t[2]]) - a) * double(v));
    points.n[i] = Vec3f(geometric_normal(mesh, place.triangle));
    points.triangle[i] = place.triangle;
    points.barycentric[i] = {u, v};
}

void resize(SurfacePointSet& points, std::size_t count) {
    points.p.resize(count);
    points.n.resize(count);
    points.triangle.resize(count);
    points.barycentric.resize(count);
    points.area.resize(count);
}

void check_point_count(std::size_t count) {
    if (count < 1 || count > kMaxSurfacePoints)
        throw InputError(fmt::format("{} surface points are asked for; give a number from 1 to {}",
                                     count, kMaxSurfacePoints));
}

}  // namespace nacre
