#include "nacre/spectrum/spectrum.h"

#include <fmt/format.h>

#include "nacre/math/error.h"
#include "nacre/math/lanes_math.h"
#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/uplift.h"

namespace nacre {

namespace {

Spectral bands(Vec3f rgb) { return Spectral(rgb.x, rgb.y, rgb.z, 0.f); }
float max_component(Vec3f v) { return std::max({v.x, v.y, v.z}); }
Vec3f clamp(Vec3f v, float low, float high) {
    return {std::clamp(v.x, low, high), std::clamp(v.y, low, high), std::clamp(v.z, low, high)};
}

class Constant final : public Spectrum {
  public:
    explicit Constant(float value) : value_(value) {}
    Spectral eval(const Wavelengths& w) const override {
        return w.mode == ColorMode::rgb_bands ? bands(rgb()) : Spectral(value_);
    }
    Vec3f rgb() const override { return {value_, value_, value_}; }
    float max() const override { return value_; }

  private:
    float value_;
};

class Tabulated final : public Spectrum {
  public:
    Tabulated(std::vector<float> nm, std::vector<float> value, SpectrumRole role)
        : nm_(std::move(nm)), value_(std::move(value)) {
        const bool light = role == SpectrumRole::illuminant;
        rgb_ = xyz_to_rgb(integrate_xyz(
            [&](float lambda) { return at(lambda) * (light ? 1.f : d65_unit(lambda)); }));
        rgb_ = clamp(rgb_, 0.f,
                     role == SpectrumRole::reflectance ? 1.f : std::numeric_limits<float>::max());
        max_ = std::max(*std::max_element(value_.begin(), value_.end()), max_component(rgb_));
    }
    Spectral eval(const Wavelengths& w) const override {
        if (w.mode == ColorMode::rgb_bands) return bands(rgb_);
        Spectral v;
        for (int i = 0; i < Spectral::size; ++i) v.set(i, at(w.lambda[i]));
        return v;
    }
    Vec3f rgb() const override { return rgb_; }
    float max() const override { return max_; }
    bool is_spectral() const override { return true; }

  private:
    float at(float lambda) const {
        if (!(lambda >= nm_.front() && lambda <= nm_.back())) return 0.f;
        const auto above = std::upper_bound(nm_.begin() + 1, nm_.end() - 1, lambda);
        const std::size_t i = static_cast<std::size_t>(above - nm_.begin());
        const float f = (lambda - nm_[i - 1]) / (nm_[i] - nm_[i - 1]);
        return value_[i - 1] * (1.f - f) + value_[i] * f;
    }

    std::vector<float> nm_, value_;
    Vec3f rgb_;
    float max_;
};

class Blackbody final : public Spectrum {
  public:
    Blackbody(float kelvin, float scale) : kelvin_(kelvin), scale_(scale) {
        rgb_ = clamp(xyz_to_rgb(integrate_xyz([this](float nm) { return planck(nm)[0]; })), 0.f,
                     std::numeric_limits<float>::max());
        // Wien's displacement law: the peak lies at 2897.772 um K / T.
        const float peak = std::clamp(2.897772e6f / kelvin, visible_min, visible_max);
        max_ = std::max(planck(peak)[0], max_component(rgb_));
    }
    Spectral eval(const Wavelengths& w) const override {
        return w.mode == ColorMode::rgb_bands ? bands(rgb_) : planck(w.lambda);
    }
    Vec3f rgb() const override { return rgb_; }
    float max() const override { return max_; }
    bool is_spectral() const override { return true; }

  private:
    // 2 h c^2 and h c / k_B of the SI (2019), with lambda in micrometres and the result per nm.
    Spectral planck(Spectral nm) const {
        const Spectral um = nm * 1e-3f, um2 = um * um;
        const Spectral x = 14387.76877f / (um * kelvin_);
        // Past 85 the exponential would overflow and the radiance is far below single precision.
        return select(
            x < Spectral(85.f),
            scale_ * 1.191042972e5f / (um2 * um2 * um * (exp(min(x, Spectral(85.f))) - 1.f)),
            Spectral(0.f));
    }

