#include "nacre/measured/klems.h"

#include <numbers>

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180.;

/// Azimuth of a direction as its patches count: light's is turned by half a circle.
double azimuth(const Vec3d& w, bool light) {
    const double s = light ? -1. : 1.;
    return w.x == 0. && w.y == 0. ? 0. : std::atan2(s * w.y, s * w.x);
}

}  // namespace

int KlemsBasis::size() const {
    int n = 0;
    for (const Ring& r : rings) n += r.patches;
    return n;
}

int KlemsBasis::patch_of(const Vec3d& w, bool light) const {
    return patch(std::atan2(std::hypot(w.x, w.y), std::abs(w.z)), azimuth(w, light));
}

Vec3d KlemsBasis::direction(Angles a, bool light, bool above) {
    const double s = std::sin(a.theta) * (light ? -1. : 1.);
    return {s * std::cos(a.phi), s * std::sin(a.phi),
            above ? std::cos(a.theta) : -std::cos(a.theta)};
}

int KlemsBasis::patch(double theta, double phi) const {
    int first = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const int n = rings[i].patches;
        if (theta <= rings[i].upper * degree || i + 1 == rings.size()) {
            const double turns = phi / (2. * pi);
            const int k = int(std::floor((turns - std::floor(turns)) * n + 0.5));
            return first + k % n;
        }
        first += n;
    }
    return 0;
}

KlemsBasis::Angles KlemsBasis::centre(int patch) const {
    for (const Ring& r : rings) {
        if (patch < r.patches)
            return {r.lower == 0. && r.patches == 1 ? 0. : 0.5 * (r.lower + r.upper) * degree,
                    2. * pi * patch / r.patches};
        patch -= r.patches;
    }
    return {0., 0.};
}

KlemsBasis::Angles KlemsBasis::within(int patch, double u, double v) const {
    for (const Ring& r : rings) {
        if (patch < r.patches) {
            const double a = std::sin(r.lower * degree), b = std::sin(r.upper * degree);
            return {std::asin(std::min(std::sqrt(a * a + (b * b - a * a) * u), 1.)),
                    2. * pi * (patch + v - 0.5) / r.patches};
        }
        patch -= r.patches;
    }
    return {0., 0.};
}

double KlemsBasis::projected_solid_angle(int patch) const {
    for (const Ring& r : rings) {
        if (patch < r.patches) {
            const double a = std::sin(r.lower * degree), b = std::sin(r.upper * degree);
            return pi * (b * b - a * a) / r.patches;
        }
        patch -= r.patches;
    }
    return 0.;
}

KlemsMeasured::KlemsMeasured(std::array<KlemsMatrix, 4> matrices, MeasuredInfo info)
    : matrices_(std::move(matrices)) {
    info_ = std::move(info);
    info_.transmission_front = !matrices_[transmission_front].value.empty();
    info_.transmission_back = !matrices_[transmission_back].value.empty();
    info_.reflection_front = !matrices_[reflection_front].value.empty();
    info_.reflection_back = !matrices_[reflection_back].value.empty();
    count_samples();
}

bool KlemsMeasured::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
    if (wi.z == 0. || wo.z == 0.) return false;
    if (!std::isfinite(wi.x + wi.y + wi.z + wo.x + wo.y + wo.z)) return false;
    const bool front = wi.z > 0., through = (wo.z > 0.) != front;
    const KlemsMatrix& m = matrices_[through ? (front ? transmission_front : transmission_back)
                                             : (front ? reflection_front : reflection_back)];
    if (m.value.empty()) return false;
    const int i = m.in.patch_of(wi, true), o = m.out.patch_of(wo, false);
    out[0] = m.value[std::size_t(o) * m.in.size() + i];
    return true;
}

void KlemsMeasured::for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const {
    for (int d = 0; d < 4; ++d) {
        const KlemsMatrix& m = matrices_[d];
        const bool front = d == transmission_front || d == reflection_front;
        const bool exit_front = d == transmission_back || d == reflection_front;
        const int n = m.in.size();
        for (std::size_t k = 0; k < m.value.size(); ++k) {
            const Vec3d wi = KlemsBasis::direction(m.in.centre(int(k) % n), true, front);
            const Vec3d wo = KlemsBasis::direction(m.out.centre(int(k) / n), false, exit_front);
            visit({wi, wo, m.value[k] < 0. ? SampleState::negative : SampleState::good,
                   std::span<const double>(&m.value[k], 1)});
        }
    }
}

}  // namespace nacre
