#pragma once
// Meshes that are computed rather than read. All are counter-clockwise seen from outside and have
// room for Embree's padding.
#include "nacre/geometry/mesh.h"

namespace nacre {

/// Mitsuba's cube: [-1,1]^3, normals outwards, each side with its own vertices and uvs in [0,1]^2.
Mesh make_cube();
/// Mitsuba's rectangle: [-1,1]^2 in the plane z = 0, normal +z, uvs in [0,1]^2.
Mesh make_rectangle();
/// Unit sphere: an icosahedron whose triangles are split in four `subdivisions` times (0 to 9:
/// 20 * 4^subdivisions triangles), vertices and normals exactly on the sphere. Throws InputError
/// outside that range.
Mesh make_icosphere(int subdivisions);
/// Torus about z: distance `major` from the axis to the tube's middle, tube radius `minor`,
/// `around` x `across` quads of two triangles. Throws InputError unless major > minor > 0 and both
/// counts are at least 3 and make at most 2^31 triangles.
Mesh make_torus(float major, float minor, int around, int across);

/// Normals of the vertices: those of the adjacent triangles, weighted by the angle at the vertex
/// (Thuermer and Wuethrich 1998, Computing Vertex Normals from Polygonal Facets, JGT 3(1)). The
/// weight by angle does not depend on how polygons were cut into triangles. Vertices without a
/// triangle of nonzero area get +z.
void compute_normals(Mesh& mesh);

}  // namespace nacre
