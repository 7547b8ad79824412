#pragma once
// Integrals over the hemisphere, by adaptive quadrature: albedos and masses of densities.
#include <functional>
#include <span>

#include "nacre/reflectance/registry.h"

namespace nacre {

struct Integral {
    double value = 0.;
    double error = 0.;  ///< estimate: the sum of what the last refinements changed; of albedos at
                        ///< least what samples of the model contradict
};
using Albedo = Integral;

/// Where the integrand may be high: a direction and a density there, sr^-1, of mass 1 or so.
struct Seed {
    Vec3d direction;
    double density;
};

/// Integral of f over the directions of the upper hemisphere, per solid angle. Cells in polar
/// coordinates about the normal, first split at the polar angle and the azimuths where lobes of
/// light from `wi` and kinks of models lie, then wherever a 7 x 7 Gauss rule and its four quarters
/// differ most, until the differences sum to less than `tolerance` or 20000 cells are reached.
/// Cells around `seeds` are halved first, until they are as small as what the seeds' densities
/// speak of: without them a lobe narrower than the first cells is not found.
Integral integrate_hemisphere(const std::function<double(const Vec3d&)>& f, const Vec3d& wi,
                              double tolerance = 1e-8, std::span<const Seed> seeds = {});

/// Integral over a cell in polar coordinates (radians), halved both ways until the quarters agree
/// with the whole within `tolerance`, or eight times.
double integrate_cell(const std::function<double(const Vec3d&)>& f, double theta0, double theta1,
                      double phi0, double phi1, double tolerance);

/// Share of the light from wi that the model scatters, without its mirror part. Samples of the
/// model's own sampler, the mirror direction and the way back are the seeds; the same samples give
/// a Monte Carlo estimate, and where the quadrature lies more than six of its standard errors away,
/// `error` is the distance.
Albedo directional_albedo(const AnyModel& model, const Vec3d& wi, double nm = 550.,
                          double tolerance = 1e-8);

}  // namespace nacre
