#pragma once
// What a RayScene holds. Only for the .cpp files that implement it.
#include <memory>
#include <mutex>
#include <vector>

#include "nacre/geometry/analytic.h"
#include "nacre/geometry/embree.h"
#include "nacre/geometry/ray_scene.h"

namespace nacre {

struct RayScene::Impl {
    struct Shape {
        std::shared_ptr<const Mesh> mesh;  // one of these two is set
        std::unique_ptr<AnalyticShape> analytic;
        std::optional<Primitive> primitive;  // what `analytic` was made from
        bool face_normals = false, flip_normals = false;
        std::vector<Point3f> padded;  // positions, if the mesh's own array lacks Embree's padding
        Box3f bounds;
        // Cumulative triangle areas, made when first asked for: only lights need them.
        mutable std::once_flag cumulative_made;
        mutable std::vector<double> cumulative;

        const std::vector<double>& cumulative_area() const;
        /// The surface at parameters (u, v) of a primitive.
        SurfacePoint surface(std::uint32_t primitive, float u, float v) const;
        SurfacePoint mesh_surface(std::uint32_t primitive, float u, float v) const;
        SurfacePoint analytic_surface(float u, float v) const;
    };

    Impl();
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    std::uint32_t attach(RTCGeometry geometry, std::unique_ptr<Shape> shape);
    void check() const;

    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<std::unique_ptr<Shape>> shapes;
    std::size_t triangles = 0;
    Box3f bounds;
};

}  // namespace nacre
