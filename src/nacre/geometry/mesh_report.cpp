#include "nacre/geometry/mesh_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "nacre/geometry/weld.h"

namespace nacre {
namespace {

// An edge as one number: smaller vertex, larger vertex, and in the lowest bit whether its triangle
// runs from the smaller to the larger. 31 bits a vertex: more would be a mesh of 100 GiB.
std::uint64_t edge(std::uint64_t from, std::uint64_t to) {
    return std::min(from, to) << 32 | std::max(from, to) << 1 | (from < to);
}
std::uint64_t ends(std::uint64_t edge) { return edge >> 1; }

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

std::string count(std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace

MeshReport inspect(const Mesh& mesh) {
    MeshReport report;
    report.triangles = mesh.triangles.size();
    report.degenerate_triangles = mesh.dropped_triangles;
    report.bounds = mesh.bounds();
    Welder welder;
    std::vector<std::uint32_t> place(mesh.positions.size(), ~0u);
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    const Vec3d center(report.bounds.center());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Mesh::Triangle& t = mesh.triangles[i];
        for (const std::uint32_t v : t)
            if (place[v] == ~0u) place[v] = welder.insert(mesh.positions[v]);
        // Relative to the centre: far from the origin the volume would drown in cancellation.
        const Vec3d a = Vec3d(mesh.positions[t[0]]) - center;
        const Vec3d b = Vec3d(mesh.positions[t[1]]) - center;
        const Vec3d c = Vec3d(mesh.positions[t[2]]) - center;
        const double area = 0.5 * length(cross(b - a, c - a));
        report.area += area;
        report.volume += dot(a, cross(b, c)) / 6;
        if (!(area > 0)) ++report.degenerate_triangles;
        for (int k = 0; k < 3; ++k) {
            const std::uint64_t from = place[t[k]], to = place[t[(k + 1) % 3]];
            if (from != to) edges.push_back(edge(from, to));
        }
    }
    report.vertices = welder.points.size();
    std::sort(edges.begin(), edges.end());
    std::vector<std::uint32_t> parents(report.vertices);
    std::iota(parents.begin(), parents.end(), 0u);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i, forward = 0;
        for (; j < edges.size() && ends(edges[j]) == ends(edges[i]); ++j) forward += edges[j] & 1;
        const auto from = static_cast<std::uint32_t>(edges[i] >> 32);
        const auto to = static_cast<std::uint32_t>(edges[i]) >> 1;
        parents[root_of(parents, from)] = root_of(parents, to);
        if (j - i == 1) ++report.boundary_edges;
        if (j - i > 2) ++report.non_manifold_edges;
        if (j - i == 2 && forward != 1) ++report.inconsistent_edges;
        i = j;
    }
    for (std::uint32_t i = 0; i < parents.size(); ++i) report.components += parents[i] == i;
    return report;
}

std::string warning(const MeshReport& r, bool has_medium) {
    std::vector<std::string> found;
    if (r.boundary_edges && has_medium)  // without a medium an open surface is nothing unusual
        found.push_back(fmt::format("the surface is open ({})",
                                    count(r.boundary_edges, "boundary edge", "boundary edges")));
    if (r.non_manifold_edges)
        found.push_back(count(r.non_manifold_edges, "edge joins", "edges join") +
                        " more than two triangles");
    if (r.inconsistent_edges)
        found.push_back("neighbouring triangles face opposite ways at " +
                        count(r.inconsistent_edges, "edge", "edges"));
    if (r.inside_out()) found.push_back("the surface is inside out (its volume is negative)");
    if (has_medium && r.closed() && r.oriented() && r.volume == 0)
        found.push_back("the surface encloses no volume");
    if (found.empty())
        return r.degenerate_triangles
                   ? count(r.degenerate_triangles, "triangle has", "triangles have") +
                         " no area; no ray meets them, so they do no harm"
                   : std::string();
    std::string text = found.front();
    for (std::size_t i = 1; i < found.size(); ++i)
        text += (i + 1 == found.size() ? " and " : ", ") + found[i];
    if (r.inside_out())
        return text + (has_medium ? "; the medium would fill the outside: turn the triangles round "
                                    "or set flip_normals"
                                  : "; turn the triangles round or set flip_normals");
    return text + (has_medium
                       ? "; light in the medium inside gets lost there: close and orient the "
                         "surface before rendering"
                       : "; shading may show it, and a medium inside would lose light");
}

}  // namespace nacre
