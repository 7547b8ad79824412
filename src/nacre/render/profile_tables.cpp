#include "nacre/render/profile_tables.h"

namespace nacre {

namespace {

/// A profile times a number.
class MultipliedProfile final : public RadialProfile {
  public:
    MultipliedProfile(std::unique_ptr<RadialProfile> profile, double factor)
        : profile_(std::move(profile)), factor_(factor) {}

    const ProfileDescription& description() const override { return profile_->description(); }
    double eval(double r) const override { return factor_ * profile_->eval(r); }
    double cumulative(double r) const override { return factor_ * profile_->cumulative(r); }
    double total() const override { return factor_ * profile_->total(); }
    bool includes_single_scattering() const override {
        return profile_->includes_single_scattering();
    }
    double scale() const override { return profile_->scale(); }
    double sigma_tr() const override { return profile_->sigma_tr(); }

  private:
    std::unique_ptr<RadialProfile> profile_;
    double factor_;
};

/// Of an uneven medium means over a lattice in the volume's bounds.
MediumCoefficients mean_coefficients(const Medium& medium, const Wavelengths& w) {
    const Volume* volume =
        medium.sigma_t_volume ? medium.sigma_t_volume.get() : medium.albedo_volume.get();
    const Box3f box = volume ? volume->bounds() : Box3f{};
    const Vec3f size = box.diagonal();
    if (!volume || !(std::max({size.x, size.y, size.z}) < 1e20f)) return medium.coefficients({}, w);
    constexpr int n = 16;
    MediumCoefficients mean{Spectral(0.f), Spectral(0.f)};
    const auto at = [](int i) { return (float(i) + 0.5f) / float(n); };
    for (int i = 0; i < n * n * n; ++i) {
        const Vec3f part(at(i % n), at(i / n % n), at(i / (n * n)));
        const MediumCoefficients c = medium.coefficients(box.lower + part * size, w);
        mean.sigma_s += c.sigma_s * Spectral(1.f / float(n * n * n));
        mean.sigma_t += c.sigma_t * Spectral(1.f / float(n * n * n));
    }
    return mean;
}

}  // namespace

std::vector<ProfileMedium> medium_in_bands(const Medium& medium, float eta, const Bands& bands) {
    std::vector<ProfileMedium> result;
    for (int g = 0; g < bands.groups(); ++g) {
        const MediumCoefficients c = mean_coefficients(medium, bands.group(g));
        for (int i = 0; i < 4 && int(result.size()) < bands.count(); ++i)
            result.push_back({.sigma_s = c.sigma_s[i],
                              .sigma_a = std::max(0.f, c.sigma_t[i] - c.sigma_s[i]),
                              .g = medium.phase.mean_cosine(),
                              .eta = eta});
    }
    return result;
}

ProfileTables::ProfileTables(const Medium& medium, float eta, std::string_view profile,
                             const Bands& bands, std::span<const double> factors, const Work& work)
    : bands_(bands) {
    const std::vector<ProfileMedium> media = medium_in_bands(medium, eta, bands);
    WorkPhase phase(work, "tables of the profile", media.size());
    for (std::size_t first = 0; first < media.size(); first += 4) {
        std::vector<std::unique_ptr<RadialProfile>> profiles;
        std::vector<const RadialProfile*> pointers;
        for (std::size_t i = first; i < std::min(first + 4, media.size()); ++i) {
            profiles.push_back(make_profile(profile, media[i]));
            if (!factors.empty())
                profiles.back() =
                    std::make_unique<MultipliedProfile>(std::move(profiles.back()), factors[i]);
            pointers.push_back(profiles.back().get());
            totals_.push_back(float(profiles.back()->total()));
            includes_single_scattering_ = profiles.back()->includes_single_scattering();
            phase.advance();
        }
        groups_.emplace_back(pointers);
    }
}

Spectral ProfileTables::eval(float r2, const Wavelengths& w) const {
    if (bands_.mode() == ColorMode::rgb_bands) return groups_[0].eval(r2);
    float values[24];
    for (std::size_t g = 0; g < groups_.size(); ++g) groups_[g].eval(r2).store(values + 4 * g);
    return bands_.at(values, w);
}

Spectral ProfileTables::total(const Wavelengths& w) const { return bands_.at(totals_.data(), w); }

float ProfileTables::sample(float u1, float u2, const Wavelengths& w) const {
    int lane = 0;
    while (lane < 3 && u1 >= w.weight[lane]) u1 -= w.weight[lane++];
    const int band = bands_.nearest(lane, w);
    return groups_[std::size_t(band / 4)].sample(u2, band % 4);
}

float ProfileTables::pdf(float r2, const Wavelengths& w) const {
    if (bands_.mode() == ColorMode::rgb_bands) return sum(groups_[0].pdf(r2) * w.weight);
    float p = 0.f;
    for (int i = 0; i < 4; ++i) {
        const int band = bands_.nearest(i, w);
        p += w.weight[i] * groups_[std::size_t(band / 4)].pdf(r2)[band % 4];
    }
    return p;
}

}  // namespace nacre
