#pragma once
// FLIP: how different two pictures look when one flips between them.
//
//   LDR-FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, FLIP: A
//   Difference Evaluator for Alternating Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2).
//   HDR-FLIP: Andersson, Nilsson, Shirley and Akenine-Moller 2021, Visualizing Errors in Rendered
//   High Dynamic Range Images, Eurographics Short Papers.
//
// The error of a pixel is in [0, 1]: E = C^(1 - F), where C is the distance of the colours that the
// eye would see (flip_color.h, after the filters of flip_filters.h) and F the difference of edges
// and points, F = (max(|edges|, |points|) / sqrt(2))^q_f with q_f = 0.5. Its mean is the number to
// quote. Constants are the papers'; those of single steps stand where the steps are. The
// authors' program (flip-evaluator 1.7) gives the same to 1e-4 a pixel
// (tests/compare/test_flip.cpp).
//
// Pictures are linear RGB. Values are not rounded to 8 bits as they would be in a file.
#include <optional>

#include "nacre/metrics/pictures.h"

namespace nacre {

/// A screen 0.7 m wide with 3840 pixels, seen from 0.7 m: 67.02 pixels a degree (2020).
inline constexpr double flip_pixels_per_degree = 3840. * 3.14159265358979323846 / 180.;

struct FlipResult {
    Image map;        ///< channel Y, every pixel
    double mean = 0;  ///< over the mask
};

/// LDR-FLIP of what a screen shows: values are clamped to [0, 1]. Symmetric in the pictures. Throws
/// InputError if the pictures or the mask differ in size, if the mask leaves no pixel, if any value
/// is not finite (its neighbours' errors would not be either), or if pixels_per_degree is not from
/// 1 to 10000.
FlipResult flip(const Image& picture, const Image& reference, const PixelMask& mask = {},
                double pixels_per_degree = flip_pixels_per_degree);

/// The exposures of HDR-FLIP, in stops.
struct FlipExposures {
    double start = 0, stop = 0;
    int count = 1;
    double operator[](int i) const {
        return count > 1 ? start + i * (stop - start) / (count - 1) : start;
    }
};

/// From the reference's luminance Y: `start` maps the maximum and `stop` the median to 0.85 by
/// `flip_tone_map`; their number is max(2, ceil(stop - start)) (2021). Where the median
/// is 0, that of the positive values stands for it; a black reference and one of a single luminance
/// have one exposure (0 for black).
FlipExposures flip_exposures(const Image& reference);

/// What a screen shows of linear `value` at `exposure` stops, in [0, 1]: the fit to ACES of
/// Narkowicz 2015, ACES Filmic Tone Mapping Curve, x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14),
/// of x = 0.6 2^exposure max(value, 0); 0.6 undoes the exposure built into the fit (2021).
float flip_tone_map(float value, double exposure);

struct HdrFlipResult : FlipResult {
    FlipExposures exposures;
    Image exposure;  ///< channel Y: the first exposure, in stops, that shows the error of the map
};

/// HDR-FLIP: the maximum over exposures of LDR-FLIP of the tone-mapped pictures. The exposures are
/// those of the reference unless given. Throws as `flip`, and if their count is below 1.
HdrFlipResult flip_hdr(const Image& picture, const Image& reference, const PixelMask& mask = {},
                       double pixels_per_degree = flip_pixels_per_degree,
                       std::optional<FlipExposures> exposures = {});

}  // namespace nacre
