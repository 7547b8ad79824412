#include "nacre/realtime/band_profiles.h"

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/render/profile_tables.h"
#include "nacre/technique/rough_half_space.h"

namespace nacre {
namespace {
constexpr int texture_width = 512;
}

BandProfiles::BandProfiles(const RealtimeInput& in) {
    const std::vector<ProfileMedium> media =
        medium_in_bands(in.medium(), in.boundary.eta(), Bands(ColorMode::rgb_bands));
    const std::vector<double> rough = rough_return(in.boundary, media, in.work);
    for (std::size_t b = 0; b < 3; ++b) {
        media_[b] = media[b];
        const auto profile = make_profile(in.profile, media[b]);
        tables_.emplace_back(*profile);
        if (!rough.empty()) factors_[b] = rough[b];
        totals_[b] = factors_[b] * profile->total();
        scale_ = std::max(scale_, profile->scale());
    }
    // All but a thousandth of the mean.
    reach_ = radius_of(0.999);
}

double BandProfiles::radius_of(double share) const {
    double total = 0;
    for (int b = 0; b < 3; ++b) total += this->total(b);
    const auto within = [&](double r) {
        double sum = 0;
        for (int b = 0; b < 3; ++b) sum += cumulative(b, r);
        return sum;
    };
    double low = 1e-4 * scale_, high = 1e6 * scale_;
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(low * high);
        (within(middle) < share * total ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

Texture BandProfiles::texture() const {
    std::vector<float> texels;
    const double ratio = texture_high() / texture_low();
    for (int i = 0; i < texture_width; ++i) {
        const double r = texture_low() * std::pow(ratio, i / (texture_width - 1.));
        for (int b = 0; b < 3; ++b) texels.push_back(float(std::log2(std::max(eval(b, r), 1e-36))));
        texels.push_back(0.f);
    }
    Texture texture(TexelFormat::rgba32f, texture_width, 1);
    texture.upload(texels);
    return texture;
}

void BandProfiles::bind(ComputePass& pass, int unit, const Texture& texture) const {
    pass.reads(unit, texture)
        .set("profile_low", float(std::log2(texture_low())))
        .set("profile_range", float(std::log2(texture_high() / texture_low())));
}

}  // namespace nacre
