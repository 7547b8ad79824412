#include "nacre/geometry/analytic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "nacre/math/error.h"

namespace nacre {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
// Steps in azimuth of the area of a cylinder that is not round. The midpoint rule converges
// geometrically for smooth periodic integrands, so this is exact to rounding for any sane ellipse.
constexpr int kAzimuthSteps = 1024;

float to_turn(double y, double x) {
    const double turn = std::atan2(y, x) / kTwoPi;
    const auto t = static_cast<float>(turn < 0 ? turn + 1 : turn);
    return t < 1.f ? t : 0.f;
}

// Minimum of f on [a, b], where it has one minimum, by golden-section search.
template <class F>
double minimize(F f, double a, double b) {
    constexpr double kGolden = 0.6180339887498949;
    double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
    double fc = f(c), fd = f(d);
    // 0.618^48 < 1e-10 of the bracket; squared distances are flat below 1e-8 anyway.
    for (int i = 0; i < 48; ++i) {
        if (fc < fd) {
            b = d, d = c, fd = fc;
            c = b - kGolden * (b - a), fc = f(c);
        } else {
            a = c, c = d, fc = fd;
            d = a + kGolden * (b - a), fd = f(d);
        }
    }
    return (a + b) / 2;
}

// Azimuth of the minimum of the periodic f: samples bracket its local minima, each is refined and
// the lowest wins. An ellipse has two, an oblique cylinder with its clamped ends a few.
template <class F>
double minimize_over_azimuth(F f) {
    constexpr int kSamples = 96;
    constexpr double kStep = kTwoPi / kSamples;
    std::array<double, kSamples> values;
    for (int i = 0; i < kSamples; ++i) values[i] = f(i * kStep);
    double best = 0, lowest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kSamples; ++i) {
        if (values[i] > values[(i + 1) % kSamples]) continue;
        if (values[i] > values[(i + kSamples - 1) % kSamples]) continue;
        const double azimuth = minimize(f, (i - 1) * kStep, (i + 1) * kStep);
        if (const double v = f(azimuth); v < lowest) lowest = v, best = azimuth;
    }
    return best;
}

}  // namespace

AnalyticShape::AnalyticShape(const Primitive& primitive) {
    if (const auto* sphere = std::get_if<Sphere>(&primitive)) {
        kind_ = Kind::Sphere;
        flip_ = sphere->flip_normals;
        o_ = Vec3d(sphere->center);
        radius_ = sphere->radius;
        if (!(radius_ > 0) || !std::isfinite(radius_))
            throw InputError("sphere radius is not a positive number; give a radius above zero");
        if (!std::isfinite(o_.x + o_.y + o_.z))
            throw InputError("sphere centre is not finite; give three finite numbers");
        x_ = sphere->x, y_ = sphere->y, z_ = sphere->z;
        size_ = 2 * radius_;
        area_ = 4 * std::numbers::pi * radius_ * radius_;
        return;
    }
    if (const auto* disk = std::get_if<Disk>(&primitive)) {
        kind_ = Kind::Disk;
        flip_ = disk->flip_normals;
        to_world_ = disk->to_world;
    } else {
        const auto& cylinder = std::get<Cylinder>(primitive);
        kind_ = Kind::Cylinder;
        flip_ = cylinder.flip_normals;
        to_world_ = cylinder.to_world;
    }
    to_local_ = to_world_.inverse();
    o_ = to_world_.map_point({0, 0, 0});
    x_ = to_world_.map_vector({1, 0, 0});
    y_ = to_world_.map_vector({0, 1, 0});
    z_ = to_world_.map_vector({0, 0, 1});
    const double xx = dot(x_, x_), yy = dot(y_, y_), zz = dot(z_, z_);
    const double tolerance = 1e-12 * std::max({xx, yy, zz});
    // Round and upright is all that the closed forms need; the length along z is free.
    similarity_ = std::abs(xx - yy) <= tolerance && std::abs(dot(x_, y_)) <= tolerance &&
                  std::abs(dot(x_, z_)) <= tolerance && std::abs(dot(y_, z_)) <= tolerance;
    radius_ = std::sqrt(xx);
    if (kind_ == Kind::Disk) {
        size_ = 2 * std::sqrt(std::max(xx, yy));
        area_ = std::numbers::pi * length(cross(x_, y_));
        return;
    }
    size_ = 2 * std::sqrt(std::max(xx, yy)) + std::sqrt(zz);
    if (similarity_) {
        area_ = kTwoPi * radius_ * std::sqrt(zz);
        return;
    }
    steps_.reserve(kAzimuthSteps + 1);
    steps_.push_back(0);
    for (int i = 0; i < kAzimuthSteps; ++i) {
        const double width = kTwoPi / kAzimuthSteps;
        steps_.push_back(steps_.back() + width * stretch((i + 0.5) * width));
    }
    area_ = steps_.back();
}

