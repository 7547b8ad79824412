#pragma once
// The two-pass technique of Jensen and Buhler 2002: irradiance at points of the surface, and what
// they send to each exit by a hierarchy (irradiance_tree.h).
#include "nacre/bssrdf/medium.h"
#include "nacre/geometry/surface_points.h"
#include "nacre/spectrum/bands.h"
#include "nacre/subsurface/irradiance_tree.h"
#include "nacre/subsurface/single_scattering.h"
#include "nacre/technique/technique.h"

namespace nacre {

class TwoPass final : public Translucency {
  public:
    /// `kernels`: R of each band. `exit_scale` and `single` as of SurfaceSampling.
    TwoPass(const ObjectBoundary& boundary, IrradianceTree tree, std::vector<DipoleKernel> kernels,
            const Bands& bands, float exit_scale,
            std::shared_ptr<const SingleScatteringTerm> single)
        : Translucency(boundary),
          tree_(std::move(tree)),
          kernels_(std::move(kernels)),
          bands_(bands),
          exit_scale_(exit_scale),
          single_(std::move(single)) {}

    Emergence emerge(const SurfacePoint& exit, const Vec3f& wo, Sampler& sampler,
                     const Wavelengths& wavelengths, RayCounts& counts) const override;

  private:
    IrradianceTree tree_;
    std::vector<DipoleKernel> kernels_;
    Bands bands_;
    float exit_scale_;
    std::shared_ptr<const SingleScatteringTerm> single_;
};

/// The technique's own parameters.
struct TwoPassOptions {
    double spacing = 1.;  ///< of points, in transport mean free paths of the densest band
    double error = 0.2;   ///< largest solid angle of a group of points that counts as one, sr
    int irradiance_samples = 8;                     ///< paths at each point
    PointMethod points = PointMethod::elimination;  ///< how they are spread
};

/// Throws InputError if these are more points of a surface of that area than there may be; what it
/// advises is in the unit and within the range of the option. `free_path` is the transport mean
/// free path of the densest band.
void check_spacing(const TwoPassOptions& options, double area, double free_path);

/// The kernel of "dipole" or "better_dipole"; throws InputError for other profiles.
DipoleKernel make_kernel(std::string_view profile, const ProfileMedium& medium);

}  // namespace nacre
