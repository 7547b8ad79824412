#include "nacre/realtime/profile_radii.h"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

constexpr int columns = 512;
// What is left beyond the farthest radius that is drawn; minus its logarithm is the tables' range.
constexpr double least_share = 1e-5;

/// -ln of the share of one band's light beyond each of `radii`, which rises.
std::vector<double> log_beyond(const BandProfiles& profiles, int band,
                               const std::vector<double>& radii) {
    const double total = profiles.total(band), range = -std::log(least_share);
    std::vector<double> result;
    double last = 0;
    for (const double r : radii) {
        const double share = total > 0 ? 1 - profiles.cumulative(band, r) / total : 1.;
        last = std::clamp(-std::log(std::max(share, least_share)), last, range);
        result.push_back(last);
    }
    return result;
}

/// The radius at which rising `values` reach `value`; from the middle, where they are 0.
double radius_at(const std::vector<double>& radii, const std::vector<double>& values,
                 double value) {
    const std::size_t i = std::size_t(std::ranges::lower_bound(values, value) - values.begin());
    if (i == values.size()) return radii.back();
    const double below = i ? values[i - 1] : 0, from = i ? radii[i - 1] : 0;
    const double t = values[i] > below ? (value - below) / (values[i] - below) : 1;
    return from + t * (radii[i] - from);
}

}  // namespace

ProfileRadii::ProfileRadii(const BandProfiles& profiles) : profile_(profiles.texture()) {
    const double low = profiles.texture_low(), ratio = profiles.texture_high() / low;
    low_ = float(std::log2(low));
    range_ = float(std::log2(ratio));
    std::vector<double> radii;
    for (int i = 0; i < columns; ++i) radii.push_back(low * std::pow(ratio, i / (columns - 1.)));
    std::vector<float> table(std::size_t(8 * columns), 0.f);
    double farthest = 0;
    for (int b = 0; b < 3; ++b) {
        totals_[b] = float(profiles.total(b));
        const std::vector<double> beyond = log_beyond(profiles, b, radii);
        const double range = -std::log(least_share);
        for (int i = 0; i < columns; ++i) {
            table[std::size_t(4 * i + b)] = float(beyond[std::size_t(i)]);
            // In the root of the logarithm the radius is nearly straight, near the middle and far.
            const double q = i / (columns - 1.);
            table[std::size_t(4 * (columns + i) + b)] =
                i ? float(radius_at(radii, beyond, q * q * range)) : 0.f;
        }
        if (!(totals_[b] > 0.f)) continue;
        deepest_ = std::max(deepest_, float(radius_at(radii, beyond, -std::log(1e-3))));
        const double half = radius_at(radii, beyond, std::log(2.));
        if (half > farthest) {
            farthest = half;
            widest_ = b;
        }
    }
    radii_ = Texture(TexelFormat::rgba32f, columns, 2);
    radii_.upload(table);
}

void ProfileRadii::bind(ComputePass& pass, int profile_unit, int radii_unit) const {
    pass.reads(profile_unit, profile_)
        .reads(radii_unit, radii_)
        .set("profile_low", low_)
        .set("profile_range", range_)
        .set("radii_range", float(-std::log(least_share)))
        .set("totals", totals_);
}

}  // namespace nacre
