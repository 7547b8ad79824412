#pragma once
// The parts of the built-in sculpture. Lengths in mm. Parts of the head are modelled in the head's
// frame: origin midway between the eyes' level and the middle of the skull, x to the figure's left,
// y up, z forwards; the head is 230 mm from chin (y = -115) to crown (y = 115). The rest is in the
// figure's frame, see figure.h.
#include "nacre/math/vec.h"

namespace nacre::figure {

/// The bare skull without face: what hair lies on.
float cranium(const Point3f& p);
/// Skull, face, jaw; no ears, no hair.
float face(const Point3f& p);
float ear(const Point3f& p);
float hair(const Point3f& p);

/// Neck, shoulders, chest and base.
float torso(const Point3f& p);
float collar(const Point3f& p);

}  // namespace nacre::figure
