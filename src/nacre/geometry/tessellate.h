#pragma once
// Meshes of analytic shapes, for techniques that need triangles.
#include "nacre/geometry/mesh.h"
#include "nacre/geometry/primitives.h"

namespace nacre {

/// A mesh whose vertices lie on the shape and whose triangles are nowhere farther from it than
/// `chord_error` times the shape's radius (the longest semi-axis of ellipses). Triangles are
/// counter-clockwise seen from the side of the shape's normal, flip_normals and mirroring
/// transforms included; the vertices have the shape's normals, and no texture coordinates.
/// Inscribed triangles have less area than the shape: of a disk's 4/3 chord_error is missing, of a
/// cylinder's 1/3 chord_error, of a sphere's at most 5/4 chord_error and often a third of that,
/// because icospheres refine in steps of four.
/// Spheres become icospheres, disks fans about their centre, cylinders strips of rectangles, two
/// triangles each, as long as the cylinder.
/// @throws InputError unless 1e-5 <= chord_error <= 0.5, or if the shape is none (AnalyticShape).
Mesh tessellate(const Primitive& primitive, double chord_error = 1e-3);

}  // namespace nacre
