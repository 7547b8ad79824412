#pragma once
// R(r) of a shape's medium in red, green and blue: on the processor, and as a texture for shaders
// (profile.glsl). Lengths are scene units, R per area in them.
#include <array>
#include <vector>

#include "nacre/bssrdf/radial_table.h"
#include "nacre/realtime/realtime_technique.h"

namespace nacre {

class BandProfiles {
  public:
    /// Throws InputError as make_profile does.
    explicit BandProfiles(const RealtimeInput& input);

    const std::array<ProfileMedium, 3>& media() const { return media_; }
    /// R of a band at r > 0, from a table: within 1e-4.
    double eval(int band, double r) const { return factor(band) * of(band).eval(float(r * r)); }
    double cumulative(int band, double r) const {
        return factor(band) * of(band).cumulative(float(r * r));
    }
    double total(int band) const { return totals_[std::size_t(band)]; }
    /// The largest length on which any band varies, and beyond which nothing much is.
    double scale() const { return scale_; }
    double reach() const { return reach_; }
    /// A radius within which a share of the mean over the bands of the profile lies; share in
    /// (0, 1).
    double radius_of(double share) const;

    /// rgba32f, one row: log2 R of the bands over log2 r from `texture_low` to `texture_high`.
    Texture texture() const;
    double texture_low() const { return 1e-3 * scale_; }
    double texture_high() const { return 4 * reach_; }
    /// Binds the texture and sets the uniforms of profile.glsl.
    void bind(ComputePass& pass, int unit, const Texture& texture) const;

  private:
    const RadialTable& of(int band) const { return tables_[std::size_t(band)]; }
    double factor(int band) const { return factors_[std::size_t(band)]; }

    std::array<ProfileMedium, 3> media_;
    std::vector<RadialTable> tables_;  // some profiles take long to ask
    std::array<double, 3> totals_{};
    std::array<double, 3> factors_{1, 1, 1};  // of a rough boundary
    double scale_ = 0, reach_ = 0;
};

}  // namespace nacre
