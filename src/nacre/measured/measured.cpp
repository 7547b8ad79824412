#include "nacre/measured/measured.h"

#include <numbers>

#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"

namespace nacre {
namespace {

/// The share of each wavelength in the piecewise linear spectrum at `nm`.
template <class F>
void shares(const std::vector<double>& wavelengths, double nm, F&& add) {
    const auto above = std::upper_bound(wavelengths.begin(), wavelengths.end(), nm);
    const std::size_t i = std::size_t(above - wavelengths.begin());
    if (i == 0) return add(std::size_t{0}, 1.);
    if (i == wavelengths.size()) return add(i - 1, 1.);
    const double t = (nm - wavelengths[i - 1]) / (wavelengths[i] - wavelengths[i - 1]);
    add(i - 1, 1. - t);
    add(i, t);
}

}  // namespace

void Measured::count_samples() {
    info_.samples = info_.missing = info_.negative = 0;
    double incidence = 1., exit = 1.;
    for_each_sample([&](const MeasuredSample& s) {
        ++info_.samples;
        info_.missing += s.state == SampleState::missing;
        info_.negative += s.state == SampleState::negative;
        if (s.state != SampleState::good) return;
        incidence = std::min(incidence, std::abs(s.wi.z));
        exit = std::min(exit, std::abs(s.wo.z));
    });
    info_.largest_incidence = std::acos(std::min(incidence, 1.)) * 180. / std::numbers::pi;
    info_.largest_exit = std::acos(std::min(exit, 1.)) * 180. / std::numbers::pi;
}

bool Measured::eval_float(const Vec3f& wi, const Vec3f& wo, std::span<float> out) const {
    double channels[max_measured_channels];
    const std::span<double> values(channels, std::size_t(info_.channels));
    if (!eval(Vec3d(wi), Vec3d(wo), values)) return false;
    std::copy(values.begin(), values.end(), out.begin());
    return true;
}

void Measured::eval_many(std::span<const Vec3d> wi, std::span<const Vec3d> wo,
                         std::span<double> out, std::span<bool> known) const {
    const std::size_t n = std::size_t(info_.channels);
    for (std::size_t i = 0; i < wi.size(); ++i)
        known[i] = eval(wi[i], wo[i], out.subspan(i * n, n));
}

void Measured::eval_float_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo,
                               std::span<float> out, std::span<bool> known) const {
    const std::size_t n = std::size_t(info_.channels);
    for (std::size_t i = 0; i < wi.size(); ++i)
        known[i] = eval_float(wi[i], wo[i], out.subspan(i * n, n));
}

ChannelColours::ChannelColours(const MeasuredInfo& info) {
    if (info.wavelengths.size() < 2) {
        if (info.channels == 1) weight_.assign(1, Vec3d(1., 1., 1.));
        return;
    }
    weight_.resize(info.wavelengths.size());
    // Steps of half a nanometre over the visible range, as the tables are used everywhere.
    for (int step = 0; step <= 940; ++step) {
        const double nm = 360. + 0.5 * step;
        const Vec3f xyz = cie_xyz(float(nm)) * d65_unit(float(nm));
        const Vec3d part(xyz_to_rgb(xyz));
        const double width = step == 0 || step == 940 ? 0.25 : 0.5;
        shares(info.wavelengths, nm,
               [&](std::size_t i, double share) { weight_[i] += (share * width) * part; });
    }
    Vec3d white;
    for (const Vec3d& w : weight_) white += w;
    for (Vec3d& w : weight_)
        for (int c = 0; c < 3; ++c) w[c] /= white[c];
}

Vec3d ChannelColours::operator()(std::span<const double> channels) const {
    if (weight_.empty()) return {channels[0], channels[1], channels[2]};
    Vec3d sum;
    for (std::size_t i = 0; i < weight_.size(); ++i) sum += channels[i] * weight_[i];
    return sum;
}

}  // namespace nacre
