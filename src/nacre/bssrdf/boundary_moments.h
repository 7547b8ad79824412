#pragma once
// The surface as the profiles from 2011 on see it: the boundary condition and the exitance that
// follow from two moments of Fresnel reflection inside the medium.
//
//   E. d'Eon, G. Irving 2011, A Quantized-Diffusion Model for Rendering Translucent Materials, ACM
//   TOG 30(4): boundary phi = 2 A D dphi/dz, radiant exitance M = C_phi phi + C_E (flux outwards).
#include "nacre/optics/fresnel_moments.h"

namespace nacre {

/// Where the moments C_1 and C_2 come from.
enum class MomentModel {
    exact,  ///< quadrature
    fit,    ///< the polynomials of d'Eon and Irving 2011, about 1 % off for eta from 0.25 to 2.5; 0
            ///< at eta = 1
};

struct BoundaryMoments {
    double a;      ///< A = (1 + 3 C_2) / (1 - 2 C_1)
    double c_phi;  ///< (1 - 2 C_1) / 4
    double c_e;    ///< (1 - 3 C_2) / 2

    /// `eta` is n_medium / n_outside. 2 a c_phi + c_e = 1 for either model, which is what makes a
    /// medium without absorption return all light. Throws InputError for fits beyond their range.
    BoundaryMoments(double eta, MomentModel model) {
        const bool none = eta == 1., fit = model == MomentModel::fit;
        if (fit) check_moment_fits(eta);
        const double one = none ? 0. : fit ? two_c1_fit(eta) : diffuse_reflectance_internal(eta);
        const double two = none ? 0. : fit ? three_c2_fit(eta) : 3. * fresnel_moment(2, eta);
        a = (1. + two) / (1. - one);
        c_phi = 0.25 * (1. - one);
        c_e = 0.5 * (1. - two);
    }
};

}  // namespace nacre
