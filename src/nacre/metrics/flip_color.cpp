#include "nacre/metrics/flip_color.h"

#include <algorithm>
#include <cmath>

namespace nacre::flip_steps {

namespace {

struct Matrix {
    Vec3d rows[3];
    constexpr Vec3d operator*(const Vec3d& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
};

constexpr Matrix inverse(const Matrix& m) {
    const Vec3d &a = m.rows[0], &b = m.rows[1], &c = m.rows[2];
    // The columns of the inverse are cross products of rows over the determinant.
    const Vec3d x = cross(b, c), y = cross(c, a), z = cross(a, b);
    const double d = dot(a, x);
    return {{Vec3d(x.x, y.x, z.x) / d, Vec3d(x.y, y.y, z.y) / d, Vec3d(x.z, y.z, z.z) / d}};
}

constexpr Vec3d of_chromaticity(double x, double y) { return {x / y, 1., (1. - x - y) / y}; }

// RGB to XYZ relative to white: the primaries' XYZ, scaled so that they sum to white, over white.
// Not spectrum/color.h's matrix, whose white is that of the D65 table, 3e-4 away.
constexpr Matrix rgb_to_relative_xyz() {
    const Vec3d red = of_chromaticity(0.64, 0.33), green = of_chromaticity(0.30, 0.60),
                blue = of_chromaticity(0.15, 0.06), white = of_chromaticity(0.3127, 0.3290);
    Matrix m{{{red.x, green.x, blue.x}, {red.y, green.y, blue.y}, {red.z, green.z, blue.z}}};
    const Vec3d scale = inverse(m) * white;
    for (int i = 0; i < 3; ++i) m.rows[i] = m.rows[i] * scale / white[i];
    return m;
}

constexpr Matrix to_xyz = rgb_to_relative_xyz();
constexpr Matrix from_xyz = inverse(to_xyz);

// The cube root of CIELab with its linear toe (CIE 15:2004, 8.2.1).
float lab_curve(double t) {
    constexpr double toe = 6. / 29.;
    return float(t > toe * toe * toe ? std::cbrt(float(t)) : t / (3. * toe * toe) + 4. / 29.);
}

Vec3f opponent(float x, float y, float z) {
    return {116.f * y - 16.f, 500.f * (x - y), 200.f * (y - z)};
}

}  // namespace

Vec3f to_ycxcz(Vec3f rgb) {
    const Vec3d xyz = to_xyz * Vec3d(rgb);
    return opponent(float(xyz.x), float(xyz.y), float(xyz.z));
}

Vec3f from_ycxcz(Vec3f c) {
    const double y = (double(c.x) + 16.) / 116.;
    return Vec3f(from_xyz * Vec3d(y + double(c.y) / 500., y, y - double(c.z) / 200.));
}

Vec3f hunt_lab(Vec3f rgb) {
    const Vec3d xyz = to_xyz * Vec3d(rgb);
    const Vec3f lab = opponent(lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z));
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

float hyab(Vec3f a, Vec3f b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

float largest_distance_power() {
    static const float value =
        std::pow(hyab(hunt_lab({0.f, 1.f, 0.f}), hunt_lab({0.f, 0.f, 1.f})), color_exponent);
    return value;
}

float redistribute(float power) {
    constexpr float p_c = 0.4f, p_t = 0.95f;
    const float c_max = largest_distance_power(), knee = p_c * c_max;
    const float error =
        power < knee ? p_t / knee * power : p_t + (power - knee) / (c_max - knee) * (1.f - p_t);
    return std::min(error, 1.f);
}

}  // namespace nacre::flip_steps
