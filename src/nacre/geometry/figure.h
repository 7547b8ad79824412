#pragma once
// The built-in sculpture: a bust with thin, upright ears and a pleated collar, modelled for light
// that passes through it.
#include "nacre/geometry/mesh.h"

namespace nacre {

/// Signed distance (bound, mm) to the sculpture. y is up, the face looks along +z, the base stands
/// on y = 0 and is centred on x = z = 0.
float figure_distance(const Point3f& p);

/// The box that holds the sculpture, with a margin.
Box3f figure_box();

/// The sculpture as a closed, manifold mesh with smooth normals, in mm. `resolution_mm` is the side
/// of a lattice cell: 1.2 gives about 400,000 triangles; details go down to 2 mm.
/// @throws InputError unless 0.2 <= resolution_mm <= 8.
Mesh make_figure(float resolution_mm = 1.2f);

}  // namespace nacre
