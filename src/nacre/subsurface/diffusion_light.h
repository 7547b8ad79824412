#pragma once
// Light that enters an object, as sources of diffusion: power that is scattered for the first time
// in each cell along refracted rays, or power that falls on the surface of each cut cell. Light
// comes by the renderer's own paths, so all kinds of light and what other surfaces reflect count.
#include "nacre/diffusion/problem.h"
#include "nacre/render/path_tracer.h"
#include "nacre/spectrum/bands.h"

namespace nacre {

/// What it takes, beside the light. All outlive a call.
struct EntryInput {
    const Scene& scene;
    std::uint32_t shape;
    const ObjectBoundary& boundary;
    const CellGrid& grid;
    double samples = 8.;  ///< paths for each h^2 of the surface
    std::uint64_t seed = 0;
    const Work& work;
};

enum class EntrySource {
    volume,  ///< where light is first scattered: reduced intensity along refracted rays
    surface  ///< where it enters
};

struct EnteredLight {
    std::vector<BandDoubles> power;  ///< of `volume`: scattered first in each cell
    std::vector<BandDoubles> flux;   ///< of `surface`: per area of each cut
    BandDoubles entered{0.};         ///< power in all
    BandDoubles passed{0.};          ///< of it, what leaves again without having been scattered
};

/// In the bands of group `g`. The same bits for any number of threads.
EnteredLight entered_light(const EntryInput& in, const PathTracer& light,
                           const DiffusionMatter& matter, const Bands& bands, int g,
                           EntrySource source);

}  // namespace nacre
