#pragma once
// Where translucent shadow maps look around a point: a dense square of 7 x 7 taps, and rings around
// it that grow with the profile. The paper's pattern is fixed in texels, which goes dark on small
// objects and noisy on large ones (Yao and Wang 2009); this one follows the matter: rings lie where
// equal shares of the light come from, for the depth at which the light enters. What a tap stands
// for is weighed so that an evenly lit plane at that depth comes out exactly, in each band.
#include <functional>
#include <vector>

#include "nacre/realtime/gl/objects.h"

namespace nacre {

inline constexpr int square_taps = 7, ring_taps = 7;

/// For a list of depths, how far the rings lie and what they count.
struct TapPattern {
    int rings = 0;
    double square = 0;                        ///< width of one tap of the square
    double depth_scale = 0, depth_range = 0;  ///< column = log2(1 + z / scale) / range, in [0, 1]
    int columns = 0;
    /// Rows of rgba: the square's factors (rgb); then for each ring (radius, area of a tap, 0, 0)
    /// and its factors (rgb).
    std::vector<float> table = {};

    Texture texture() const;
};

/// R of a band at lateral distance rho from a source that enters at depth z before the point.
using TapKernel = std::function<double(int band, double rho, double z)>;
/// `near`: a radius within which the square lies; `deepest`: the largest depth of interest;
/// `reach`: beyond which R at depth 0 is nothing.
TapPattern make_tap_pattern(const TapKernel& kernel, int rings, double near, double reach,
                            double deepest);

}  // namespace nacre
