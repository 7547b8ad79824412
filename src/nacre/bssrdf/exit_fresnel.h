#pragma once
// From a profile to the BSSRDF: what the surface does to the light on its way in and out.
//
//   S_d(xi, wi, xo, wo) = 1/pi T(wi) R_d(|xi - xo|) X(wo),   T = 1 - F
//   H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan 2001, SIGGRAPH 2001, eq. 5; H. W. Jensen, J.
//   Buhler 2002, A Rapid Hierarchical Rendering Technique for Translucent Materials, SIGGRAPH 2002.
//
// R_d is the radiant exitance outside, so that what leaves in all directions must be R_d: the mean
// of X over the hemisphere, weighted by the cosine, must be 1. Jensen et al. write X = T(wo), whose
// mean is 1 - F_ext (0.94 at eta 1.3): some light is lost at the surface twice. Both are here.
#include <numbers>

#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"

namespace nacre {

enum class ExitFresnel {
    normalised,  ///< X = T(wo) / (1 - F_ext): conserves energy, reciprocal up to the constant
    paper,       ///< X = T(wo), Jensen et al. 2001: reciprocal, too dark
};

class DiffuseBssrdf {
  public:
    /// eta = n_medium / n_outside > 0.
    explicit DiffuseBssrdf(double eta, ExitFresnel exit = ExitFresnel::normalised)
        : eta_(eta),
          scale_(exit == ExitFresnel::paper ? 1. : 1. / (1. - diffuse_reflectance_external(eta))) {}

    /// X over T: 1, or 1 over the mean transmittance.
    double scale() const { return scale_; }
    /// T(wi): the share of light at outer cosine cos_i >= 0 that enters.
    template <class T>
    T entry(T cos_i) const {
        return T(1) - fresnel_dielectric(cos_i, T(eta_));
    }
    /// X(wo) at outer cosine cos_o >= 0: the shape of the light that leaves. Its radiance is M X /
    /// pi for radiant exitance M.
    template <class T>
    T exit(T cos_o) const {
        return T(scale_) * entry(cos_o);
    }
    /// S_d (mm^-2 sr^-1) from the profile's value (mm^-2).
    template <class R, class T>
    R eval(R profile, T cos_i, T cos_o) const {
        return R(T(std::numbers::inv_pi) * entry(cos_i) * exit(cos_o)) * profile;
    }

  private:
    double eta_, scale_;
};

}  // namespace nacre
