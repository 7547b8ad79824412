#pragma once
// Filters of FLIP (Andersson et al. 2020, see flip.h: spatial filtering, feature pipeline), all of
// them sums of products of a function of x and one of y, so that an image is filtered by rows and
// then by columns.
#include <span>
#include <vector>

namespace nacre::flip_steps {

/// One number a pixel, row by row.
struct Plane {
    int width = 0, height = 0;
    std::vector<float> data;
};

/// Convolves rows with `across` and columns with `down`, both of odd length and centred; beyond its
/// border the plane goes on as at the border.
Plane filter(const Plane& plane, std::span<const float> across, std::span<const float> down);

/// A filter on both axes alike, with its part in a sum of several.
struct SpatialFilter {
    float weight;
    std::vector<float> taps;  ///< sum to 1
};

/// Contrast sensitivity of the eye as a filter of one channel of YCxCz:
///   a1 sqrt(pi / b1) exp(-pi^2 r^2 / b1) + a2 sqrt(pi / b2) exp(-pi^2 r^2 / b2),
/// r in degrees, normalised to sum 1. (a1, b1, a2, b2) are the paper's: achromatic (1, 0.0047, 0,
/// -), red-green (1, 0.0053, 0, -), blue-yellow (34.1, 0.04, 13.5, 0.025). All reach 3 sigma of the
/// widest Gaussian, sigma = sqrt(0.04 / (2 pi^2)) degrees. The weights sum to 1.
enum class Opponent { achromatic, red_green, blue_yellow };
std::vector<SpatialFilter> contrast_sensitivity(Opponent channel, double pixels_per_degree);

/// Taps of the detectors of features in the achromatic channel: a Gaussian of standard deviation
/// w / 2, w = 0.082 degrees being, by the paper, the width of the eye's edge detector from peak to
/// trough, out to 3 sigma, and its first and second derivatives. `smooth`
/// sums to 1; of `edge` and `point` the positive taps sum to 1 and the negative ones to -1.
struct FeatureTaps {
    std::vector<float> smooth, edge, point;
};
FeatureTaps feature_taps(double pixels_per_degree);

}  // namespace nacre::flip_steps
