#pragma once
// A triangle mesh of the zero set of a distance field.
#include <functional>

#include "nacre/geometry/mesh.h"

namespace nacre {

/// Negative inside, positive outside; called from several threads at once.
using DistanceField = std::function<float(const Point3f&)>;

struct SurfaceNetsOptions {
    Box3f box;               ///< holds the whole surface, with a margin of at least one cell
    float cell = 1.f;        ///< side of a lattice cell
    float lipschitz = 1.5f;  ///< |f(p) - f(q)| <= lipschitz |p - q|: lets empty space be skipped
};

/// Surface nets (S. F. F. Gibson, "Constrained Elastic Surface Nets", 1998): one vertex in every
/// cell that the surface crosses, one quadrilateral round every lattice edge that it crosses. The
/// vertices are then moved on to the zero set by Newton steps along the gradient, which is also
/// their normal.
///
/// The mesh is closed, manifold and counter-clockwise seen from outside, whatever the field: the
/// inside corners are made well-composed first (L. Latecki, "3D Well-Composed Pictures", 1997), so
/// that no two parts of the surface meet in a cell. Features thinner than a cell may merge or
/// vanish. The result does not depend on the number of threads.
/// @throws InputError if a size is not positive, the surface reaches a side of the box, or the
/// field is found to break its Lipschitz bound.
Mesh surface_nets(const DistanceField& field, const SurfaceNetsOptions& options);

/// Gradient of the field by differences over the four corners of a tetrahedron of size `step`.
Vec3f gradient(const DistanceField& field, const Point3f& p, float step);

}  // namespace nacre
