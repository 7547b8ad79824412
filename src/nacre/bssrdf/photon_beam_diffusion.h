#pragma once
// Photon beam diffusion for light that enters at a right angle, and its exact single scattering.
//
//   R. Habel, P. H. Christensen, W. Jarosz 2013, Photon Beam Diffusion: A Hybrid Monte Carlo Method
//   for Subsurface Scattering, EGSR 2013.
//
// Sources lie along the whole refracted beam instead of at one depth. With the better dipole's D,
// sigma_tr, A, C_phi, C_E and z_v = z + 4 A D:
//   R(r) = integral over z of sigma_t' e^(-sigma_t' z) kappa(z) R_pair(r; z, z_v),
//   R_pair = the better dipole with its source at z,   kappa = 1 - e^(-2 sigma_t' (d_r + z))
// kappa corrects, by a fit of the authors, what diffusion gets wrong near the source. Without it
// the model is the continuum limit of quantised diffusion.
//
// In mm^-2, per power that has entered (the Fresnel transmission of the entry is the caller's). The
// exitance includes the transmission outwards. R grows as 1/r towards r = 0, with kappa as
// log(1/r). Oblique beams, which the paper treats as well, do not give radial profiles and are left
// out.
#include "nacre/bssrdf/boundary_moments.h"
#include "nacre/bssrdf/medium.h"

namespace nacre {

/// Light scattered more than once.
class PhotonBeamDiffusion {
  public:
    /// The medium must pass `check`.
    explicit PhotonBeamDiffusion(const ProfileMedium& medium, bool kappa = true,
                                 MomentModel moments = MomentModel::exact);

    /// R at r > 0 (mm), by quadrature to about 1e-8.
    double eval(double r) const;
    /// Integral of R over the plane: closed without kappa, by quadrature with it.
    double total() const;
    double sigma_tr() const { return sigma_tr_; }

  private:
    /// Integral over depth with a weight of the way d_r + z beside sigma_t' e^(-sigma_t' z).
    template <class F>
    double along_beam(double r, F&& weight) const;

    double sigma_t_prime_, albedo_, diffusion_, sigma_tr_, image_shift_, c_phi_, c_e_;
    bool kappa_;
};

/// Light scattered exactly once: the full sigma_s and g, not the reduced ones. A scattering at
/// depth t sends light to distance r along d = sqrt(r^2 + t^2) at the inner cosine t / d:
///   R(r) = integral over t of sigma_s e^(-sigma_t (t + d)) p(-t/d) (t/d) (1 - F(t/d)) / d^2
class BeamSingleScattering {
  public:
    /// The medium must pass `check`.
    explicit BeamSingleScattering(const ProfileMedium& medium) : medium_(medium) {}

    /// R at r > 0 (mm), mm^-2, per power that has entered; to about 1e-8.
    double eval(double r) const;
    /// Over the plane: 2 pi W integral over mu of p(-mu) (1 - F(mu)) mu / (1 + mu).
    double total() const;

  private:
    ProfileMedium medium_;
};

}  // namespace nacre
