#pragma once
// The tables of marginal_warp.h at sixteen places at a time, each lane as a single call has it but
// for rounding. Only for the .cpp files of this room.
#include "nacre/measured/marginal_warp.h"
#include "nacre/measured/packs.h"

namespace nacre {

/// A SliceMix for each lane: two slices where the table depends on one parameter, else four. Weights
/// may be 0, of slices that are there.
struct PackMix {
    int count = 2;
    PackInts slice[4];
    Pack weight[4];
};
PackMix slices_at(const ParameterGrid& grid, Pack slow, Pack fast);

/// The first slice of a table.
Pack eval(const BilinearTable& table, Pack x, Pack y);

struct PackPoint {
    Pack x, y, density;
};
PackPoint sample(const MarginalWarp& warp, Pack u, Pack v, const PackMix& mix);
PackPoint invert(const MarginalWarp& warp, Pack x, Pack y, const PackMix& mix);
Pack density(const MarginalWarp& warp, Pack x, Pack y, const PackMix& mix);

}  // namespace nacre
