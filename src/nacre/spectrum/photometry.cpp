#include "nacre/spectrum/photometry.h"

#include "nacre/spectrum/cie.h"

namespace nacre {

namespace {

// CIE 1951 scotopic luminous efficiency, 380 to 780 nm by 5 nm.
constexpr std::array<float, 81> scotopic = {
    0.000589f,  0.001108f,  0.002209f, 0.00453f,   0.00929f,  0.01852f,   0.03484f,   0.0604f,
    0.0966f,    0.1436f,    0.1998f,   0.2625f,    0.3281f,   0.3931f,    0.455f,     0.513f,
    0.567f,     0.62f,      0.676f,    0.734f,     0.793f,    0.851f,     0.904f,     0.949f,
    0.982f,     0.998f,     0.997f,    0.975f,     0.935f,    0.88f,      0.811f,     0.733f,
    0.65f,      0.564f,     0.481f,    0.402f,     0.3288f,   0.2639f,    0.2076f,    0.1602f,
    0.1212f,    0.0899f,    0.0655f,   0.0469f,    0.03315f,  0.02312f,   0.01593f,   0.01088f,
    0.00737f,   0.00497f,   0.003335f, 0.002235f,  0.001497f, 0.001005f,  0.000677f,  0.000459f,
    0.0003129f, 0.0002146f, 0.000148f, 0.0001026f, 7.15e-05f, 5.01e-05f,  3.533e-05f, 2.501e-05f,
    1.78e-05f,  1.273e-05f, 9.14e-06f, 6.6e-06f,   4.78e-06f, 3.482e-06f, 2.546e-06f, 1.87e-06f,
    1.379e-06f, 1.022e-06f, 7.6e-07f,  5.67e-07f,  4.25e-07f, 3.196e-07f, 2.413e-07f, 1.829e-07f,
    1.39e-07f};
constexpr float scotopic_min = 380.f, scotopic_max = 780.f, scotopic_step = 5.f;

// Integral over wavelength of the spectrum times an efficiency; trapezoid rule of 0.5 nm, a divisor
// of every table's step.
template <class Efficiency>
float integrate(const Spectrum& s, Efficiency efficiency) {
    constexpr int intervals = 940;
    constexpr double step = 0.5;
    double sum = 0;
    for (int i = 0; i <= intervals; ++i) {
        const float nm = visible_min + static_cast<float>(step) * static_cast<float>(i);
        const double w = i == 0 || i == intervals ? 0.5 * step : step;
        sum += w * efficiency(nm) * s.eval(Wavelengths::at(nm))[0];
    }
    return static_cast<float>(sum);
}

}  // namespace

float photopic_efficiency(float nm) { return cie_xyz(nm).y; }

float scotopic_efficiency(float nm) {
    if (!(nm >= scotopic_min && nm <= scotopic_max)) return 0.f;
    const float x = (nm - scotopic_min) / scotopic_step;
    const std::size_t i = std::min(static_cast<std::size_t>(x), scotopic.size() - 2);
    const float f = x - static_cast<float>(i);
    return scotopic[i] * (1.f - f) + scotopic[i + 1] * f;
}

float luminance(const Spectrum& radiance) {
    return km_photopic * integrate(radiance, photopic_efficiency);
}

float illuminance(const Spectrum& irradiance) {
    return km_photopic * integrate(irradiance, photopic_efficiency);
}

float scotopic_luminance(const Spectrum& radiance) {
    return km_scotopic * integrate(radiance, scotopic_efficiency);
}

}  // namespace nacre
