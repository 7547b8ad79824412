#pragma once
// Which lights are worth guiding paths to, and stand-ins for their shapes.
#include <vector>

#include "nacre/render/exit_guide.h"

namespace nacre {

/// The `most` strongest lights outside, as seen from the centre of `object`, the box of `boundary`:
/// parallelograms as they are, spheres as they are, every other area by its bounding sphere unless
/// that centre lies in it; of an environment what stands out of its mean; lights that are points only
/// behind a rough boundary, which lets them be drawn.
std::vector<GuideTarget> find_guide_targets(const Scene& scene, const Box3f& object,
                                            const ExitBoundary& boundary, GuideSkies& skies,
                                            int most);

/// Luminance of what a light that is a point sends to `at`, on a surface that faces it.
float irradiance_of(const Light& point, const Point3f& at);

}  // namespace nacre
