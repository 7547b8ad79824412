#pragma once
// The built-in sculptures, modelled for light that passes through them: a bust with thin, upright
// ears and a pleated collar, and a pot for tea; and for cloth a drape.
#include <string_view>

#include "nacre/geometry/mesh.h"

namespace nacre {

/// Signed distance (mm) to the sculpture: close to it near the surface, of the right sign and rough
/// elsewhere. y is up, the face looks along +z, the base stands
/// on y = 0 and is centred on x = z = 0.
float figure_distance(const Point3f& p);

/// The box that holds the sculpture, with a margin.
Box3f figure_box();

/// The same of the pot: its spout along +x, its handle along -x, 140 mm tall.
float pot_distance(const Point3f& p);
Box3f pot_box();

/// A cloth over a ball, hanging in folds to the floor y = 0; 157 mm tall, an open sheet seen from
/// above and around, with smooth normals and the coordinates of the flat cloth. `resolution_mm` is
/// about the side of its quadrangles.
Mesh make_drape(float resolution_mm);

/// The sculpture "bust" or "pot" as a closed, manifold mesh with smooth normals, or "drape", in mm.
/// `resolution_mm` is the side of a lattice cell: 1.6 gives about 390,000 triangles for the bust.
/// @throws InputError for other names, and unless 0.2 <= resolution_mm <= 8.
Mesh make_figure(float resolution_mm = 1.6f, std::string_view name = "bust");

}  // namespace nacre