    float kelvin_, scale_;
    Vec3f rgb_;
    float max_;
};

// scale * sigmoid, by D65 or not.
class Uplifted final : public Spectrum {
  public:
    Uplifted(Vec3f rgb, float scale, bool light)
        : rgb_(rgb), scale_(scale), light_(light), sigmoid_(fit_rgb(rgb * (1.f / scale))) {
        float peak = 1.f;
        if (light)
            for (float nm = visible_min; nm <= visible_max; nm += 10.f)  // D65's own nodes
                peak = std::max(peak, d65_unit(nm));
        max_ = std::max(scale * peak * sigmoid_.max(), max_component(rgb));
    }
    Spectral eval(const Wavelengths& w) const override {
        if (w.mode == ColorMode::rgb_bands) return bands(rgb_);
        Spectral v = scale_ * sigmoid_.eval(w.lambda);
        if (light_)
            for (int i = 0; i < Spectral::size; ++i) v.set(i, v[i] * d65_unit(w.lambda[i]));
        return v;
    }
    Vec3f rgb() const override { return rgb_; }
    float max() const override { return max_; }

  private:
    Vec3f rgb_;
    float scale_;
    bool light_;
    SigmoidPolynomial sigmoid_;
    float max_;
};

void require_valid(Vec3f rgb) {
    for (int i = 0; i < 3; ++i)
        if (!(rgb[i] >= 0.f && std::isfinite(rgb[i])))
            throw InputError(
                fmt::format("rgb ({}, {}, {}): components must be finite and not negative", rgb.x,
                            rgb.y, rgb.z));
}

SpectrumPtr make_scaled(Vec3f rgb, bool light) {
    require_valid(rgb);
    const float largest = max_component(rgb);
    if (largest == 0.f) return make_constant(0.f);
    return std::make_shared<Uplifted>(rgb, 2.f * largest, light);
}

}  // namespace

SpectrumPtr make_constant(float value) { return std::make_shared<Constant>(value); }

SpectrumPtr make_tabulated(std::vector<float> nm, std::vector<float> value, SpectrumRole role) {
    if (nm.size() != value.size())
        throw InputError(fmt::format("tabulated spectrum: {} wavelengths but {} values", nm.size(),
                                     value.size()));
    if (nm.size() < 2)
        throw InputError(fmt::format(
            "tabulated spectrum: {} point(s), but at least two are needed to interpolate",
            nm.size()));
    for (std::size_t i = 0; i < nm.size(); ++i) {
        if (!std::isfinite(nm[i]) || (i > 0 && nm[i] <= nm[i - 1]))
            throw InputError(fmt::format(
                "tabulated spectrum: wavelength {} ({} nm) does not follow the one before it; "
                "sort the points by increasing wavelength, each once",
                i + 1, nm[i]));
        if (!(value[i] >= 0.f && std::isfinite(value[i])))
            throw InputError(
                fmt::format("tabulated spectrum: value {} at {} nm must be finite and not negative",
                            value[i], nm[i]));
    }
    return std::make_shared<Tabulated>(std::move(nm), std::move(value), role);
}

SpectrumPtr make_blackbody(float kelvin, float scale) {
    if (!(kelvin > 0.f && std::isfinite(kelvin)))
        throw InputError(fmt::format("blackbody: temperature {} K must be positive", kelvin));
    if (!(scale >= 0.f && std::isfinite(scale)))
        throw InputError(fmt::format("blackbody: scale {} must not be negative", scale));
    return std::make_shared<Blackbody>(kelvin, scale);
}

SpectrumPtr make_rgb_reflectance(Vec3f rgb) {
    require_valid(rgb);
    return std::make_shared<Uplifted>(clamp(rgb, 0.f, 1.f), 1.f, false);
}

SpectrumPtr make_rgb_unbounded(Vec3f rgb) { return make_scaled(rgb, false); }
SpectrumPtr make_rgb_illuminant(Vec3f rgb) { return make_scaled(rgb, true); }

}  // namespace nacre
