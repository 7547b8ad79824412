#pragma once
// Quantised diffusion: the diffusion of light released along the beam, cut into spans of time, each
// of which is a Gaussian on the surface. The profile is a sum of Gaussians with weights in closed
// form.
//
//   E. d'Eon, G. Irving 2011, A Quantized-Diffusion Model for Rendering Translucent Materials, ACM
//   TOG 30(4).
//
//   R(r) = alpha'^2 sum over i of Delta_i G(v_i, r) [C_phi (w_real - w_image)
//                                                    + C_E (e_real + e_image)]
//   v_i = 2 D tau_i,   Delta_i = (e^(-sigma_a tau_i) - e^(-sigma_a tau_(i+1))) / sigma_a
//
// with tau the length of path, G of gaussian_sum.h, the better dipole's D, A, C_phi and C_E, the
// image's shift b = 4 A D, g(z) = e^(-z^2/(2 v)) / sqrt(2 pi v), and the integrals over depth of
// the source sigma_t' e^(-sigma_t' z):
//   w_real  = sigma_t'/2 e^(sigma_t'^2 v/2) erfc(sigma_t' sqrt(v/2))
//   w_image = sigma_t'/2 e^(sigma_t' (sigma_t' v/2 + b)) erfc((sigma_t' v + b) / sqrt(2 v))
//   e_real  = D sigma_t' (g(0) - w_real),   e_image = D sigma_t' (g(b) - w_image)
//
// In mm^-2, per power that has entered; light scattered once only is left out (alpha'^2). As the
// number of Gaussians grows the profile tends to photon beam diffusion without kappa.
#include "nacre/bssrdf/boundary_moments.h"
#include "nacre/bssrdf/gaussian_sum.h"
#include "nacre/bssrdf/medium.h"

namespace nacre {

/// The medium must pass `check`. `count` >= 2 spans of time in geometric progression, each standing
/// for its logarithmic mean (a choice of ours; the geometric mean would return 1.8 % too
/// much at 40 Gaussians without absorption): from a spread of 1/1000 transport mean free path (what
/// spreads less is left out) to where absorption leaves e^-14, at most 1000 mean free paths.
GaussianSum quantised_diffusion(const ProfileMedium& medium, int count = 40,
                                MomentModel moments = MomentModel::exact);

}  // namespace nacre
