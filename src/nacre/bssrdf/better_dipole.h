#pragma once
// The better dipole: the classical one with Grosjean's diffusion coefficient, the boundary
// condition of two Fresnel moments, and an exitance of fluence and flux.
//
//   E. d'Eon 2012, A Better Dipole (technical note), after d'Eon and Irving 2011; C. C. Grosjean
//   1956.
//
//   D = (2 sigma_a + sigma_s') / (3 sigma_t'^2), sigma_tr = sqrt(sigma_a / D), z_r = 1 / sigma_t',
//   z_v = z_r + 4 A D, A, C_phi and C_E of boundary_moments.h, d^2 = r^2 + z^2:
//   R = alpha'^2 / (4 pi) { C_phi / D (e^(-sigma_tr d_r) / d_r - e^(-sigma_tr d_v) / d_v)
//       + C_E sum over z in {z_r, z_v} of z (1 + sigma_tr d) e^(-sigma_tr d) / d^3 }
//
// In mm^-2, per power that has entered. Mind alpha'^2: light that was scattered once only is left
// out, and is to be added (photon_beam_diffusion.h has it). Without absorption the total is 1. As
// floats the two fluences cancel far away, where some 1e-4 is lost.
#include <numbers>

#include "nacre/bssrdf/boundary_moments.h"
#include "nacre/bssrdf/point_source.h"

namespace nacre {

template <class T>
struct BetterDipole {
    T albedo_squared;  ///< alpha'^2
    T diffusion;       ///< D, mm
    T sigma_tr;        ///< mm^-1
    T z_r, z_v;        ///< mm, both positive
    T c_phi, c_e;

    /// As Dipole.
    BetterDipole(T sigma_s_prime, T sigma_a, double eta, MomentModel moments = MomentModel::exact) {
        using std::sqrt;
        const BoundaryMoments boundary(eta, moments);
        const T sum = sigma_s_prime + sigma_a;
        const T sigma_t_prime = select(sum > T(0), sum, T(1));
        const T albedo = sigma_s_prime / sigma_t_prime;
        albedo_squared = albedo * albedo;
        diffusion = (T(1) + sigma_a / sigma_t_prime) / (T(3) * sigma_t_prime);
        sigma_tr = sqrt(sigma_a / diffusion);
        z_r = T(1) / sigma_t_prime;
        z_v = z_r + T(4. * boundary.a) * diffusion;
        c_phi = T(boundary.c_phi);
        c_e = T(boundary.c_e);
    }

    /// R at squared distance r2 >= 0 (mm^2).
    T eval(T r2) const {
        const auto real = point_source::at(r2, z_r, sigma_tr);
        const auto image = point_source::at(r2, z_v, sigma_tr);
        return albedo_squared * T(0.25 * std::numbers::inv_pi) *
               (c_phi / diffusion * (real.fluence - image.fluence) +
                c_e * (real.flux + image.flux));
    }
    /// Integral of R over the disk of squared radius r2.
    T cumulative(T r2) const {
        return albedo_squared * (c_phi / diffusion *
                                     (point_source::fluence_within(r2, z_r, sigma_tr) -
                                      point_source::fluence_within(r2, z_v, sigma_tr)) +
                                 c_e * (point_source::flux_within(r2, z_r, sigma_tr) +
                                        point_source::flux_within(r2, z_v, sigma_tr)));
    }
    /// Over the whole plane.
    T total() const {
        return albedo_squared *
               (c_phi / diffusion * point_source::fluence_of_pair_everywhere(z_r, z_v, sigma_tr) +
                c_e * (point_source::flux_everywhere(z_r, sigma_tr) +
                       point_source::flux_everywhere(z_v, sigma_tr)));
    }
};

}  // namespace nacre
