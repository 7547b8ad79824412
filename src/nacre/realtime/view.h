#pragma once
// From where a picture is taken, as matrices: the camera's and a light's.
#include <optional>

#include "nacre/geometry/mesh.h"
#include "nacre/realtime/gl/program.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// A projection of space onto pixels. Clip coordinates: x/w and y/w run over [-1, 1] from left to
/// right and from top to bottom (row 0 is the top); z/w is 1 at the near plane and falls to 0 far
/// away, so that floats resolve near and far alike.
struct View {
    Mat4 clip{};
    Vec3f eye = {};  ///< or, of parallel views, the direction in which they look
    bool parallel = false;
    int width = 0, height = 0;
    float pixel = 0;  ///< width of a pixel, at distance 1 or, in parallel views, everywhere
    /// The distance along the axis is depth_range / (z/w) or, in parallel views, from the near
    /// plane, (1 - z/w) depth_range.
    float depth_range = 0;

    Vec3f direction_to(const Point3f& p) const { return parallel ? eye : normalize(p - eye); }
};

/// Of a camera, whose picture is shifted by `shift` pixels (for samples that differ). A lens is
/// taken at its middle, so that all is sharp. `bounds`: what is to be seen. Throws InputError for
/// cameras that no matrix describes.
View camera_view(const Camera& camera, const FilmSettings& film, Vec2f shift, const Box3f& bounds);

/// Of a light at `position` that sees a ball wholly. Throws InputError if it lies so near that the
/// ball fills more than 170 degrees.
View light_view(const Point3f& position, const Point3f& center, float radius, int size);
/// Of parallel light from the direction `to_light`.
View parallel_view(const Vec3f& to_light, const Point3f& center, float radius, int size);

}  // namespace nacre
