// Normals of meshes that come without.
#include <cmath>
#include <numbers>
#include <numeric>

#include "nacre/geometry/mesh_build.h"
#include "nacre/geometry/mesh_topology.h"

namespace nacre {
namespace {

Vec3d scaled_normal(const Mesh& mesh, const Mesh::Triangle& t) {
    const Vec3d a(mesh.positions[t[0]]);
    return cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a);
}

bool is_smooth(const Mesh& mesh, double crease_angle) {
    // Normals all within half the angle of their mean are within the angle of each other.
    const double least = std::cos(0.5 * crease_angle * std::numbers::pi / 180);
    for (const Mesh::Triangle& t : mesh.triangles) {
        const Vec3d n = scaled_normal(mesh, t);
        const double len = length(n);
        if (!(len > 0)) continue;
        for (const std::uint32_t v : t)
            if (dot(n, Vec3d(mesh.normals[v])) < least * len) return false;
    }
    return true;
}

using Corner = SideIndex;  ///< corner k of triangle t is 3 t + k, as the side that begins there

Corner root_of(std::vector<Corner>& parents, Corner i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

/// For every corner one that stands for its group: corners at one vertex whose triangles hang
/// together by edges that are no creases.
std::vector<Corner> smooth_groups(const Mesh& mesh, double crease_angle) {
    const double least = std::cos(crease_angle * std::numbers::pi / 180);
    std::vector<Corner> parents(3 * mesh.triangles.size());
    std::iota(parents.begin(), parents.end(), Corner{0});
    const std::vector<SideIndex> neighbours = side_neighbours(mesh);
    const auto vertex = [&](Corner c) { return mesh.triangles[c / 3][c % 3]; };
    const auto next = [](Corner c) { return c - c % 3 + (c + 1) % 3; };
    for (SideIndex side = 0; side < neighbours.size(); ++side) {
        const SideIndex other = neighbours[side];
        if (other == kNoSide || other < side) continue;
        const Vec3d a = scaled_normal(mesh, mesh.triangles[side / 3]),
                    b = scaled_normal(mesh, mesh.triangles[other / 3]);
        if (dot(a, b) < least * length(a) * length(b)) continue;
        // The neighbour runs along the edge the other way, unless it is turned over.
        if (vertex(side) == vertex(next(other)))
            parents[root_of(parents, side)] = root_of(parents, next(other));
        if (vertex(next(side)) == vertex(other))
            parents[root_of(parents, next(side))] = root_of(parents, other);
    }
    for (Corner& c : parents) c = root_of(parents, c);
    return parents;
}

}  // namespace

void compute_normals(Mesh& mesh) {
    mesh.normals.assign(mesh.positions.size(), Vec3f{});
    for (const Mesh::Triangle& t : mesh.triangles) {
        const Vec3d p[3] = {Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]),
                            Vec3d(mesh.positions[t[2]])};
        const Vec3d n = cross(p[1] - p[0], p[2] - p[0]);
        const double len = length(n);
        if (!(len > 0)) continue;
        for (int i = 0; i < 3; ++i) {
            // The angle between two sides by its tangent, accurate for slivers: |cross| is the
            // same at every corner.
            const double angle = std::atan2(len, dot(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]));
            mesh.normals[t[i]] += Vec3f(n * (angle / len));
        }
    }
    for (Vec3f& n : mesh.normals) {
        const float len = length(n);
        n = len > 0.f ? n * (1.f / len) : Vec3f{0, 0, 1};
    }
}

void compute_normals(Mesh& mesh, double crease_angle) {
    compute_normals(mesh);
    if (crease_angle >= 180 || is_smooth(mesh, crease_angle)) return;
    const std::vector<Corner> groups = smooth_groups(mesh, crease_angle);
    // The first group of a vertex keeps it, every other one gets a copy.
    constexpr std::uint32_t none = ~0u;
    std::vector<std::uint32_t> vertex_of_group(groups.size(), none);
    std::vector<bool> taken(mesh.positions.size(), false);
    for (Corner c = 0; c < groups.size(); ++c) {
        std::uint32_t& vertex = mesh.triangles[c / 3][c % 3];
        std::uint32_t& chosen = vertex_of_group[groups[c]];
        if (chosen == none && taken[vertex]) {
            chosen = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(mesh.positions[vertex]);
            if (!mesh.uvs.empty()) mesh.uvs.push_back(mesh.uvs[vertex]);
        } else if (chosen == none) {
            chosen = vertex;
            taken[vertex] = true;
        }
        vertex = chosen;
    }
    mesh.positions.reserve(mesh.positions.size() + 1);  // Embree's room
    compute_normals(mesh);
}

}  // namespace nacre
