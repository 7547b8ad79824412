#pragma once
// A shape of a scene as triangles with a normal at each vertex, as its rays see it.
#include "nacre/geometry/ray_scene.h"

namespace nacre {

struct ShapeVertices {
    std::vector<Point3f> positions;
    std::vector<Vec3f> normals = {};  ///< unit, of interpolation or of the faces, pointing outside
    std::vector<Mesh::Triangle> triangles;  ///< counter-clockwise seen from outside
};
/// Corners that a mesh shares but whose normals differ (face normals) are parted. Analytic shapes
/// are tessellated, within a thousandth of their size.
ShapeVertices shape_vertices(const RayScene& rays, std::uint32_t shape);

}  // namespace nacre
