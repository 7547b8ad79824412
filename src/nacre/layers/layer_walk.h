#pragma once
// The Monte Carlo algorithm of Hanrahan and Krueger 1993 (SIGGRAPH 93, section 5.2) on any stack of
// layers: the plain walk, one photon after the other, in double precision. It makes no assumption
// beyond flat homogeneous layers and smooth boundaries, so faster methods are measured against it.
//
// A photon enters with the share 1 - F that the first surface lets in. It flies -ln(1 - u) mean
// free paths; a boundary on the way mirrors it with probability F and else refracts it, and the
// flight goes on with what is left of the path, in the units of the next layer. At its end the
// weight is multiplied by the albedo and the direction drawn from Henyey and Greenstein's function.
// A photon that leaves scores its weight.
//
// Two things differ from the paper's listing, where they would bias the result: a photon that
// reaches a boundary keeps its weight, for that it came so far is already the outcome of a chance;
// and walks of little weight are ended by roulette, not by a threshold.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nacre/layers/layer.h"

namespace nacre {

struct LayerWalkOptions {
    std::uint64_t photons = 100000;  ///< >= 2
    std::uint64_t seed = 0;
    double cosine = 1.;    ///< of the light above the stack, in (0, 1]; it comes from azimuth 0
    bool diffuse = false;  ///< light from all directions alike (cosine-weighted) instead
    std::size_t cosine_bins = 20, azimuth_bins = 1;  ///< >= 1
};

/// Light that leaves by one face of the stack after at least one scattering, in bins of equal solid
/// angle: equal steps of |cosine| from 0 and of azimuth from 0 to 2 pi.
struct AngularBins {
    std::size_t cosines = 0, azimuths = 0;
    std::vector<Estimate> share;  ///< of the power that falls on the stack; cosine-major

    const Estimate& at(std::size_t cosine, std::size_t azimuth) const {
        return share[cosine * azimuths + azimuth];
    }
    double solid_angle() const;
};

struct LayerWalkResult {
    double specular = 0.;    ///< exact for a beam: the share that the first surface mirrors
    Estimate reflectance;    ///< without `specular`, but with what inner boundaries mirror
    Estimate transmittance;  ///< all that leaves below; what a clear infinite last layer swallows
                             ///< counts as well
    Estimate absorptance;
    Estimate unscattered;  ///< the part of `transmittance` that was never scattered
    AngularBins reflected, transmitted;

    /// The means; `reflectance` with `specular`. Roulette lets their sum differ from 1 by noise.
    LayerTotals totals() const;
};

/// Throws as `check` does, for options out of range, and for an infinite layer that scatters but
/// does not absorb: the mean length of a walk in it is infinite. The same options give the same
/// bits.
LayerWalkResult layer_walk(const LayerStack& stack, const LayerWalkOptions& options = {});

}  // namespace nacre
