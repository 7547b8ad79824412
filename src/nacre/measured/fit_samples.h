#pragma once
// The directions at which models are compared with a target, and how far apart they are.
//
// The directions are a grid over half-angle coordinates (half_angle.h): nodes of theta_h at
// ((i + 1/2)/32)^2 90 degrees, dense about the highlight, 16 of theta_d, 16 of phi_d over the whole
// circle. phi_h goes round by the golden ratio from one to the next, so that what depends on it is
// seen. Pairs with an angle of more than 80 degrees to the normal are left out, as is usual:
// measurements are unreliable there and models diverge (Ngan et al. 2005). The weight of a pair is
// the measure that it stands for, dwi dwo = 4 cos(theta_d) dw_h dw_d.
//
// Measures of error, means over pairs and bands (t: target, f: model, c = cos theta_i):
//   cosine  sqrt(<(f c - t c)^2>): A. Ngan, F. Durand, W. Matusik 2005, Experimental Analysis of
//           BRDF Models, EGSR. The light that comes out; a sharp highlight decides it alone.
//   log     sqrt(<(log(1 + f c) - log(1 + t c))^2>): E2 of J. Low, J. Kronander, A. Ynnerman,
//           J. Unger 2012, BRDF Models for Accurate and Efficient Rendering of Glossy Surfaces,
//           ACM TOG 31(1). Linear where a surface is matte, relative in highlights.
//   cuberoot  sqrt(<(cbrt(f c) - cbrt(t c))^2>): closer to what people see than either RMS of f c:
//           A. Fores, J. Ferwerda, J. Gu 2012, Toward a Perceptually Based Metric for BRDF
//           Modeling, CIC 20. Weighs what is dark the most.
// All are also given as parts of the target's own: 1 is the error of a black surface.
#include <vector>

#include "nacre/measured/target.h"

namespace nacre {

enum class FitMetric { cosine, log, cuberoot };

struct FitGrid {
    int theta_h = 32, theta_d = 16, phi_d = 16;
    double largest_angle = 80.;  ///< to the normal, degrees
    /// Which nodes: all, or those whose three indices have an even or an odd sum, so that each of
    /// the halves lies between the nodes of the other.
    enum class Nodes { all, even, odd } nodes = Nodes::all;
};

/// A target's values at the pairs of the grid at which it has one.
struct TargetSamples {
    std::vector<Vec3d> wi, wo;
    std::vector<double> weight;  ///< sums to 1
    std::vector<Vec3d> value;    ///< sr^-1
    std::size_t missing = 0;     ///< pairs within the largest angle at which it has none
    bool isotropic = true;

    std::size_t size() const { return wi.size(); }
    /// Every `stride`-th of them.
    TargetSamples thinned(std::size_t stride) const;
};

/// Throws InputError if the target has no value at any of them, or is black.
TargetSamples sample_target(const Target& target, const FitGrid& grid = {});

/// f c as the metric sees it.
inline double seen(double value_cos, FitMetric metric) {
    switch (metric) {
        case FitMetric::cosine:
            break;
        case FitMetric::log:
            return std::log1p(std::max(value_cos, 0.));
        case FitMetric::cuberoot:
            return std::cbrt(std::max(value_cos, 0.));
    }
    return value_cos;
}
/// Its derivative by f c; of the cube root, which has none at 0, not above that at 1e-9.
inline double seen_slope(double value_cos, FitMetric metric) {
    switch (metric) {
        case FitMetric::cosine:
            break;
        case FitMetric::log:
            return 1. / (1. + std::max(value_cos, 0.));
        case FitMetric::cuberoot: {
            const double root = std::cbrt(std::max(value_cos, 1e-9));
            return 1. / (3. * root * root);
        }
    }
    return 1.;
}
/// The word for it on the command line.
std::string_view name_of(FitMetric metric);
/// RMS of what the metric sees of the target: the error of black.
double target_size(const TargetSamples& samples, FitMetric metric);

struct FitErrors {
    double cosine = 0., log = 0., cuberoot = 0.;  ///< as above; cosine in sr^-1
    /// Over those of a black surface.
    double cosine_relative = 0., log_relative = 0., cuberoot_relative = 0.;

    double relative(FitMetric m) const {
        return m == FitMetric::cosine ? cosine_relative
               : m == FitMetric::log  ? log_relative
                                      : cuberoot_relative;
    }
};
/// Of what has a value wherever the target has one.
FitErrors errors_of(const Target& fitted, const TargetSamples& samples);
FitErrors errors_of(const AnyModel& model, const TargetSamples& samples);

}  // namespace nacre
