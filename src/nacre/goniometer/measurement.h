#pragma once
// The virtual gonioreflectometer: how light that falls on a patch of microgeometry from one
// direction leaves it, by following it.
//
//   S. H. Westin, J. R. Arvo, K. E. Torrance 1992, Predicting Reflectance Functions from Complex
//   Surfaces, SIGGRAPH 92.
//
// Rays from one direction meet the patch uniformly over its projected area and are followed from
// reflection to reflection until they leave; what they carry then is added to the bin of their
// direction. Over the bin's integral of the cosine that is the mean of the BRDF there (below the
// surface of the BTDF) by radiance, sr^-1, and the scatter of the rays gives its standard error.
// Geometrical optics: facets are large against the wavelength.
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "nacre/goniometer/hemisphere_bins.h"
#include "nacre/goniometer/patch.h"
#include "nacre/math/work.h"

namespace nacre {

/// A mean and its standard error.
struct MeasuredValue {
    double value = 0., error = 0.;
};

struct MeasureOptions {
    HemisphereBins bins;
    /// Reflections that count: 1 is single scattering, with shadows and occlusion; 0: all.
    int orders = 0;
    /// Whether the patch is turned about its normal at random for each ray: the mean over all
    /// azimuths, isotropic whatever the patch is.
    bool turned = false;
    /// Rays are added, twice as many each time, until `noise` of each incidence is at most this.
    double noise = 0.02;
    std::uint64_t least_rays = 1 << 16, most_rays = 1 << 28;
    std::uint64_t seed = 0;
    Wavelengths wavelengths = Wavelengths::rgb_bands();
};

/// What was found for one incidence: sums over rays, so that it can go on.
class IncidenceMeasurement {
  public:
    IncidenceMeasurement() = default;
    IncidenceMeasurement(const DirectionCell& incidence, const HemisphereBins& bins);

    /// BRDF of a bin of the upper hemisphere, BTDF of one of the lower, at a lane, sr^-1.
    MeasuredValue brdf(std::size_t bin, int lane) const { return density(bin, lane); }
    MeasuredValue btdf(std::size_t bin, int lane) const { return density(bins.size() + bin, lane); }
    /// Shares of the light that falls in.
    MeasuredValue reflected(int lane) const { return share(above, lane); }
    MeasuredValue transmitted(int lane) const { return share(below, lane); }
    /// What was still on its way after so many reflections as count.
    MeasuredValue blocked(int lane) const { return share(cut, lane); }
    /// What was given up: rays that went through ten thousand reflections, or flew along the
    /// surface. More than a trace of it makes the measurement wrong.
    MeasuredValue lost(int lane) const { return share(gone, lane); }
    /// Sum of the standard errors of all bins over all that leaves: the relative error of a bin, in
    /// the mean over the light; of the worst lane. 0 if nothing leaves.
    double noise(const Wavelengths& wavelengths) const;

    DirectionCell incidence;
    HemisphereBins bins;
    std::uint64_t rays = 0;
    struct Sums {
        std::array<double, 4> sum{}, square{};
        void add(const Spectral& weight) {
            for (int k = 0; k < 4; ++k) {
                sum[k] += double(weight[k]);
                square[k] += double(weight[k]) * double(weight[k]);
            }
        }
    };
    std::vector<Sums> of_bin;  ///< above, then below
    Sums above, below, cut, gone;

  private:
    MeasuredValue share(const Sums& sums, int lane) const;
    MeasuredValue density(std::size_t i, int lane) const;
};

/// How far a measurement is: rays and noise of the incidence that is being measured.
struct MeasureProgress {
    std::size_t incidence = 0, incidences = 1;
    std::uint64_t rays = 0;
    double noise = 0.;
};

/// Adds rays to one incidence until it is as exact as asked for, or `work` says stop: what was
/// found until then stands. The result depends on the seed and the rays, not on threads or on how
/// often it went on. Throws InputError for bins or noise that mean nothing, RunError for light that
/// is no number.
void measure(const Patch& patch, const MeasureOptions& options, IncidenceMeasurement& measurement,
             const Work& work = {},
             const std::function<void(const MeasureProgress&)>& progress = {});

}  // namespace nacre
