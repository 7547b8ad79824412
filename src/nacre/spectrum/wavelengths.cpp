#include "nacre/spectrum/wavelengths.h"

#include <cmath>

namespace nacre {

namespace {

// Radziszewski et al. 2009: width and centre of sech^2 fitted to the colour matching functions.
constexpr double width = 0.0072, centre = 538.;
// The distribution function runs over tanh between these ends.
const double tanh_min = std::tanh(width * (visible_min - centre));
const double tanh_max = std::tanh(width * (visible_max - centre));

}  // namespace

float wavelength_pdf(float lambda) {
    if (!(lambda >= visible_min && lambda <= visible_max)) return 0.f;
    const double c = std::cosh(width * (lambda - centre));
    return static_cast<float>(width / ((tanh_max - tanh_min) * c * c));
}

Wavelengths Wavelengths::rgb_bands() {
    const float third = 1.f / 3.f;
    return {ColorMode::rgb_bands, Spectral(0.f), Spectral(1.f), Spectral(third, third, third, 0.f)};
}

Wavelengths Wavelengths::sample(float u) {
    Wavelengths w{ColorMode::spectral, {}, {}, Spectral(0.25f)};
    for (int i = 0; i < 4; ++i) {
        double v = u + 0.25 * i;
        v -= std::floor(v);
        const double lambda = centre + std::atanh(tanh_min + v * (tanh_max - tanh_min)) / width;
        w.lambda.set(i, std::clamp(static_cast<float>(lambda), visible_min, visible_max));
        w.pdf.set(i, wavelength_pdf(w.lambda[i]));
    }
    return w;
}

Wavelengths Wavelengths::at(Spectral lambda) {
    return {ColorMode::spectral, lambda, Spectral(1.f / (visible_max - visible_min)),
            Spectral(0.25f)};
}

}  // namespace nacre
