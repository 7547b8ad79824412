#include "nacre/geometry/mesh_topology.h"

#include <algorithm>
#include <numeric>

#include "nacre/geometry/weld.h"

namespace nacre {
namespace {

// For every vertex the number of its place.
std::vector<std::uint32_t> places(const Mesh& mesh) {
    Welder welder;
    std::vector<std::uint32_t> place;
    place.reserve(mesh.positions.size());
    for (const Point3f& p : mesh.positions) place.push_back(welder.insert(p));
    return place;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

}  // namespace

std::vector<SideIndex> side_neighbours(const Mesh& mesh) {
    struct Side {
        std::uint64_t edge;
        SideIndex index;
    };
    const std::vector<std::uint32_t> place = places(mesh);
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Mesh::Triangle& t = mesh.triangles[i];
        const std::uint64_t p[3] = {place[t[0]], place[t[1]], place[t[2]]};
        if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t from = p[k], to = p[(k + 1) % 3];
            sides.push_back(
                {std::min(from, to) << 32 | std::max(from, to), static_cast<SideIndex>(3 * i + k)});
        }
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.edge < b.edge; });
    std::vector<SideIndex> neighbours(3 * mesh.triangles.size(), kNoSide);
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
        while (j < sides.size() && sides[j].edge == sides[i].edge) ++j;
        if (j - i != 2) continue;
        neighbours[sides[i].index] = sides[i + 1].index;
        neighbours[sides[i + 1].index] = sides[i].index;
    }
    return neighbours;
}

std::vector<std::uint32_t> triangle_components(const Mesh& mesh) {
    const std::vector<std::uint32_t> place = places(mesh);
    std::vector<std::uint32_t> parents(mesh.positions.size());
    std::iota(parents.begin(), parents.end(), 0u);
    for (const Mesh::Triangle& t : mesh.triangles)
        for (std::size_t k = 1; k < 3; ++k)
            parents[root_of(parents, place[t[k]])] = root_of(parents, place[t[0]]);
    std::vector<std::uint32_t> number(mesh.positions.size(), ~0u), components;
    components.reserve(mesh.triangles.size());
    std::uint32_t count = 0;
    for (const Mesh::Triangle& t : mesh.triangles) {
        std::uint32_t& n = number[root_of(parents, place[t[0]])];
        if (n == ~0u) n = count++;
        components.push_back(n);
    }
    return components;
}

}  // namespace nacre
