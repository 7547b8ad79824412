#pragma once
// Flat layers of scattering matter, as every method of this room takes them, and what they answer.
#include <vector>

namespace nacre {

/// One homogeneous layer. Its phase function is Henyey and Greenstein's.
struct Layer {
    double sigma_s = 0.;    ///< scattering, mm^-1, >= 0
    double sigma_a = 0.;    ///< absorption, mm^-1, >= 0
    double g = 0.;          ///< mean cosine of a scattering, in (-1, 1)
    double thickness = 1.;  ///< mm, > 0; infinite for a half space
    double eta = 1.;        ///< index of refraction, > 0

    double sigma_t() const { return sigma_s + sigma_a; }
    /// Single-scattering albedo; 0 where there is neither scattering nor absorption.
    double albedo() const { return sigma_t() > 0. ? sigma_s / sigma_t() : 0.; }
    /// 0 for clear layers of any thickness.
    double optical_thickness() const { return sigma_t() > 0. ? sigma_t() * thickness : 0.; }
};

/// Layers from the top, where the light comes from, to the bottom, between clear half spaces.
struct LayerStack {
    std::vector<Layer> layers;
    double eta_above = 1., eta_below = 1.;
};

/// Throws InputError, naming layer (from 1), parameter, value and range, unless there are layers
/// and every number lies in its range. Only the last layer may be infinitely thick.
void check(const LayerStack& stack);

/// Where the light that falls on a stack goes, as shares of its power.
struct LayerTotals {
    double reflectance = 0.;    ///< all that comes back, `specular` included
    double transmittance = 0.;  ///< all that leaves at the bottom, `unscattered` included
    double absorptance = 0.;
    double specular = 0.;     ///< reflected by the first surface alone
    double unscattered = 0.;  ///< leaves at the bottom without having been scattered
};

/// A mean of random numbers with its standard error.
struct Estimate {
    double mean = 0., error = 0.;
};

}  // namespace nacre
