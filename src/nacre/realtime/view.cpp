#include "nacre/realtime/view.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/math/frame.h"

namespace nacre {
namespace {

using Rows = std::array<Vec3d, 3>;

/// Rows of the inverse of the matrix with these columns.
Rows inverse_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double det = dot(a, cross(b, c));
    const double s = 1. / det;
    return {cross(b, c) * s, cross(c, a) * s, cross(a, b) * s};
}

/// Clip coordinates from rows that give u w, v w (in [0, 1] over the picture), z and w of p - o.
Mat4 to_clip(const Rows& uvw, const Vec3d& o, const std::array<double, 4>& z_row, bool parallel) {
    // Each row as (x, y, z, constant) of p.
    const auto row = [&](const Vec3d& r, double extra) {
        return std::array<double, 4>{r.x, r.y, r.z, extra - dot(r, o)};
    };
    const auto u = row(uvw[0], 0), v = row(uvw[1], 0);
    const auto w = parallel ? std::array<double, 4>{0, 0, 0, 1} : row(uvw[2], 0);
    Mat4 m{};
    for (std::size_t i = 0; i < 4; ++i) {
        m[4 * i + 0] = float(2 * u[i] - w[i]);
        m[4 * i + 1] = float(2 * v[i] - w[i]);
        m[4 * i + 2] = float(z_row[i]);
        m[4 * i + 3] = float(w[i]);
    }
    return m;
}

/// Depth of parallel views: 1 at `near` along `d` from `o`, 0 at `far`.
std::array<double, 4> parallel_depth(const Vec3d& d, const Vec3d& o, double near, double far) {
    const Vec3d r = d * (-1. / (far - near));
    return {r.x, r.y, r.z, (far + dot(d, o)) / (far - near)};
}

/// The span of t = (p - o).d over a box.
std::pair<double, double> span_along(const Vec3d& d, const Vec3d& o, const Box3f& box) {
    double low = 1e300, high = -1e300;
    for (int i = 0; i < 8; ++i) {
        const Vec3d p(i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                      i & 4 ? box.upper.z : box.lower.z);
        low = std::min(low, dot(p - o, d));
        high = std::max(high, dot(p - o, d));
    }
    return {low, high};
}

}  // namespace

View camera_view(const Camera& camera, const FilmSettings& film, Vec2f shift, const Box3f& bounds) {
    const int width = film.crop_width ? film.crop_width : film.width,
              height = film.crop_width ? film.crop_height : film.height;
    // The corners of the picture on the whole film.
    const auto at = [&](double u, double v) {
        return camera.ray({float((film.crop_x + shift.x + u * width) / film.width),
                           float((film.crop_y + shift.y + v * height) / film.height)},
                          {0.5f, 0.5f});
    };
    const Ray corner = at(0, 0), right = at(1, 0), down = at(0, 1), far = at(1, 1);
    const Vec3d d00(corner.d), d10(right.d), d01(down.d), d11(far.d);
    const Vec3d o(corner.o);
    View view{.width = width, .height = height};
    view.parallel = length(d10 - d00) + length(d01 - d00) < 1e-6;
    const double size = double(length(bounds.diagonal()));
    if (view.parallel) {
        const Vec3d x = Vec3d(right.o) - o, y = Vec3d(down.o) - o;
        const auto [low, high] = span_along(d00, o, bounds);
        const double near = std::max(low, double(corner.tmin)) - 1e-3 * size;
        view.eye = corner.d;
        view.pixel = float(length(x) / width);
        const double end = high + 1e-3 * size;
        view.depth_range = float(end - near);
        view.clip = to_clip(inverse_of(x, y, d00), o, parallel_depth(d00, o, near, end), true);
    } else {
        // Directions a d00, b d10, c d01 so long that their ends span the picture: the fourth
        // corner says how long.
        const Rows inverse = inverse_of(d00, d10, d01);
        const double a = -dot(inverse[0], d11), b = dot(inverse[1], d11), c = dot(inverse[2], d11);
        const Vec3d base = d00 * a, x = d10 * b - base, y = d01 * c - base;
        const Vec3d forward = cross(x, y) * (1. / length(cross(x, y)));
        const double depth = dot(base, forward);  // w is the distance along `forward`
        Rows rows = inverse_of(x, y, base);
        for (Vec3d& r : rows) r *= depth;
        const double near =
            std::max(double(corner.tmin) * std::abs(dot(d00, forward)), 1e-5 * size);
        view.eye = corner.o;
        view.pixel = float(length(x) / std::abs(depth) / width);
        view.depth_range = float(near);
        view.clip = to_clip(rows, o, {0, 0, 0, near}, false);
    }
    // What the matrix says of other rays.
    for (const auto& [u, v] : {std::pair{0.31, 0.77}, {0.83, 0.12}, {0.5, 0.5}}) {
        const Ray ray = at(u, v);
        const Vec3d p = Vec3d(ray.o) + Vec3d(ray.d) * std::max(size, 1.);
        double c[4];
        for (std::size_t k = 0; k < 4; ++k)
            c[k] = view.clip[k] * p.x + view.clip[4 + k] * p.y + view.clip[8 + k] * p.z +
                   view.clip[12 + k];
        if (!(std::abs(c[0] / c[3] - (2 * u - 1)) < 2e-3 &&
              std::abs(c[1] / c[3] - (2 * v - 1)) < 2e-3))
            throw InputError(
                "frames in real time take perspective and orthographic cameras only; use one of "
                "these, or an offline technique");
    }
    return view;
}

View light_view(const Point3f& position, const Point3f& center, float radius, int size) {
    const Vec3d o(position), to = Vec3d(center) - o;
    const double distance = length(to);
    constexpr double widest = 0.9962;  // sine of 85 degrees
    if (!(radius < widest * distance))
        throw InputError(fmt::format(
            "a light at ({:g}, {:g}, {:g}) is too near to an object, which fills more than 170 "
            "degrees from there: move it away, or use an offline technique",
            position.x, position.y, position.z));
    const double sine = radius / distance, tangent = sine / std::sqrt(1 - sine * sine);
    const Vec3d forward = to * (1 / distance);
    const Frame<double> frame = Frame<double>::around(forward);
    const Rows rows{frame.s * (0.5 / tangent) + forward * 0.5,
                    frame.t * (0.5 / tangent) + forward * 0.5, forward};
    View view{.eye = position, .width = size, .height = size};
    view.pixel = float(2 * tangent / size);
    view.depth_range = float(1e-3 * distance);
    view.clip = to_clip(rows, o, {0, 0, 0, 1e-3 * distance}, false);
    return view;
}

View parallel_view(const Vec3f& to_light, const Point3f& center, float radius, int size) {
    const Vec3d forward = Vec3d(to_light) * -1., c(center);
    const Frame<double> frame = Frame<double>::around(forward);
    const double r = radius;
    const Vec3d o = c - (frame.s + frame.t) * r;  // the corner of the picture, at the ball's middle
    View view{.eye = -to_light, .parallel = true, .width = size, .height = size};
    view.pixel = 2 * radius / float(size);
    // Occluders may stand before the ball, however far: depth runs over a hundred radii.
    view.depth_range = float(101.01 * r);
    view.clip = to_clip({frame.s * (0.5 / r), frame.t * (0.5 / r), forward}, o,
                        parallel_depth(forward, c, -100 * r, 1.01 * r), true);
    return view;
}

}  // namespace nacre
