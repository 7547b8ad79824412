#pragma once
// Points spread evenly over a mesh by their mutual repulsion.
//
//   G. Turk 1991, Generating Textures on Arbitrary Surfaces Using Reaction-Diffusion, SIGGRAPH 91,
//   section 4.2; 1992, Re-Tiling Polygonal Surfaces, SIGGRAPH 92, section 3. Every point is pushed
//   away by the points within R = 2 sqrt(area / count), with a force R - d at distance d; in a
//   sweep all forces are found first and then all points moved, over edges by unfolding the
//   triangles. Jensen and Buhler 2002 spread their irradiance samples so.
//
// Turk unfolds the neighbours' triangles about their common edges; here a neighbour is turned onto
// the plane of the point's triangle about the point, which keeps the distance in space and needs no
// path between the two: for triangles smaller than R there may be many. Points on the other side
// of a thin sheet and on other components do not count (same_sheet in surface_grid.h).
//
// Points that are pushed over a boundary go on along it, as do those at an edge of three triangles
// or more. Some gather there, because the neighbours that would push them back are missing, and a
// few are squeezed together in folds sharper than the spacing can follow: of 120,000 points on the
// Stanford bunny, with its crumpled base, 50 pairs are closer than half the spacing. Voronoi shares
// (assign_voronoi_shares) weigh such points rightly.
#include "nacre/geometry/surface_point_set.h"
#include "nacre/math/work.h"

namespace nacre {

struct RepulsionOptions {
    int sweeps = 40;  ///< Turk: 40 suffice; 0 to 1000
    /// Displacement per force, above 0 and at most 0.24. The stiffness of the hexagonal lattice
    /// under this force is up to 8.13 (its shortest waves), and beyond 2 / 8.13 a sweep makes
    /// deviations larger.
    float step = 0.15f;
};

/// `count` points by repulsion, from random_points(mesh, count, seed). All shares are area / count.
/// The same seed gives the same bits for any number of threads.
/// @throws InputError as random_points, and for options out of range; Stopped if `work` says so.
SurfacePointSet repelled_points(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                                const RepulsionOptions& options = {}, const Work& work = {});

}  // namespace nacre
