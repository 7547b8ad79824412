#pragma once
// A diffusion profile of a scene's medium, tabulated for rendering.
#include "nacre/bssrdf/radial_table.h"
#include "nacre/math/work.h"
#include "nacre/scene/medium.h"
#include "nacre/spectrum/bands.h"

namespace nacre {

/// The coefficients of a medium in each band, per scene unit, as profiles take them: of one that
/// varies in space, means over the volume that describes it.
std::vector<ProfileMedium> medium_in_bands(const Medium& medium, float eta, const Bands& bands);

/// R(r) of the medium in every band. Lengths are scene units.
class ProfileTables {
  public:
    /// `factors` multiply the profile of each band; empty: 1. Throws InputError as make_profile,
    /// Stopped if `work` says so.
    ProfileTables(const Medium& medium, float eta, std::string_view profile, const Bands& bands,
                  std::span<const double> factors = {}, const Work& work = {});

    /// R at squared distance r2 in the lanes of a path.
    Spectral eval(float r2, const Wavelengths& w) const;
    /// Over the plane.
    Spectral total(const Wavelengths& w) const;
    /// A radius, after one of the lanes (`u1` chooses); and the density per area of such radii.
    float sample(float u1, float u2, const Wavelengths& w) const;
    float pdf(float r2, const Wavelengths& w) const;
    bool includes_single_scattering() const { return includes_single_scattering_; }

  private:
    Bands bands_;
    std::vector<SpectralRadialTable> groups_;
    std::vector<float> totals_;
    bool includes_single_scattering_ = false;
};

}  // namespace nacre
