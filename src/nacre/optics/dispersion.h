#pragma once
// Indices of refraction: of dielectrics by name or dispersion formula, of conductors by name.
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "nacre/spectrum/spectrum.h"

namespace nacre {

/// Wavelength of the sodium D lines, nm, at which an index is quoted when nothing else is said.
inline constexpr float sodium_d = 589.3f;

/// The real index of refraction of a clear material as a function of wavelength.
class DielectricIndex {
  public:
    /// The same at every wavelength. This and the others throw InputError on values that are not
    /// positive and finite.
    explicit DielectricIndex(float n = 1.f);
    /// Cauchy 1836: n = a + b / lambda^2 + c / lambda^4, lambda in micrometres.
    static DielectricIndex cauchy(float a, float b, float c = 0.f);
    /// Sellmeier 1871: n^2 = 1 + sum_i b_i lambda^2 / (lambda^2 - c_i), lambda^2 and c_i in square
    /// micrometres.
    static DielectricIndex sellmeier(std::array<float, 3> b, std::array<float, 3> c);
    /// Linear between the wavelengths `nm` (increasing), constant beyond them.
    static DielectricIndex tabulated(std::vector<float> nm, std::vector<float> n);

    /// Index at a wavelength, nm.
    float at(float nm) const;
    /// Index in each lane. RGB bands are not wavelengths: there every lane has the index of the
    /// sodium D lines, and light does not disperse.
    Spectral eval(const Wavelengths& w) const;
    bool is_dispersive() const { return formula_ != Formula::constant; }

  private:
    enum class Formula { constant, cauchy, sellmeier, tabulated };
    Formula formula_ = Formula::constant;
    std::array<float, 6> k_{};
    std::vector<float> nm_, n_;
};

/// Index at the sodium D lines of a material by name: the names and values of Mitsuba 3 (mostly
/// Hecht, Optics, 4th edition, table 4.1), e.g. vacuum, air, water, bk7, diamond. Throws InputError
/// with the list of names.
float dielectric_index(std::string_view name);
std::vector<std::string_view> dielectric_names();

/// The measured dispersion of a material: bk7 and n-sf11 (Schott 2017), fused quartz (Malitson
/// 1965), diamond (Peter 1923), water at 20 C (Quan and Fry 1995). Throws InputError with the
/// list of names.
DielectricIndex dispersive_dielectric(std::string_view name);
std::vector<std::string_view> dispersive_names();

/// The complex index n + i k of a metal.
struct ConductorIndex {
    SpectrumPtr eta, k;    ///< null for a perfect mirror
    bool perfect = false;  ///< reflects everything: the material "none"
};

/// The measured index of a metal by its symbol: Ag, Al, Au, Cr, Cu, Fe, Hg, Ni, or none for a
/// perfect mirror. In RGB-band mode eta and k are projected like coefficients
/// (SpectrumRole::unbounded). Throws InputError with the list of names.
ConductorIndex conductor_index(std::string_view name);
std::vector<std::string_view> conductor_names();

}  // namespace nacre
