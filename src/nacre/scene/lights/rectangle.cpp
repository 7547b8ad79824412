#include "nacre/scene/lights/rectangle.h"

#include <numbers>

namespace nacre {

std::optional<Rectangle> as_rectangle(const Mesh& mesh) {
    if (mesh.triangles.size() != 2) return {};
    Vec3d t[2][3];
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 3; ++j) t[i][j] = Vec3d(mesh.positions[mesh.triangles[i][j]]);

    for (int i = 0; i < 3; ++i) {
        const Vec3d &corner = t[0][i], &a = t[0][(i + 1) % 3], &b = t[0][(i + 2) % 3];
        const Vec3d x = a - corner, y = b - corner;
        const double width = length(x), height = length(y);
        const double tolerance = 1e-5 * std::max(width, height);
        if (!(std::min(width, height) > 0.0)) return {};
        if (std::abs(dot(x, y)) > 1e-5 * width * height) continue;
        // The other triangle must consist of a, b and the corner that completes the rectangle.
        const Vec3d corners[3] = {a, b, a + y};
        int found = 0;
        for (const Vec3d& wanted : corners)
            for (const Vec3d& p : t[1])
                if (length(p - wanted) <= tolerance) {
                    ++found;
                    break;
                }
        if (found == 3) return Rectangle{corner, x / width, y / height, width, height};
    }
    return {};
}

SphericalRectangle::SphericalRectangle(const Rectangle& r, const Vec3d& from)
    : x_(r.x_axis), y_(r.y_axis), z_(cross(r.x_axis, r.y_axis)) {
    const Vec3d d = r.corner - from;
    z0_ = dot(d, z_);
    if (z0_ > 0.0) {
        z_ = -z_;
        z0_ = -z0_;
    }
    x0_ = dot(d, x_);
    y0_ = dot(d, y_);
    x1_ = x0_ + r.width;
    y1_ = y0_ + r.height;
    if (z0_ == 0.0) {
        b0_ = b1_ = k_ = solid_angle_ = 0.0;
        return;
    }
    // The four planes through the point and an edge have normals whose z components follow in
    // closed form; the inner angles of the spherical quadrilateral are acos of minus their
    // products.
    const double n0 = -y0_ / std::hypot(y0_, z0_), n1 = x1_ / std::hypot(x1_, z0_);
    const double n2 = y1_ / std::hypot(y1_, z0_), n3 = -x0_ / std::hypot(x0_, z0_);
    b0_ = n0;
    b1_ = n2;
    const double g2 = std::acos(-n2 * n3), g3 = std::acos(-n3 * n0);
    k_ = 2.0 * std::numbers::pi - g2 - g3;
    // Girard's excess, written with asin so that small solid angles keep their digits.
    solid_angle_ =
        std::asin(n0 * n1) + std::asin(n1 * n2) + std::asin(n2 * n3) + std::asin(n3 * n0);
}

Vec3d SphericalRectangle::sample(Vec2f u) const {
    // Equation numbers are those of the paper's section 4: the first number chooses a strip of
    // constant x, the second a point along it.
    const double angle = u.x * solid_angle_ + k_;
    const double f = (std::cos(angle) * b0_ - b1_) / std::sin(angle);
    const double c = std::clamp(std::copysign(1.0, f) / std::sqrt(f * f + b0_ * b0_), -1.0, 1.0);
    const double s = std::sqrt(std::max(0.0, 1.0 - c * c));
    const double x = s > 1e-12 ? std::clamp(-c * z0_ / s, x0_, x1_) : (c > 0 ? x1_ : x0_);

    const double d2 = x * x + z0_ * z0_;
    const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    const double h = h0 + u.y * (h1 - h0);
    const double cos2 = 1.0 - h * h;
    const double y =
        cos2 > 0.0 ? std::clamp(h * std::sqrt(d2 / cos2), y0_, y1_) : (h > 0 ? y1_ : y0_);
    return x_ * x + y_ * y + z_ * z0_;
}

}  // namespace nacre
