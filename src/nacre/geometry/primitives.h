#pragma once
// Analytic shapes of scene files, with Mitsuba's unit shapes and parametrisation.
#include <variant>

#include "nacre/geometry/transform.h"

namespace nacre {

/// Sphere: centre and radius in scene units (scene files: `center`, `radius`, any similarity
/// transform). Its pole is `z`, the azimuth grows from `x` to `y`: orthonormal axes, left-handed if
/// the transform mirrors.
struct Sphere {
    Point3f center;
    float radius = 1.f;
    bool flip_normals = false;
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};
/// Disk: the unit disk in the xy plane, normal +z, mapped by an affine transform.
struct Disk {
    Transform to_world;
    bool flip_normals = false;
};
/// Cylinder: lateral surface of radius 1 about z from z = 0 to z = 1, normals outwards, mapped by
/// an affine transform.
struct Cylinder {
    Transform to_world;
    bool flip_normals = false;
};

using Primitive = std::variant<Sphere, Disk, Cylinder>;

}  // namespace nacre
