#pragma once
// Measured reflectance and models as files of a format, and how far the file is from its source.
#include <memory>

#include "nacre/measured/formats.h"

namespace nacre {

struct ConvertOptions {
    WriteOptions write;
    bool turned_around = false;  ///< the mean over turns instead of a refusal (views.h)
    bool colour = false;         ///< red, green and blue in place of wavelengths
};

/// Of values times the cosine of the exit, which is what is seen, over random pairs of directions of
/// which source and file both know it.
struct ResamplingError {
    std::string where;      ///< "both within 80 degrees", ...
    std::size_t pairs = 0;  ///< that were compared
    double mean = 0.;       ///< the mean difference over the mean value
    /// The 95th percentile of the difference over the larger of value and 1 % of the mean value.
    double percentile95 = 0.;
    std::size_t unknown = 0;  ///< pairs that the source knows and the file does not
    std::size_t added = 0;    ///< pairs of which the file says something and the source does not
};

struct Converted {
    std::string bytes;
    std::unique_ptr<Measured> data;  ///< the bytes, read again
    std::vector<std::string> lost;   ///< what the file does not say that its source does
    std::vector<ResamplingError> errors;
};

/// The formats that can be written: "rgl, merl, ...".
std::vector<std::string_view> writable_formats();

/// Throws InputError "FORMAT ...": it cannot be written; the source is anisotropic or has
/// transmission alone where the format holds neither.
Converted convert(std::shared_ptr<const Measured> source, const MeasuredFormat& format,
                  const ConvertOptions& options);

/// Three sets of 4,096 pairs: both directions by the cosine, within 80 degrees of the normal; half
/// vectors about the normal, denser there as highlights are, with both within 80 degrees; one or
/// both beyond 80 degrees. Random numbers are the same every time.
std::vector<ResamplingError> resampling_errors(const Measured& source, const Measured& file);

}  // namespace nacre
