#include "nacre/spectrum/wavelengths.h"

#include <cmath>

#include "nacre/math/lanes_math.h"

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
    Spectral v = u + Spectral(0.f, 0.25f, 0.5f, 0.75f);
    v = select(v >= Spectral(1.f), v - 1.f, v);
    // lambda = centre + atanh(t) / width, and the density in terms of t is 1 - t^2 = sech^2.
    const float low = static_cast<float>(tanh_min), range = static_cast<float>(tanh_max - tanh_min);
    const Spectral t = low + v * range;
    const Spectral lambda =
        static_cast<float>(centre) + log((1.f + t) / (1.f - t)) * static_cast<float>(0.5 / width);
    return {ColorMode::spectral, max(min(lambda, Spectral(visible_max)), Spectral(visible_min)),
            static_cast<float>(width) / range * (1.f - t * t), Spectral(0.25f)};
}

Wavelengths Wavelengths::at(Spectral lambda) {
    return {ColorMode::spectral, lambda, Spectral(1.f / (visible_max - visible_min)),
            Spectral(0.25f)};
}

}  // namespace nacre