// Area per unit of azimuth of a cylinder.
double AnalyticShape::stretch(double azimuth) const {
    return length(cross(y_ * std::cos(azimuth) - x_ * std::sin(azimuth), z_));
}

bool AnalyticShape::crosses_sphere(const Vec3d& o, const Vec3d& d, double tmin, double tmax,
                                   AnalyticHit& hit) const {
    // Discriminant from the perpendicular distance of the centre, and the roots through the larger
    // of them, so that neither cancels (Haines, Guenther, Akenine-Moeller 2019, Precision
    // Improvements for Ray/Sphere Intersection, Ray Tracing Gems ch. 7).
    const Vec3d f = o - o_;
    const double a = dot(d, d), b = -dot(f, d);
    const double discriminant = radius_ * radius_ - length_squared(f + d * (b / a));
    if (discriminant < 0) return false;
    const double q = b + std::copysign(std::sqrt(a * discriminant), b);
    const double c = dot(f, f) - radius_ * radius_;
    if (q == 0) return false;
    double near = c / q, far = q / a;
    if (near > far) std::swap(near, far);
    const double t = near > tmin ? near : far;
    if (!(t > tmin && t <= tmax)) return false;
    hit = on_sphere(t, f + d * t);
    return true;
}

AnalyticHit AnalyticShape::on_sphere(double t, const Vec3d& from_center) const {
    const Vec3d n = from_center / radius_;
    const double x = dot(n, x_), y = dot(n, y_), z = dot(n, z_);
    const double polar = std::atan2(std::hypot(x, y), z);
    return {t, to_turn(y, x), static_cast<float>(polar / std::numbers::pi)};
}

bool AnalyticShape::intersect(const Vec3d& world_o, const Vec3d& world_d, double tmin, double tmax,
                              AnalyticHit& hit) const {
    if (kind_ == Kind::Sphere) return crosses_sphere(world_o, world_d, tmin, tmax, hit);
    const Vec3d o = to_local_.map_point(world_o), d = to_local_.map_vector(world_d);
    if (kind_ == Kind::Disk) {
        if (d.z == 0) return false;
        const double t = -o.z / d.z;
        const double x = o.x + t * d.x, y = o.y + t * d.y;
        if (!(t > tmin && t <= tmax) || x * x + y * y > 1) return false;
        hit = {t, static_cast<float>(x), static_cast<float>(y)};
        return true;
    }
    const double a = d.x * d.x + d.y * d.y, b = -(o.x * d.x + o.y * d.y);
    if (a == 0) return false;
    const double fx = o.x + d.x * b / a, fy = o.y + d.y * b / a;
    const double discriminant = 1 - (fx * fx + fy * fy);
    if (discriminant < 0) return false;
    const double q = b + std::copysign(std::sqrt(a * discriminant), b);
    if (q == 0) return false;
    double near = (o.x * o.x + o.y * o.y - 1) / q, far = q / a;
    if (near > far) std::swap(near, far);
    for (const double t : {near, far}) {
        const double z = o.z + t * d.z;
        if (!(t > tmin && t <= tmax) || z < 0 || z > 1) continue;
        hit = {t, to_turn(o.y + t * d.y, o.x + t * d.x), static_cast<float>(z)};
        return true;
    }
    return false;
}

AnalyticHit AnalyticShape::closest(const Vec3d& p) const {
    if (kind_ == Kind::Disk) return closest_on_disk(p);
    if (kind_ == Kind::Cylinder) return closest_on_cylinder(p);
    const Vec3d f = p - o_;
    return on_sphere(std::abs(length(f) - radius_), f);
}

AnalyticHit AnalyticShape::closest_on_disk(const Vec3d& p) const {
    // Foot of the perpendicular on the plane, in the disk's own (oblique) axes.
    const Vec3d f = p - o_;
    const double xx = dot(x_, x_), xy = dot(x_, y_), yy = dot(y_, y_);
    const double fx = dot(f, x_), fy = dot(f, y_), det = xx * yy - xy * xy;
    double x = (fx * yy - fy * xy) / det, y = (fy * xx - fx * xy) / det;
    if (const double r = std::hypot(x, y); r > 1) {
        if (similarity_) {
            x /= r, y /= r;
        } else {
            const double azimuth = minimize_over_azimuth([&](double phi) {
                return length_squared(f - x_ * std::cos(phi) - y_ * std::sin(phi));
            });
            x = std::cos(azimuth), y = std::sin(azimuth);
        }
    }
    return {length(p - local(x, y, 0)), static_cast<float>(x), static_cast<float>(y)};
}

