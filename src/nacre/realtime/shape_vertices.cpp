#include "nacre/realtime/shape_vertices.h"

#include <utility>

#include "nacre/geometry/tessellate.h"

namespace nacre {

ShapeVertices shape_vertices(const RayScene& rays, std::uint32_t shape) {
    if (const Primitive* primitive = rays.primitive(shape)) {
        Mesh mesh = tessellate(*primitive);
        return {std::move(mesh.positions), std::move(mesh.normals), std::move(mesh.triangles)};
    }
    const Mesh& mesh = *rays.mesh(shape);
    // What rays see at the corners says whether normals are turned or those of faces.
    const auto corner = [&](std::size_t t, int k) {
        return rays.surface_point({}, {.shape = shape,
                                       .primitive = std::uint32_t(t),
                                       .u = k == 1 ? 1.f : 0.f,
                                       .v = k == 2 ? 1.f : 0.f});
    };
    ShapeVertices result{.positions = mesh.positions, .triangles = mesh.triangles};
    result.normals.resize(mesh.positions.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Mesh::Triangle& corners = mesh.triangles[t];
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = corners[std::size_t(k)];
            const SurfacePoint at = corner(t, k);
            Vec3f& n = result.normals[v];
            if (n == Vec3f{}) {
                n = at.shading.n;
            } else if (dot(n, at.shading.n) < 0.9999f) {
                result.triangles[t][std::size_t(k)] = std::uint32_t(result.positions.size());
                result.positions.push_back(mesh.positions[v]);
                result.normals.push_back(at.shading.n);
            }
        }
        const Point3f &a = mesh.positions[corners[0]], &b = mesh.positions[corners[1]],
                      &c = mesh.positions[corners[2]];
        if (dot(cross(b - a, c - a), corner(t, 0).ng) < 0.f)
            std::swap(result.triangles[t][1], result.triangles[t][2]);
    }
    return result;
}

}  // namespace nacre
