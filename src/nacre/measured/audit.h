#pragma once
// Whether measured reflectance can be trusted: what no BRDF does, and what is not known.
#include <array>
#include <string>
#include <vector>

#include "nacre/measured/measured.h"

namespace nacre {

/// A pair of directions and what is odd about it. Values are means over the channels, sr^-1.
struct AuditedPair {
    Vec3d wi, wo;
    double value = 0.;
    double other = 0.;  ///< of exchanged directions; the median of the neighbours
};

// Range, reciprocity and outliers are those of directions within 80 degrees of the normal: beyond,
// measurements are unreliable, and what is a small error of f cos is a large one of f.

/// Values of samples that are not missing, means over the channels, sr^-1.
struct AuditRange {
    double smallest = 0., median = 0., percentile99 = 0., largest = 0., mean = 0.;
    double most_negative = 0.;  ///< of any channel, at any angle; 0: none
};

/// f(wi, wo) against f(wo, wi), light reflected in front: at the data's samples and at 8,192 random
/// pairs. Differences count over the larger of both values' mean and 1 % of the mean value.
struct AuditReciprocity {
    std::size_t pairs = 0;
    double mean = 0., median = 0., percentile95 = 0., largest = 0.;
    std::size_t apart = 0;           ///< pairs that differ by more than `allowed`
    std::vector<AuditedPair> worst;  ///< up to five of them, the worst first
    static constexpr double allowed = 0.1;
};

/// Light that is sent back and through, of light from one direction; of the exits that are known. By
/// 16,384 scrambled Sobol' points of half vectors, fine about the mirror direction.
struct AuditAlbedo {
    double theta = 0.;  ///< of incidence, degrees
    bool front = true;
    Vec3d reflected, transmitted;  ///< linear red, green and blue
    /// The largest sum of both in any channel; of isotropic surfaces at one azimuth, of others the
    /// largest of eight.
    double largest = 0.;
    double known_reflected = 0., known_transmitted = 0.;  ///< share of exits, by cosine
    /// What counts as more than all light: the error of the points is below 2 % where data are constant on
    /// patches, and far below elsewhere.
    static constexpr double most = 1.02;
};

/// Samples far from their neighbours: more than three times the largest, or less than a third of the
/// smallest, of the eight nearest (scattered.h), and by more than a tenth of the samples' mean. Of
/// more than 100,000 samples evenly spread ones are looked at.
struct AuditOutliers {
    std::size_t looked_at = 0, count = 0;
    std::vector<AuditedPair> worst;  ///< up to five, the farthest first
};

struct Audit {
    AuditRange range;
    AuditReciprocity reciprocity;
    std::vector<AuditAlbedo> albedo;
    AuditOutliers outliers;
    double known =
        0.;  ///< share of pairs within 80 degrees of the normal, by cosine, reflected in front
    std::vector<std::string> trusted, doubtful;  ///< the verdict, a sentence each
};

Audit audit(const Measured& data);

}  // namespace nacre