AnalyticHit AnalyticShape::closest_on_cylinder(const Vec3d& p) const {
    const Vec3d f = p - o_;
    const double zz = dot(z_, z_);
    // For a given azimuth the nearest point of the straight line along z is a clamped projection.
    const auto height = [&](const Vec3d& g) { return std::clamp(dot(g, z_) / zz, 0.0, 1.0); };
    const auto rest = [&](double phi) { return f - x_ * std::cos(phi) - y_ * std::sin(phi); };
    const double azimuth =
        similarity_ ? std::atan2(dot(f, y_), dot(f, x_)) : minimize_over_azimuth([&](double phi) {
            const Vec3d g = rest(phi);
            return length_squared(g - z_ * height(g));
        });
    const Vec3d g = rest(azimuth);
    const double z = height(g);
    return {length(g - z_ * z), to_turn(std::sin(azimuth), std::cos(azimuth)),
            static_cast<float>(z)};
}

AnalyticPoint AnalyticShape::at(float u, float v) const {
    AnalyticPoint point;
    point.uv = {u, v};
    if (kind_ == Kind::Sphere) {
        const double phi = u * kTwoPi, theta = v * std::numbers::pi, s = std::sin(theta);
        point.n = x_ * (s * std::cos(phi)) + y_ * (s * std::sin(phi)) + z_ * std::cos(theta);
        point.p = o_ + point.n * radius_;
        // At the poles the derivative is zero; its direction still has a limit.
        point.dpdu = (y_ * std::cos(phi) - x_ * std::sin(phi)) * (kTwoPi * radius_);
    } else if (kind_ == Kind::Disk) {
        const double r = std::hypot(u, v);
        point.p = local(u, v, 0);
        point.n = normalize(to_world_.map_normal({0, 0, 1}));
        point.dpdu = r > 0 ? x_ * (u / r) + y_ * (v / r) : x_;
        point.uv = {static_cast<float>(r), to_turn(v, u)};
    } else {
        const double phi = u * kTwoPi, c = std::cos(phi), s = std::sin(phi);
        point.p = local(c, s, v);
        point.n = normalize(to_world_.map_normal({c, s, 0}));
        point.dpdu = (y_ * c - x_ * s) * kTwoPi;
    }
    if (flip_) point.n = -point.n;
    return point;
}

Box3f AnalyticShape::bounds() const {
    Vec3d lower, upper;
    for (std::size_t i = 0; i < 3; ++i) {
        const double r = kind_ == Kind::Sphere ? radius_ : std::hypot(x_[i], y_[i]);
        const double z = kind_ == Kind::Cylinder ? z_[i] : 0;
        // Two roundings to float, outwards, and a hair for the rounding of the sums in double.
        const double lo = o_[i] + std::min(z, 0.0) - r, hi = o_[i] + std::max(z, 0.0) + r;
        lower[i] = lo - 0x1p-22 * std::abs(lo) - 0x1p-30 * size_;
        upper[i] = hi + 0x1p-22 * std::abs(hi) + 0x1p-30 * size_;
    }
    return {Point3f(lower), Point3f(upper)};
}

AnalyticHit AnalyticShape::sample(Vec2f u, double& pdf) const {
    pdf = 1 / area_;
    if (kind_ == Kind::Sphere)
        return {0, u.x, static_cast<float>(std::acos(1 - 2.0 * u.y) / std::numbers::pi)};
    if (kind_ == Kind::Disk) {
        const double r = std::sqrt(static_cast<double>(u.x)), phi = kTwoPi * u.y;
        return {0, static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi))};
    }
    if (steps_.empty()) return {0, u.x, u.y};
    const double target = u.x * area_;
    const auto above = std::upper_bound(steps_.begin() + 1, steps_.end() - 1, target);
    const auto step = static_cast<double>(above - steps_.begin() - 1);
    const double share = (target - *(above - 1)) / (*above - *(above - 1));
    const double turn = (step + share) / kAzimuthSteps;
    // The density is uniform in azimuth within a step, so its value by area is not exactly 1/area.
    pdf *= (*above - *(above - 1)) * kAzimuthSteps / kTwoPi / stretch(turn * kTwoPi);
    return {0, std::min(static_cast<float>(turn), 0x1.fffffep-1f), u.y};
}

}  // namespace nacre
