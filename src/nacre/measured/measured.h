#pragma once
// What any file of measured reflectance holds, whatever its format; formats.h reads them.
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "nacre/math/vec.h"

namespace nacre {

/// Of one file: what it says of itself, what was found in it.
struct MeasuredInfo {
    std::string format;               ///< name in formats.h: "merl"; "factors" of a folder of them
    std::string description;          ///< the file's own words; may be empty
    std::string parameterisation;     ///< in which coordinates it is stored
    std::string scale;                ///< how stored numbers become sr^-1, in words
    int channels = 3;                 ///< 1: grey; 3 without wavelengths: linear red, green, blue
    std::vector<double> wavelengths;  ///< nm, ascending, one a channel; empty: grey or bands
    bool isotropic = true;            ///< turning the surface about its normal changes nothing
    bool cosine = false;              ///< the file holds f cos; `Measured::eval` never does

    /// Which light is known: "front" is the side of z > 0 on which the light is.
    bool reflection_front = true, reflection_back = false;
    bool transmission_front = false, transmission_back = false;

    std::size_t samples = 0;   ///< places of the table or measured geometries
    std::size_t missing = 0;   ///< of them without a measurement, as the file says
    std::size_t negative = 0;  ///< of them with a value below 0 in any channel, which no BRDF has
    double largest_incidence = 0., largest_exit = 0.;  ///< of what is known, degrees, 0..90

    std::vector<std::string> notes;  ///< what is odd about the file, a sentence each
};

enum class SampleState { good, missing, negative };

/// One place of the table, at its own directions; negative values stand as they are.
struct MeasuredSample {
    Vec3d wi, wo;
    SampleState state;
    std::span<const double> value;  ///< sr^-1 without cosine, one a channel; unknown if missing
};

/// More channels than this are refused, so that callers can keep one value on the stack.
inline constexpr int max_measured_channels = 1024;

class Measured {
  public:
    virtual ~Measured() = default;
    const MeasuredInfo& info() const { return info_; }

    /// BSDF in sr^-1, without cosine, one number a channel (`out` has info().channels), interpolated
    /// in the data's own parameterisation; light comes from `wi`. Negative where the data are so.
    /// False, and nothing in `out`, where there is no measurement: also below the horizon, unless
    /// the file has transmission or the back side. Safe to call from many threads; no allocation.
    virtual bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const = 0;
    /// The same in single precision, for renderers: as quick as the format allows.
    virtual bool eval_float(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const;

    /// The same for many pairs: a row of channels each, and whether single calls are true; where not,
    /// the row has no meaning. As single calls but for rounding in single precision, and as quick as
    /// the format allows.
    virtual void eval_many(std::span<const Vec3d> wi, std::span<const Vec3d> wo,
                           std::span<double> out, std::span<bool> known) const;
    virtual void eval_float_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo,
                                 std::span<float> out, std::span<bool> known) const;

    /// Every place of the table, in the file's order. Directions of missing ones may lie below the
    /// horizon.
    virtual void for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const = 0;

  protected:
    /// Fills what `info` counts of samples, by for_each_sample.
    void count_samples();
    MeasuredInfo info_;
};

inline double mean_of_values(std::span<const double> values) {
    double sum = 0.;
    for (const double v : values) sum += v;
    return sum / double(values.size());
}

/// Linear red, green and blue (color.h) of channel values. Bands are themselves, grey is three
/// times itself. Wavelengths: colour of the surface under D65, CIE 1931 2-degree observer, linear
/// between them and constant beyond the first and last; what reflects all alike is white exactly.
/// Colours outside sRGB have negative components.
class ChannelColours {
  public:
    explicit ChannelColours(const MeasuredInfo& info);
    Vec3d operator()(std::span<const double> channels) const;

  private:
    std::vector<Vec3d> weight_;
};

}  // namespace nacre
