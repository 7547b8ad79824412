#pragma once
// Matter as a BRDF, by the orders of scattering: all light leaves where it came in.
//
//   P. Hanrahan, W. Krueger 1993, Reflection from Layered Surfaces due to Subsurface Scattering,
//   SIGGRAPH 93.
//
//   f(wi, wo) / T(wo) = T(wi) ( W p(cos) / (n^2 (mi + mo))  +  rho X / pi )
//
// The first term is light scattered once in a half space, exact on a flat surface
// (layers/hanrahan_krueger.h): W is the single-scattering albedo, p the phase function, m the
// cosines below the boundary. The second stands for all higher orders, which have forgotten where
// they came from: Lambert's law, rho the share of the light that entered which they return. rho is
// the total of a diffusion profile; where the profile includes light scattered once, W rho_1 is
// taken off, so that in even light an object returns the profile's total as without the first term.
// X is the exit's scale (bssrdf/exit_fresnel.h). Behind a rough boundary T is the share that facets
// let pass; the directions of the first term are those behind a smooth one.
#include "nacre/layers/hanrahan_krueger.h"
#include "nacre/optics/phase.h"
#include "nacre/render/profile_tables.h"
#include "nacre/technique/technique.h"

namespace nacre {

/// rho_1: the share of even light which, having entered a half space of single-scattering albedo 1,
/// leaves it after exactly one scattering. Proportional to the albedo. Henyey and Greenstein's
/// phase function; g in (-1, 1), eta > 0.
double single_scattering_share(double g, double eta);

class LocalScatteringLobe final : public Material {
  public:
    struct Orders {
        bool single = true;       ///< the first term is there
        bool subtracted = false;  ///< W rho_1 is taken off the second
    };
    /// `medium` outlives it. `scale` is X.
    LocalScatteringLobe(const Medium& medium, std::shared_ptr<const ProfileTables> profile,
                        const ObjectBoundary& boundary, float scale, Orders orders);

    unsigned flags() const override { return reflects | has_smooth; }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& wavelengths,
                   BsdfScratch& scratch) const override;

  private:
    const Medium& medium_;
    std::shared_ptr<const ProfileTables> profile_;
    ObjectBoundary boundary_;
    float eta_, scale_, share_;
    Orders orders_;
};

class LocalScattering final : public Translucency {
  public:
    LocalScattering(const ObjectBoundary& boundary, LocalScatteringLobe lobe)
        : Translucency(boundary), lobe_(std::move(lobe)) {}

    Emergence emerge(const SurfacePoint& exit, const Vec3f&, Sampler&, const Wavelengths&,
                     RayCounts&) const override {
        return {Spectral(0.f), exit, Spectral(1.f)};
    }
    const Material& entry() const override { return lobe_; }

  private:
    LocalScatteringLobe lobe_;
};

}  // namespace nacre
