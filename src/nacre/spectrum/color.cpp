#include "nacre/spectrum/color.h"

#include <cmath>

#include "nacre/spectrum/cie.h"

namespace nacre {

namespace {

// From the chromaticities of the sRGB primaries, red (0.64, 0.33), green (0.30, 0.60), blue (0.15,
// 0.06), and the white (0.312744, 0.329041) of the tables of cie.h: columns are the primaries'
// XYZ, scaled so that they sum to white. tests/spectrum derives both matrices again.
constexpr Vec3d to_xyz[3] = {{0.4124910576433096, 0.3575733319893118, 0.1804065860601123},
                             {0.2126907015973315, 0.7151466639786236, 0.0721626344240449},
                             {0.0193355183270301, 0.1191911106631039, 0.9501413532499245}};
constexpr Vec3d from_xyz[3] = {{3.2401822051005467, -1.5370095075476953, -0.4984895700154688},
                               {-0.9692734730896706, 1.8760252505416528, 0.0415563366214575},
                               {0.0556529606919387, -0.2040608558704418, 1.0574062531468351}};

Vec3f multiply(const Vec3d (&m)[3], Vec3f v) {
    const Vec3d d(v);
    return Vec3f(Vec3d(dot(m[0], d), dot(m[1], d), dot(m[2], d)));
}

}  // namespace

Vec3f xyz_to_rgb(Vec3f xyz) { return multiply(from_xyz, xyz); }
Vec3f rgb_to_xyz(Vec3f rgb) { return multiply(to_xyz, rgb); }
float luminance(Vec3f linear_rgb) { return dot(Vec3f(to_xyz[1]), linear_rgb); }

Vec3f to_rgb(Spectral radiance, const Wavelengths& w) {
    if (w.mode == ColorMode::rgb_bands) return {radiance[0], radiance[1], radiance[2]};
    const Spectral estimate = radiance * w.weight / (w.pdf * cie_y_integral);
    Vec3f xyz;
    for (int i = 0; i < Spectral::size; ++i) xyz += cie_xyz(w.lambda[i]) * estimate[i];
    return xyz_to_rgb(xyz);
}

float srgb_encode(float linear) {
    const float a = std::abs(linear);
    const float e = a <= 0.0031308f ? 12.92f * a : 1.055f * std::pow(a, 1.f / 2.4f) - 0.055f;
    return std::copysign(e, linear);
}

float srgb_decode(float encoded) {
    const float a = std::abs(encoded);
    const float l = a <= 0.04045f ? a / 12.92f : std::pow((a + 0.055f) / 1.055f, 2.4f);
    return std::copysign(l, encoded);
}

}  // namespace nacre
