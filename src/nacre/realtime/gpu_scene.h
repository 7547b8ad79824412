#pragma once
// A scene on the device: the triangles of all its shapes, what they are made of, and what a mirror
// in the middle of it would show.
#include <vector>

#include "nacre/math/work.h"
#include "nacre/realtime/gl/gpu.h"
#include "nacre/technique/technique.h"

namespace nacre {

/// How the shapes of a scene are shaded.
enum class GpuShapeKind : int { opaque = 0, translucent = 1, lamp = 2 };

/// A range of triangles of one shape, in the order of GpuScene's buffers.
struct GpuShape {
    GpuShapeKind kind = GpuShapeKind::opaque;
    std::uint32_t shape = 0;  ///< of the scene
    std::uint32_t first_triangle = 0, triangles = 0;
    std::uint32_t first_vertex = 0, vertices = 0;
    Box3f bounds = {};
    float radius = 0;  ///< of the ball about the middle of these that holds the shape

    /// Of its vertices, by their numbers.
    template <class F>
    void set_bounds(F&& vertex) {
        bounds = {};
        radius = 0;
        for (std::uint32_t i = 0; i < vertices; ++i) bounds.extend(vertex(i));
        for (std::uint32_t i = 0; i < vertices; ++i)
            radius = std::max(radius, length(vertex(i) - bounds.center()));
    }
};

/// A bend of all translucent shapes, made on the device from the positions at rest.
struct Deformation {
    enum class Kind : int { none, twist, bend, breathe } kind = Kind::none;
    float amount = 0;  ///< radians from end to end; breathe: share of the object's size
    float phase = 0;   ///< radians
    bool operator==(const Deformation&) const = default;
};

class GpuScene {
  public:
    /// `translucent`: which shapes a technique renders; all others are opaque Lambert surfaces of
    /// their albedo (smooth or rough, their highlights are left out), or lamps. Analytic shapes are
    /// tessellated. Throws InputError for more triangles than the device can number, Stopped if
    /// `work` says so.
    GpuScene(Gpu& gpu, const Scene& scene, const std::vector<ShapeTechnique>& translucent,
             const Work& work = {});

    /// Makes again what depends on these parts of the scene.
    void changed(const Changes& what, const Work& work = {});
    /// Bends the translucent shapes; none: as they are.
    void deform(Gpu& gpu, const Deformation& deformation);

    const Scene& scene() const { return scene_; }
    /// Translucent ones first, lamps last.
    const std::vector<GpuShape>& shapes() const { return shapes_; }
    std::uint32_t triangles() const { return triangle_count_; }
    std::uint32_t vertices() const { return vertex_count_; }
    /// How many of the first triangles can stand in the light's way: all but those of lamps.
    std::uint32_t occluders() const { return occluders_; }
    const Box3f& bounds() const { return bounds_; }  ///< but for lamps

    const Buffer& positions() const { return positions_; }  ///< vec4 a vertex; w unused
    const Buffer& normals() const { return normals_; }      ///< vec4 a vertex, unit
    const Buffer& indices() const { return indices_; }      ///< uvec4 a triangle: corners, GpuShape
    const Buffer& materials() const { return materials_; }  ///< two vec4 a shape, see surface.glsl
    /// Radiance from all around its middle, the translucent shapes left out: columns are the angle
    /// about y, rows the angle from +y. What mirrors show, as if all of it were far away.
    const Texture& surroundings() const { return surroundings_; }
    /// What the camera sees where nothing is.
    const Texture& background() const { return background_; }
    std::size_t bytes() const;

  private:
    void make_geometry(const Work& work);
    void make_materials();
    void make_surroundings(const Work& work);

    const Scene& scene_;
    std::vector<bool> is_translucent_;
    std::vector<GpuShape> shapes_;
    std::uint32_t triangle_count_ = 0, vertex_count_ = 0, occluders_ = 0;
    Box3f bounds_;
    Buffer positions_, normals_, indices_, materials_;
    Buffer rest_positions_, rest_normals_;  // while deformed
    Deformation deformation_;
    Box3f rest_box_;  // of the translucent shapes at rest
    Texture surroundings_, background_;
};

}  // namespace nacre
