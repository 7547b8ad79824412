#pragma once
// How far a measurement is from the reference: what is wrong with it however long it runs, and what
// is noise of one frame.
#include "nacre/compare/measurement.h"
#include "nacre/metrics/metrics.h"

namespace nacre {

/// All relative: 0.05 is 5 %. With sigma, one standard error.
struct Uncertain {
    double value = 0, sigma = 0;
};

struct Verdict {
    /// Root mean square of the relative errors of the means of blocks, noise taken off: what stays
    /// wrong however long it runs. 0 if what is seen can be noise.
    Uncertain systematic;
    /// (mean over the object) / (that of the reference) - 1: too bright or too dark on the whole.
    Uncertain bias;
    /// Root of the relMSE of one frame, pixel by pixel: systematic error and noise together.
    double frame = 0;
    double noise = 0;             ///< the part of it that is noise
    double pixel_systematic = 0;  ///< the rest of it, sqrt(frame^2 - noise^2)
    double pixel_sigma = 0;       ///< one standard error of the rest
    double flip = 0;              ///< HDR-FLIP of one frame
    Image flip_map;               ///< channel Y
    /// The metrics of the mean of all repeats against the reference.
    Metrics metrics;
};

/// `reference_variance` is that of the mean. Throws InputError as `compare`.
Verdict judge(const Measurement& measurement, const Image& reference,
              const Image& reference_variance, const PixelMask& mask, int block = 16);

}  // namespace nacre
