#include "nacre/spectrum/rgb_basis.h"

#include "nacre/spectrum/uplift.h"

namespace nacre {
namespace {

struct Basis {
    SigmoidPolynomial primary[3], secondary[3];
    Basis() {
        for (int c = 0; c < 3; ++c) {
            Vec3f rgb;
            rgb[c] = 1.f;
            primary[c] = fit_rgb(rgb);
            secondary[c] = fit_rgb(Vec3f(1.f, 1.f, 1.f) - rgb);
        }
    }
};

}  // namespace

RgbBasis::RgbBasis(Spectral lambda) : white_(1.f) {
    static const Basis basis;
    for (int c = 0; c < 3; ++c) {
        primary_[c] = basis.primary[c].eval(lambda);
        secondary_[c] = basis.secondary[c].eval(lambda);
    }
}

Spectral RgbBasis::eval(const Vec3f& rgb) const {
    int least = 0, most = 0;
    for (int c = 1; c < 3; ++c) {
        if (rgb[c] < rgb[least]) least = c;
        if (rgb[c] >= rgb[most]) most = c;
    }
    if (least == most) return rgb.x * white_;
    const int middle = 3 - least - most;
    return rgb[least] * white_ + (rgb[middle] - rgb[least]) * secondary_[least] +
           (rgb[most] - rgb[middle]) * primary_[most];
}

}  // namespace nacre
