#pragma once
// What is computed once and then asked for at any wavelength is computed at fixed bands: the three
// of RGB, or wavelengths so dense that one interpolates between them.
#include <algorithm>

#include "nacre/spectrum/wavelengths.h"

namespace nacre {

class Bands {
  public:
    explicit Bands(ColorMode mode) : mode_(mode) {}

    ColorMode mode() const { return mode_; }
    /// Number of bands: 3, or 24 wavelengths from 360 to 820 nm. 20 nm resolve the
    /// bands of haemoglobin, 30 nm wide, the most uneven spectrum that there is to hold.
    int count() const { return mode_ == ColorMode::rgb_bands ? 3 : 24; }
    /// Bands come in groups of four lanes; the last lane of the RGB group is unused.
    int groups() const { return mode_ == ColorMode::rgb_bands ? 1 : 6; }
    /// The lanes of group `g`: bands 4 g to 4 g + 3.
    Wavelengths group(int g) const {
        if (mode_ == ColorMode::rgb_bands) return Wavelengths::rgb_bands();
        Spectral nm;
        for (int i = 0; i < 4; ++i) nm.set(i, first_nm + step_nm * float(4 * g + i));
        return Wavelengths::at(nm);
    }
    /// `values`, one for each band, at the lanes of a path: linear between bands, constant beyond.
    Spectral at(const float* values, const Wavelengths& w) const {
        if (mode_ == ColorMode::rgb_bands) return {values[0], values[1], values[2], 0.f};
        Spectral r;
        for (int i = 0; i < 4; ++i) {
            const Place p = place(w.lambda[i]);
            r.set(i, values[p.band] + p.share * (values[p.band + 1] - values[p.band]));
        }
        return r;
    }
    /// The band nearest to lane i of a path.
    int nearest(int i, const Wavelengths& w) const {
        if (mode_ == ColorMode::rgb_bands) return std::min(i, 2);
        const Place p = place(w.lambda[i]);
        return p.share < 0.5f ? p.band : p.band + 1;
    }

  private:
    static constexpr float first_nm = 360.f, step_nm = 20.f;
    struct Place {
        int band;
        float share;  // of the next band
    };
    Place place(float nm) const {
        const float x = std::clamp((nm - first_nm) / step_nm, 0.f, float(count() - 1));
        const int band = std::min(int(x), count() - 2);
        return {band, x - float(band)};
    }

    ColorMode mode_;
};

}  // namespace nacre
