#pragma once
// The standard tables of colorimetry, linearly interpolated, and integrals against them.
#include <functional>

#include "nacre/math/vec.h"

namespace nacre {

/// CIE 1931 2-degree colour matching functions xbar, ybar, zbar (CIE 018:2019; 5 nm); 0 outside
/// 360..830 nm.
Vec3f cie_xyz(float nm);

/// Relative power of daylight D65 (CIE 15:2018, which defines it by linear interpolation of 10 nm
/// values; 100 at 560 nm); 0 outside 360..830 nm.
float cie_d65(float nm);

/// D65 scaled so that its Y is 1 in the scale of color.h.
float d65_unit(float nm);

/// Integral of ybar, nm: the scale of XYZ in nacre.
inline constexpr float cie_y_integral = 106.857028f;

/// XYZ of a spectrum given as a function of nm, in the scale of color.h; trapezoid rule of 0.5 nm
/// over the visible range.
Vec3f integrate_xyz(const std::function<float(float)>& spectrum);

}  // namespace nacre
