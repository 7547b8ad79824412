#pragma once
// A random walk inside the object in a medium that is chosen for its surface albedo.
//
//   M. J.-Y. Chiang, P. Kutz, B. Burley 2016, Practical and Controllable Subsurface Scattering for
//   Production Path Tracing, SIGGRAPH 2016 Talks; the fit is in bssrdf/chiang2016.h.
//
// The walk knows nothing of refraction: it starts where light leaves, against it, in a direction
// distributed by the cosine below the surface, scatters isotropically, and where it first meets the
// surface from inside the light came in, as on a Lambert surface. What the boundary does is left to
// the Fresnel transmittances outside, as in all techniques. So its medium is not the object's but
// one with the same effect on a half space: A is the share of diffuse light that, having entered
// the object's half space through its boundary, comes out again, after all reflections at the
// boundary's inside, by adding and doubling (layers/adding_doubling.h) and not by a diffusion
// profile, none of which is right for all albedos. From A the fit makes the walk's albedo, and a
// distance d its extinction 1 / (d s(A)). In the talk d is an artist's choice, that of normalised
// diffusion, which for a medium of mean free path l is l / s(A). Two choices of l (FreePath):
//
//   transport  1 / sigma_t' of the object: what single paths do. A boundary that reflects makes A
//              and with it the walk's albedo lower than the object's, so light fades too early.
//   diffuse    the l with which light far from where it entered fades as in the object,
//                sqrt(3 (1 - alpha)) / l = sigma_tr,
//              but no more than (1 + 2 B / 3) / (1 + 2 / 3) transport mean free paths, where B is
//              the boundary's (1 + F_dr) / (1 - F_dr): the ratio in the limit of white media, by
//              the total of the dipole; the fit stops short of it.
//
// Walks follow one lane's free paths, drawn anew for each walk, and are weighted for the others by
// the balance heuristic (render/path_state.h).
#include "nacre/bssrdf/albedo_inversion.h"
#include "nacre/bssrdf/chiang2016.h"
#include "nacre/bssrdf/half_space.h"
#include "nacre/render/path_state.h"
#include "nacre/spectrum/bands.h"
#include "nacre/technique/technique.h"

namespace nacre {

/// Coefficients of the walk in a medium (sigma_t' > 0), in its unit.
RandomWalkMedium<double> random_walk_medium(const ProfileMedium& medium, FreePath keep);

class RandomWalk final : public Translucency {
  public:
    /// `media`: the walk's coefficients in each band, per scene unit. `exit_scale` multiplies what
    /// leaves, and so does `factors` in each band unless it is empty.
    RandomWalk(const Scene& scene, std::uint32_t shape, const ObjectBoundary& boundary,
               const Bands& bands, std::span<const RandomWalkMedium<double>> media,
               float exit_scale, std::span<const double> factors = {});

    /// No entry if the walk is absorbed or gets lost through a hole. Other shapes inside are
    /// ignored.
    Emergence emerge(const SurfacePoint& exit, const Vec3f& wo, Sampler& sampler,
                     const Wavelengths& wavelengths, RayCounts& counts) const override;

  private:
    struct Surroundings;
    MediumLanes lanes(const Wavelengths& w, int lane) const;

    const Scene& scene_;
    std::uint32_t shape_;
    Bands bands_;
    std::vector<float> sigma_t_, sigma_s_;  // by band
    float exit_scale_;
    std::vector<float> factors_;  // by band, or empty
    Box3f bounds_;
};

}  // namespace nacre
