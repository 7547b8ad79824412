#pragma once
// Which lights are worth guiding paths to, and stand-ins for their shapes.
#include <vector>

#include "nacre/render/exit_guide.h"

namespace nacre {

/// The `most` strongest area lights as seen from the centre of `object`: parallelograms as they
/// are, spheres as they are, everything else by its bounding sphere. Lights that are points have no
/// chance of being met behind a refracting boundary, and an environment is found by the walk
/// itself.
std::vector<GuideTarget> find_guide_targets(const Scene& scene, const Box3f& object, int most);

}  // namespace nacre
