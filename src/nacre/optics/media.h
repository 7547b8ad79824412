#pragma once
// Measured translucent media.
#include <optional>
#include <string_view>

#include "nacre/catalogue/catalogue.h"
#include "nacre/math/vec.h"

namespace nacre {

/// Optical coefficients of a medium in the red, green and blue bands, mm^-1.
struct MeasuredMedium {
    std::string_view name, source;
    Vec3f sigma_s_prime;                       ///< reduced scattering (1 - g) sigma_s
    Vec3f sigma_a;                             ///< absorption
    float eta;                                 ///< index of refraction over air
    std::optional<Vec3f> diffuse_reflectance;  ///< published beside the coefficients (Jensen 2001)

    Vec3f sigma_t_prime() const { return sigma_s_prime + sigma_a; }
};

/// All 47: Jensen et al. 2001, A Practical Model for Subsurface Light Transport, SIGGRAPH (twelve,
/// with index and diffuse reflectance) and Narasimhan et al. 2006, Acquiring Scattering Properties
/// of Participating Media by Dilution, SIGGRAPH (liquids and powders in water, which publish no
/// index: that of water, 1.33, is used). "skim milk" finds Skimmilk.
const Catalogue<MeasuredMedium>& measured_media();

}  // namespace nacre
