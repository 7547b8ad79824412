#pragma once
// Which pairs of directions measured data know, as a picture.
#include <string>

namespace nacre {
class Measured;
}

namespace nacre::cli {

/// An SVG: a disc for each of six incidences and each side that the data say anything of, seen
/// from above, of equal areas for equal solid angles, light from the left. In patches of 5 by 10
/// degrees: known, known but negative, not known.
std::string coverage_picture(const Measured& data, const std::string& title);

}  // namespace nacre::cli
