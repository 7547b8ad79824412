#pragma once
// Bins of directions, equal steps of polar angle and azimuth, above a surface and below it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "nacre/math/vec.h"

namespace nacre {

/// A cell of directions by polar angle and azimuth, radians; of no extent: one direction.
struct DirectionCell {
    double theta_low = 0., theta_high = 0., phi_low = 0., phi_high = 0.;

    friend bool operator==(const DirectionCell&, const DirectionCell&) = default;
    static DirectionCell at(double theta, double phi) { return {theta, theta, phi, phi}; }
    double theta() const { return 0.5 * (theta_low + theta_high); }
    double phi() const { return 0.5 * (phi_low + phi_high); }
    /// Integral of the cosine over the cell's solid angle.
    double projected_solid_angle() const {
        return 0.5 * (phi_high - phi_low) * std::sin(theta_high - theta_low) *
               std::sin(theta_high + theta_low);
    }
    /// A direction of it with a density proportional to the cosine, above the surface.
    Vec3d draw(double u, double v) const {
        const double low = std::sin(theta_low) * std::sin(theta_low),
                     high = std::sin(theta_high) * std::sin(theta_high);
        const double s2 = low + (high - low) * u, phi = phi_low + (phi_high - phi_low) * v;
        const double s = std::sqrt(s2);
        const double z = theta_low == theta_high ? std::cos(theta_low) : std::sqrt(1. - s2);
        return {s * std::cos(phi), s * std::sin(phi), z};
    }
};

/// `polar` steps from the normal to the horizon, each cut into `around` steps of azimuth from 0.
struct HemisphereBins {
    int polar = 18, around = 36;

    std::size_t size() const { return std::size_t(polar) * std::size_t(around); }
    /// Of a direction of either side, as if it were above the surface.
    std::size_t index(const Vec3d& w) const {
        const double theta = std::atan2(std::hypot(w.x, w.y), std::abs(w.z));
        double phi = std::atan2(w.y, w.x);
        if (phi < 0.) phi += 2. * std::numbers::pi;
        const int t = std::clamp(int(theta * polar * 2. / std::numbers::pi), 0, polar - 1);
        const int p = std::clamp(int(phi * around * 0.5 / std::numbers::pi), 0, around - 1);
        return std::size_t(t) * std::size_t(around) + std::size_t(p);
    }
    DirectionCell cell(std::size_t i) const {
        const double dt = 0.5 * std::numbers::pi / polar, dp = 2. * std::numbers::pi / around;
        const double t = double(i / std::size_t(around)), p = double(i % std::size_t(around));
        return {t * dt, (t + 1.) * dt, p * dp, (p + 1.) * dp};
    }
};

}  // namespace nacre
