#pragma once
// R(r) of a shape's medium in red, green and blue: on the processor, and as a texture for shaders
// (profile.glsl). Lengths are scene units, R per area in them.
#include <array>
#include <memory>

#include "nacre/bssrdf/profile.h"
#include "nacre/realtime/realtime_technique.h"

namespace nacre {

class BandProfiles {
  public:
    /// Throws InputError as make_profile does.
    explicit BandProfiles(const RealtimeInput& input);

    const std::array<ProfileMedium, 3>& media() const { return media_; }
    /// R of a band at r > 0.
    double eval(int band, double r) const { return factors_[std::size_t(band)] * of(band).eval(r); }
    double cumulative(int band, double r) const {
        return factors_[std::size_t(band)] * of(band).cumulative(r);
    }
    double total(int band) const { return factors_[std::size_t(band)] * of(band).total(); }
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
    const RadialProfile& of(int band) const { return *profiles_[std::size_t(band)]; }

    std::array<ProfileMedium, 3> media_;
    std::array<std::unique_ptr<RadialProfile>, 3> profiles_;
    std::array<double, 3> factors_{1, 1, 1};  // of a rough boundary
    double scale_ = 0, reach_ = 0;
};

}  // namespace nacre
