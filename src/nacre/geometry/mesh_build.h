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

/// Between triangles whose normals differ by more than this an edge is hard, degrees. Above the
/// 41.8 of an icosahedron and the 45 of a prism of eight sides, which stand for something round;
/// below the 60 of a prism of six, which stands for itself.
inline constexpr double default_crease_angle = 50;

/// The same, but not across edges at which neighbouring normals differ by more than
/// `crease_angle` degrees (0: none is smooth, 180: all are): a vertex is split into one for each of
/// the groups of triangles around it that hang together by smoother edges. A mesh without such an
/// edge keeps its vertices. Triangles that meet in threes at an edge, or face opposite ways there,
/// do not hang together.
void compute_normals(Mesh& mesh, double crease_angle);

}  // namespace nacre
