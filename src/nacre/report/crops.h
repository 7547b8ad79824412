#pragma once
// Where in a picture to look closer.
#include <vector>

#include "nacre/metrics/pictures.h"

namespace nacre {

/// A window in pixels.
struct Crop {
    int x = 0, y = 0, side = 0;
};

/// Up to `count` squares of pixels that do not overlap, those in which `pictures` differ most from
/// the reference on the mean over the square, relative to the reference, and which the mask covers
/// at least to a half. A square's side is an eighth of the picture's shorter one, at least 24
/// pixels.
std::vector<Crop> telling_crops(const std::vector<const Image*>& pictures, const Image& reference,
                                const PixelMask& mask, int count);

}  // namespace nacre
