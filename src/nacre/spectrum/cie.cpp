#include "nacre/spectrum/cie.h"

#include <array>

#include "nacre/spectrum/wavelengths.h"

namespace nacre {

namespace {

// CIE 1931 standard colorimetric observer, 360 to 830 nm by 5 nm.
constexpr std::array<Vec3f, 95> observer = {{Vec3f{0.0001299f, 3.917e-06f, 0.0006061f},
                                             Vec3f{0.0002321f, 6.965e-06f, 0.001086f},
                                             Vec3f{0.0004149f, 1.239e-05f, 0.001946f},
                                             Vec3f{0.0007416f, 2.202e-05f, 0.003486f},
                                             Vec3f{0.001368f, 3.9e-05f, 0.006450001f},
                                             Vec3f{0.002236f, 6.4e-05f, 0.01054999f},
                                             Vec3f{0.004243f, 0.00012f, 0.02005001f},
                                             Vec3f{0.00765f, 0.000217f, 0.03621f},
                                             Vec3f{0.01431f, 0.000396f, 0.06785001f},
                                             Vec3f{0.02319f, 0.00064f, 0.1102f},
                                             Vec3f{0.04351f, 0.00121f, 0.2074f},
                                             Vec3f{0.07763f, 0.00218f, 0.3713f},
                                             Vec3f{0.13438f, 0.004f, 0.6456f},
                                             Vec3f{0.21477f, 0.0073f, 1.03905f},
                                             Vec3f{0.2839f, 0.0116f, 1.3856f},
                                             Vec3f{0.3285f, 0.01684f, 1.62296f},
                                             Vec3f{0.34828f, 0.023f, 1.74706f},
                                             Vec3f{0.34806f, 0.0298f, 1.7826f},
                                             Vec3f{0.3362f, 0.038f, 1.77211f},
                                             Vec3f{0.3187f, 0.048f, 1.7441f},
                                             Vec3f{0.2908f, 0.06f, 1.6692f},
                                             Vec3f{0.2511f, 0.0739f, 1.5281f},
                                             Vec3f{0.19536f, 0.09098f, 1.28764f},
                                             Vec3f{0.1421f, 0.1126f, 1.0419f},
                                             Vec3f{0.09564f, 0.13902f, 0.8129501f},
                                             Vec3f{0.05795001f, 0.1693f, 0.6162f},
                                             Vec3f{0.03201f, 0.20802f, 0.46518f},
                                             Vec3f{0.0147f, 0.2586f, 0.3533f},
                                             Vec3f{0.0049f, 0.323f, 0.272f},
                                             Vec3f{0.0024f, 0.4073f, 0.2123f},
                                             Vec3f{0.0093f, 0.503f, 0.1582f},
                                             Vec3f{0.0291f, 0.6082f, 0.1117f},
                                             Vec3f{0.06327f, 0.71f, 0.07824999f},
                                             Vec3f{0.1096f, 0.7932f, 0.05725001f},
                                             Vec3f{0.1655f, 0.862f, 0.04216f},
                                             Vec3f{0.2257499f, 0.9148501f, 0.02984f},
                                             Vec3f{0.2904f, 0.954f, 0.0203f},
                                             Vec3f{0.3597f, 0.9803f, 0.0134f},
                                             Vec3f{0.4334499f, 0.9949501f, 0.008749999f},
                                             Vec3f{0.5120501f, 1.f, 0.005749999f},
                                             Vec3f{0.5945f, 0.995f, 0.0039f},
                                             Vec3f{0.6784f, 0.9786f, 0.002749999f},
                                             Vec3f{0.7621f, 0.952f, 0.0021f},
                                             Vec3f{0.8425f, 0.9154f, 0.0018f},
                                             Vec3f{0.9163f, 0.87f, 0.001650001f},
                                             Vec3f{0.9786f, 0.8163f, 0.0014f},
                                             Vec3f{1.0263f, 0.757f, 0.0011f},
                                             Vec3f{1.0567f, 0.6949f, 0.001f},
                                             Vec3f{1.0622f, 0.631f, 0.0008f},
                                             Vec3f{1.0456f, 0.5668f, 0.0006f},
                                             Vec3f{1.0026f, 0.503f, 0.00034f},
                                             Vec3f{0.9384f, 0.4412f, 0.00024f},
                                             Vec3f{0.8544499f, 0.381f, 0.00019f},
                                             Vec3f{0.7514f, 0.321f, 0.0001f},
                                             Vec3f{0.6424f, 0.265f, 4.999999e-05f},
                                             Vec3f{0.5419f, 0.217f, 3e-05f},
                                             Vec3f{0.4479f, 0.175f, 2e-05f},
                                             Vec3f{0.3608f, 0.1382f, 1e-05f},
                                             Vec3f{0.2835f, 0.107f, 0.f},
                                             Vec3f{0.2187f, 0.0816f, 0.f},
                                             Vec3f{0.1649f, 0.061f, 0.f},
                                             Vec3f{0.1212f, 0.04458f, 0.f},
                                             Vec3f{0.0874f, 0.032f, 0.f},
                                             Vec3f{0.0636f, 0.0232f, 0.f},
                                             Vec3f{0.04677f, 0.017f, 0.f},
                                             Vec3f{0.0329f, 0.01192f, 0.f},
                                             Vec3f{0.0227f, 0.00821f, 0.f},
                                             Vec3f{0.01584f, 0.005723f, 0.f},
                                             Vec3f{0.01135916f, 0.004102f, 0.f},
                                             Vec3f{0.008110916f, 0.002929f, 0.f},
                                             Vec3f{0.005790346f, 0.002091f, 0.f},
                                             Vec3f{0.004109457f, 0.001484f, 0.f},
                                             Vec3f{0.002899327f, 0.001047f, 0.f},
                                             Vec3f{0.00204919f, 0.00074f, 0.f},
                                             Vec3f{0.001439971f, 0.00052f, 0.f},
                                             Vec3f{0.0009999493f, 0.0003611f, 0.f},
                                             Vec3f{0.0006900786f, 0.0002492f, 0.f},
                                             Vec3f{0.0004760213f, 0.0001719f, 0.f},
                                             Vec3f{0.0003323011f, 0.00012f, 0.f},
                                             Vec3f{0.0002348261f, 8.48e-05f, 0.f},
                                             Vec3f{0.0001661505f, 6e-05f, 0.f},
                                             Vec3f{0.000117413f, 4.24e-05f, 0.f},
                                             Vec3f{8.307527e-05f, 3e-05f, 0.f},
                                             Vec3f{5.870652e-05f, 2.12e-05f, 0.f},
                                             Vec3f{4.150994e-05f, 1.499e-05f, 0.f},
                                             Vec3f{2.935326e-05f, 1.06e-05f, 0.f},
                                             Vec3f{2.067383e-05f, 7.4657e-06f, 0.f},
                                             Vec3f{1.455977e-05f, 5.2578e-06f, 0.f},
                                             Vec3f{1.025398e-05f, 3.7029e-06f, 0.f},
                                             Vec3f{7.221456e-06f, 2.6078e-06f, 0.f},
                                             Vec3f{5.085868e-06f, 1.8366e-06f, 0.f},
                                             Vec3f{3.581652e-06f, 1.2934e-06f, 0.f},
                                             Vec3f{2.522525e-06f, 9.1093e-07f, 0.f},
                                             Vec3f{1.776509e-06f, 6.4153e-07f, 0.f},
                                             Vec3f{1.251141e-06f, 4.5181e-07f, 0.f}}};

// CIE standard illuminant D65, 360 to 830 nm by 10 nm.
constexpr std::array<float, 48> daylight = {
    46.6383f, 52.0891f, 49.9755f, 54.6482f, 82.7549f, 91.486f,  93.4318f, 86.6823f,
    104.865f, 117.008f, 117.812f, 114.861f, 115.923f, 108.811f, 109.354f, 107.802f,
    104.79f,  107.689f, 104.405f, 104.046f, 100.f,    96.3342f, 95.788f,  88.6856f,
    90.0062f, 89.5991f, 87.6987f, 83.2886f, 83.6992f, 80.0268f, 80.2146f, 82.2778f,
    78.2842f, 69.7213f, 71.6091f, 74.349f,  61.604f,  69.8856f, 75.087f,  63.5927f,
    46.4182f, 66.8054f, 63.3828f, 64.304f,  59.4519f, 51.959f,  57.4406f, 60.3125f};

template <class T, std::size_t N>
T interpolate(const std::array<T, N>& table, float nm) {
    if (!(nm >= visible_min && nm <= visible_max)) return T{};
    const float x = (nm - visible_min) * (float(N - 1) / (visible_max - visible_min));
    const std::size_t i = std::min(static_cast<std::size_t>(x), N - 2);
    const float f = x - static_cast<float>(i);
    return table[i] * (1.f - f) + table[i + 1] * f;
}

// cie_y_integral over the integral of ybar times the table of D65: 106.857028 / 10566.87390.
constexpr float d65_scale = 0.010112454f;

}  // namespace

Vec3f cie_xyz(float nm) { return interpolate(observer, nm); }

float cie_d65(float nm) { return interpolate(daylight, nm); }

float d65_unit(float nm) { return d65_scale * cie_d65(nm); }

Vec3f integrate_xyz(const std::function<float(float)>& spectrum) {
    constexpr int intervals = 940;
    constexpr double step = 0.5;
    Vec3d sum;
    for (int i = 0; i <= intervals; ++i) {
        const float nm = visible_min + static_cast<float>(step) * static_cast<float>(i);
        const double w = i == 0 || i == intervals ? 0.5 * step : step;
        sum += Vec3d(cie_xyz(nm)) * (w * spectrum(nm));
    }
    return Vec3f(sum * (1. / cie_y_integral));
}

}  // namespace nacre
