#pragma once
// Planck's law in double precision. Spectra of black bodies: make_blackbody of spectrum.h.
#include <cmath>

namespace nacre {

/// Spectral radiance of a black body of that temperature (K) at a wavelength (nm), W m^-2 sr^-1
/// nm^-1: 2 h c^2 / lambda^5 / (exp(h c/(lambda k T)) - 1) with the constants of the SI (2019).
inline double planck_radiance(double nm, double kelvin) {
    constexpr double h = 6.62607015e-34, c = 299792458., k = 1.380649e-23;
    const double m = nm * 1e-9;
    return 1e-9 * 2. * h * c * c / (m * m * m * m * m) / std::expm1(h * c / (m * k * kelvin));
}

}  // namespace nacre
