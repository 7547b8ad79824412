#pragma once
// Kautz and McCool's comparison: spheres of the original BRDF above, of sums of factors below.
#include <span>

#include "nacre/image/image.h"
#include "nacre/measured/target.h"

namespace nacre {

struct SphereOptions {
    int size = 240;   ///< pixels of a sphere's square
    int samples = 3;  ///< a side of each pixel's grid of samples
};

/// A row of spheres of the originals, each in the middle above its row of approximations; all of
/// them as bright as the light makes them, the exposure of a group taken from its original: of the
/// pixels that are lit, one in fifty is brighter than white.
///
/// A sphere is seen orthographically along -z, with y up and its tangents around the vertical axis,
/// in the light of three directions: white from the upper left, half as much from the right, and a
/// third from above behind. Radiance is the sum of f cos(theta_i) E over them; nothing is
/// sampled. No shadows: a sphere has none on itself but where cos(theta_i) < 0.
struct SphereGroup {
    const Target* original = nullptr;
    std::vector<const Target*> approximations;
};
Image draw_spheres(std::span<const SphereGroup> groups, const SphereOptions& options = {});

}  // namespace nacre
