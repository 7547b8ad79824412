#include "nacre/geometry/transform.h"

#include <cmath>
#include <numbers>

#include "nacre/math/error.h"

namespace nacre {
namespace {

using Matrix = Transform::Matrix;

constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix multiply(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (int row = 0; row < 4; ++row)
        for (int col = 0; col < 4; ++col)
            for (int k = 0; k < 4; ++k) c[row * 4 + col] += a[row * 4 + k] * b[k * 4 + col];
    return c;
}

bool is_affine(const Matrix& m) { return m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1; }

double determinant3(const Matrix& m) {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
           m[2] * (m[4] * m[9] - m[5] * m[8]);
}

// Inverse by Gauss-Jordan elimination with partial pivoting; false if a column has no pivot.
bool invert(Matrix m, Matrix& inverse) {
    inverse = kIdentity;
    for (int col = 0; col < 4; ++col) {
        int pivot = col;
        for (int row = col + 1; row < 4; ++row)
            if (std::abs(m[row * 4 + col]) > std::abs(m[pivot * 4 + col])) pivot = row;
        const double p = m[pivot * 4 + col];
        if (p == 0) return false;
        for (int k = 0; k < 4; ++k) {
            std::swap(m[pivot * 4 + k], m[col * 4 + k]);
            std::swap(inverse[pivot * 4 + k], inverse[col * 4 + k]);
        }
        for (int k = 0; k < 4; ++k) {
            m[col * 4 + k] /= p;
            inverse[col * 4 + k] /= p;
        }
        for (int row = 0; row < 4; ++row) {
            const double f = m[row * 4 + col];
            if (row == col || f == 0) continue;
            for (int k = 0; k < 4; ++k) {
                m[row * 4 + k] -= f * m[col * 4 + k];
                inverse[row * 4 + k] -= f * inverse[col * 4 + k];
            }
        }
    }
    for (double v : inverse)
        if (!std::isfinite(v)) return false;
    return true;
}

// An affine map whose linear part is flat to within rounding is singular too, however large its
// entries are: volume spanned by the rows, relative to the box of their lengths.
bool is_flat(const Matrix& m) {
    double box = 1;
    for (int row = 0; row < 3; ++row) box *= std::hypot(m[row * 4], m[row * 4 + 1], m[row * 4 + 2]);
    return std::abs(determinant3(m)) <= 1e-14 * box;
}

Vec3d unit(const Vec3d& v, const char* what) {
    const double len = length(v);
    if (!(len > 0) || !std::isfinite(len)) throw InputError(what);
    return v / len;
}

}  // namespace

Transform::Transform() : m_(kIdentity), inverse_(kIdentity) {}

Transform::Transform(const Matrix& m) : m_(m) {
    for (double v : m)
        if (!std::isfinite(v))
            throw InputError("transform has a value that is not a finite number; check its matrix");
    if ((is_affine(m) && is_flat(m)) || !invert(m, inverse_))
        throw InputError(
            "transform is singular: it flattens space; give every axis a scale other than zero");
}

Transform Transform::translate(const Vec3d& d) {
    return Transform(Matrix{1, 0, 0, d.x, 0, 1, 0, d.y, 0, 0, 1, d.z, 0, 0, 0, 1});
}

Transform Transform::scale(const Vec3d& s) {
    return Transform(Matrix{s.x, 0, 0, 0, 0, s.y, 0, 0, 0, 0, s.z, 0, 0, 0, 0, 1});
}

Transform Transform::rotate(const Vec3d& axis, double degrees) {
    const Vec3d a = unit(axis, "rotation axis has no length; give a vector other than zero");
    // Multiples of 90 degrees are exact, so that rotated boxes stay axis-aligned.
    const double turns = std::remainder(degrees, 360.0);
    const double angle = turns * std::numbers::pi / 180;
    const bool quarter = std::fmod(turns, 90.0) == 0;
    const double c = quarter ? std::round(std::cos(angle)) : std::cos(angle);
    const double s = quarter ? std::round(std::sin(angle)) : std::sin(angle);
    const double k = 1 - c;
    // Rodrigues' rotation formula.
    return Transform(Matrix{k * a.x * a.x + c, k * a.x * a.y - s * a.z, k * a.x * a.z + s * a.y, 0,
                            k * a.x * a.y + s * a.z, k * a.y * a.y + c, k * a.y * a.z - s * a.x, 0,
                            k * a.x * a.z - s * a.y, k * a.y * a.z + s * a.x, k * a.z * a.z + c, 0,
                            0, 0, 0, 1});
}

Transform Transform::look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up) {
    const Vec3d forward =
        unit(target - origin, "look_at: origin and target coincide; move one of them");
    const Vec3d up_unit = unit(up, "look_at: up has no length; give a vector other than zero");
    const Vec3d across = cross(up_unit, forward);
    if (!(length(across) > 1e-9))
        throw InputError("look_at: up is parallel to the viewing direction; choose another up");
    const Vec3d left = normalize(across);
    const Vec3d top = cross(forward, left);
    return Transform(Matrix{left.x, top.x, forward.x, origin.x, left.y, top.y, forward.y, origin.y,
                            left.z, top.z, forward.z, origin.z, 0, 0, 0, 1});
}

Transform operator*(const Transform& a, const Transform& b) {
    // The inverse is carried along instead of computed again: it keeps long chains accurate.
    return {multiply(a.m_, b.m_), multiply(b.inverse_, a.inverse_)};
}

Transform Transform::inverse() const { return {inverse_, m_}; }

Vec3d Transform::map_point(const Vec3d& p) const {
    const auto row = [&](int r) {
        return m_[r * 4] * p.x + m_[r * 4 + 1] * p.y + m_[r * 4 + 2] * p.z + m_[r * 4 + 3];
    };
    const Vec3d q{row(0), row(1), row(2)};
    const double w = row(3);
    return w == 1 ? q : q / w;
}

Vec3d Transform::map_vector(const Vec3d& v) const {
    return {m_[0] * v.x + m_[1] * v.y + m_[2] * v.z, m_[4] * v.x + m_[5] * v.y + m_[6] * v.z,
            m_[8] * v.x + m_[9] * v.y + m_[10] * v.z};
}

Vec3d Transform::map_normal(const Vec3d& n) const {
    const Matrix& i = inverse_;
    return {i[0] * n.x + i[4] * n.y + i[8] * n.z, i[1] * n.x + i[5] * n.y + i[9] * n.z,
            i[2] * n.x + i[6] * n.y + i[10] * n.z};
}

Point3f Transform::point(const Point3f& p) const { return Point3f(map_point(Vec3d(p))); }
Vec3f Transform::vector(const Vec3f& v) const { return Vec3f(map_vector(Vec3d(v))); }
Vec3f Transform::normal(const Vec3f& n) const { return Vec3f(map_normal(Vec3d(n))); }

bool Transform::swaps_handedness() const { return determinant3(m_) < 0; }
bool Transform::is_identity() const { return m_ == kIdentity; }

}  // namespace nacre
