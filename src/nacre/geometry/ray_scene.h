#pragma once
// Rays against shapes: first hit, occlusion and closest point, through Embree. Lengths in scene
// units.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "nacre/geometry/mesh.h"
#include "nacre/geometry/primitives.h"
#include "nacre/geometry/surface_chart.h"
#include "nacre/math/frame.h"

namespace nacre {

/// The points o + t d with t in (tmin, tmax). `d` is a unit vector, so t is a length.
struct Ray {
    Point3f o;
    Vec3f d;
    float tmin = 0.f;
    float tmax = 1e30f;
};

/// Where a ray met a shape: enough to compute everything else about the point
/// (RayScene::surface_point).
struct Hit {
    float t = 0.f;
    std::uint32_t shape = 0;      ///< index in the order of RayScene::add
    std::uint32_t primitive = 0;  ///< triangle of a mesh; 0 for analytic shapes
    float u = 0.f, v = 0.f;  ///< barycentric coordinates of vertices 1 and 2, or the primitive's
                             ///< own parameters
};

/// Local geometry of a surface at one point.
struct SurfacePoint {
    Point3f p;       ///< recomputed from the surface's parameters, so accurate to a few ulp of the
                     ///< coordinates
    Vec3f ng;        ///< geometric unit normal, pointing outside (counter-clockwise side)
    Framef shading;  ///< shading frame; n is the interpolated normal, on the same side as `ng`
    Vec2f uv;        ///< texture coordinates
    float error = 0.f;        ///< bound of the distance between `p` and the surface as rays meet it
    std::uint32_t shape = 0;  ///< as in Hit
    std::uint32_t primitive = 0;

    /// Start of a ray that leaves the surface towards `d` and cannot meet it again through
    /// rounding.
    Point3f spawn(const Vec3f& d) const;
};

/// A uniform point on a shape by area; `pdf` is 1/area in 1/(scene unit)^2.
struct AreaSample {
    Point3f p;
    Vec3f n;
    Vec2f uv;
    float pdf = 0.f;
};

/// All shapes of a scene in one acceleration structure. Add shapes, then `build`; queries are const
/// and thread-safe. Rays do not slip through the edges of closed meshes. At a vertex, where the
/// signs of all its edges are rounded on their own, one may: it must aim at the vertex to within
/// about 1e-7 rad, so some 1e-15 of all directions a vertex; a walk inside must bear such a miss.
/// Embree recommends flush-to-zero mode for speed; the library leaves that to the program.
class RayScene {
  public:
    RayScene();
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// Adds a shape and returns its index. A mesh is shared, not copied: Embree reads its arrays in
    /// place. With `face_normals` the mesh's normals are ignored.
    std::uint32_t add(std::shared_ptr<const Mesh> mesh, bool face_normals = false,
                      bool flip_normals = false);
    std::uint32_t add(const Primitive& primitive);
    void build();

    /// First hit with tmin < t <= tmax. A bound on t, such as a scattering event's free path,
    /// bounds the traversal and makes it several times cheaper.
    std::optional<Hit> intersect(const Ray& ray) const;
    /// Whether anything lies on the ray; cheaper than finding the first.
    bool occluded(const Ray& ray) const;
    /// Distance from `p` to the nearest surface, or `limit` if none is nearer. `shape` restricts it
    /// to one shape. About a microsecond near a surface; up to a thousand times more deep inside
    /// a fine mesh, where a large part of it is almost equally near. `tolerance` mends that: the
    /// result may then be too large, but (1 - tolerance) times it is not.
    float distance(const Point3f& p, float limit, std::optional<std::uint32_t> shape = {},
                   float tolerance = 0.f) const;
    /// Nearest surface point within `limit`, or one that is nearly so (`tolerance`).
    std::optional<Hit> closest(const Point3f& p, float limit,
                               std::optional<std::uint32_t> shape = {},
                               float tolerance = 0.f) const;

    /// Geometry at a hit of `intersect` or `closest`. It follows from the hit alone; the ray is not
    /// looked at.
    SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;

    /// Pieces that cover a shape; those of a disk overhang its rim.
    std::vector<ChartTriangle> chart_triangles(std::uint32_t shape) const;
    SurfaceChart chart(const ChartTriangle& triangle, double a, double b) const;
    /// That place as a hit, but for t; empty beyond the rim of a disk.
    std::optional<Hit> chart_hit(const ChartTriangle& triangle, double a, double b) const;

    std::size_t shape_count() const;
    Box3f bounds() const;
    Box3f bounds(std::uint32_t shape) const;
    /// Area of a shape, and a uniform point on it from `u` in [0,1)^2 (for lights).
    double area(std::uint32_t shape) const;
    AreaSample sample_area(std::uint32_t shape, Vec2f u) const;
    /// The mesh of a shape; null for analytic ones.
    const Mesh* mesh(std::uint32_t shape) const;
    /// The analytic primitive of a shape; null for meshes (sphere lights are sampled by solid
    /// angle).
    const Primitive* primitive(std::uint32_t shape) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace nacre
