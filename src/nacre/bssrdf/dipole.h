#pragma once
// The classical dipole: diffuse reflectance of a half space lit at a point, by one isotropic source
// one transport mean free path below the surface and its mirror image of opposite sign.
//
//   H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan 2001, A Practical Model for Subsurface Light
//   Transport, SIGGRAPH 2001, section 2.2, eq. 4; G. Eason et al. 1978, T. J. Farrell et al. 1992.
//
//   sigma_t' = sigma_s' + sigma_a,  alpha' = sigma_s' / sigma_t',  d^2 = r^2 + z^2
//   sigma_tr = sqrt(3 sigma_a sigma_t'),  z_r = 1 / sigma_t',  z_v = z_r (1 + 4 A / 3)
//   R_d = alpha' / (4 pi) sum over z in {z_r, z_v} of z (1 + sigma_tr d) e^(-sigma_tr d) / d^3
//
// In mm^-2, per power that has entered the medium. All light that comes back is in the total,
// single scattering with it, though in the wrong place: near the source, within about two transport
// mean free paths, and for alpha' below about 0.9 the profile is wrong by factors, beyond that it
// has the right slope. Erratum of the paper: its eq. 4 prints 1 / sigma_t' for z_v in the second
// term in one place; the dimensions demand z_v.
//
// A template over its number type: float, double, four wavelengths (Spectral), or many distances at
// once (Wide; include math/lanes_wide.h). Evaluation costs one root, one exponential and one
// division for each of the two sources, and takes the squared distance, so that a gather over
// points takes no other root.
#include <numbers>

#include "nacre/bssrdf/point_source.h"
#include "nacre/optics/fresnel_moments.h"

namespace nacre {

template <class T>
struct Dipole {
    T albedo;    ///< alpha'
    T sigma_tr;  ///< effective transport coefficient, mm^-1
    T z_r, z_v;  ///< depth of the source and height of its image, mm, both positive

    /// Coefficients in mm^-1, >= 0; eta = n_medium / n_outside > 0. Where both coefficients are 0
    /// (such as an unused lane) the profile is 0. Nothing is checked here; see medium.h.
    Dipole(T sigma_s_prime, T sigma_a, double eta, BoundaryModel boundary = BoundaryModel::fit) {
        using std::sqrt;
        const T sum = sigma_s_prime + sigma_a;
        const T sigma_t_prime = select(sum > T(0), sum, T(1));
        albedo = sigma_s_prime / sigma_t_prime;
        sigma_tr = sqrt(T(3) * sigma_a * sigma_t_prime);
        z_r = T(1) / sigma_t_prime;
        z_v = z_r * T(1. + 4. / 3. * boundary_parameter(eta, boundary));
    }

    /// R_d at squared distance r2 >= 0 (mm^2).
    T eval(T r2) const {
        return albedo * T(0.25 * std::numbers::inv_pi) *
               (point_source::at(r2, z_r, sigma_tr).flux +
                point_source::at(r2, z_v, sigma_tr).flux);
    }
    /// Integral of R_d over the disk of squared radius r2: what comes back within it.
    T cumulative(T r2) const {
        return albedo * (point_source::flux_within(r2, z_r, sigma_tr) +
                         point_source::flux_within(r2, z_v, sigma_tr));
    }
    /// Over the whole plane: alpha' / 2 (1 + e^(-4/3 A s)) e^(-s) with s = sqrt(3 (1 - alpha')).
    T total() const {
        return albedo * (point_source::flux_everywhere(z_r, sigma_tr) +
                         point_source::flux_everywhere(z_v, sigma_tr));
    }
};

}  // namespace nacre
