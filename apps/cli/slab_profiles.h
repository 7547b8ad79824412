#pragma once
// What `nacre slab` tells beyond totals: over the radius, over the angle of exit, over the
// wavelength.
#include "apps/cli/plot.h"
#include "apps/cli/slab_methods.h"
#include "nacre/layers/skin.h"

namespace nacre::cli {

/// Power that leaves above (without `specular`) and below per area (mm^-2) over the distance from
/// where the beam entered, in `bins` equal rings up to `rmax` mm, by Monte Carlo. rmax 0: ten
/// transport mean free paths of the layer that scatters most.
Table radial_table(const SlabTask& task, double rmax, int bins);

/// Power that leaves above and below per solid angle (sr^-1), averaged over azimuth, over the angle
/// of exit in `bins` equal steps, by those of the methods that tell it: adding-doubling at the
/// middle of the steps and without light that only interfaces have turned, Monte Carlo as means,
/// with it but without `specular`. Throws InputError if none of them tells it.
Table angular_table(const SlabTask& task, const std::vector<const SlabMethod*>& methods, int bins);

/// Light scattered once (Hanrahan and Krueger 1993) in the plane of incidence: radiance over
/// incident radiance per solid angle of the light (sr^-1), f cos(theta_i), over the angle from the
/// normal, light at negative angles, from -180 (below) to 180 degrees; one column for each angle of
/// incidence in degrees.
Table lobe_table(const LayerStack& stack, const std::vector<double>& incidences);

/// Reflectance of skin over the wavelength, `from` to `to` nm. `task` gives the light, the photons
/// and, where they are not 0, the indices outside. A method that refuses a stack shows as not a
/// number.
Table spectrum_table(const SkinParameters& skin, const SlabTask& task,
                     const std::vector<const SlabMethod*>& methods, double from, double to,
                     double step);

}  // namespace nacre::cli
