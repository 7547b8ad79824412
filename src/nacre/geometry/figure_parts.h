#pragma once
// The parts of the built-in sculpture, as signed distances (bounds) in mm.
//
// The head is modelled in its own frame: origin midway between the eyes' level and the middle of
// the skull, x to the figure's left, y up, z forwards. It follows the old canon: 230 mm from chin
// (y = -115) to crown (y = 115), the eyes at half height, the nose ending halfway between brow and
// chin, the mouth a third of the way from there to the chin, the ears between brow and nose's end
// (but for their tips). Everything else is in the figure's frame, see figure.h.
#include "nacre/math/vec.h"

namespace nacre::figure {

/// From the figure's frame to the head's and back: the head is turned, bowed and inclined.
Point3f to_head(const Point3f& p);
Point3f from_head(const Point3f& h);

/// The bare skull without face.
float cranium(const Point3f& h);
/// Skull, jaw and features; no ears, no hair.
float face(const Point3f& h);
/// Both ears: shells 2.2 mm thin with thicker rims.
float ears(const Point3f& h);
/// Waved locks from the hairline to a knot at the back.
float hair(const Point3f& h);

/// Neck, shoulders and chest, cut as a bust is.
float torso(const Point3f& p);
/// Foot below the bust.
float base(const Point3f& p);
/// Pleated collar, a sheet 2.2 mm thin standing behind the neck.
float collar(const Point3f& p);

}  // namespace nacre::figure
