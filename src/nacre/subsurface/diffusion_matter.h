#pragma once
// A scene's medium as matter of a diffusion grid, four bands at a time.
#include "nacre/diffusion/problem.h"
#include "nacre/scene/medium.h"
#include "nacre/spectrum/bands.h"

namespace nacre {

/// The smallest and largest sigma_t' of a medium over the cells of a grid, any band.
struct ReducedExtinction {
    double least = 0., most = 0.;
};
/// Of a medium within a box: exact for homogeneous ones, by samples for volumes.
ReducedExtinction reduced_extinction(const Medium& medium, const Bands& bands, const Box3f& box);

/// D = 1 / (3 sigma_t') and sigma_a of each cell in the bands of group `g`; unused lanes repeat the
/// last band. Matter thinner than one mean free path over the whole object is taken for that: where
/// there is nothing, light crosses and does not diffuse, and D must stay finite. Throws InputError
/// for a negative density, with its place. `boundary` is A.
DiffusionMatter diffusion_matter(const CellGrid& grid, const Medium& medium, const Bands& bands,
                                 int g, double boundary);

}  // namespace nacre
