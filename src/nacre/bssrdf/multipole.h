#pragma once
// The multipole: diffuse reflectance and transmittance of a slab lit at a point, by the source one
// transport mean free path deep mirrored in both faces again and again.
//
//   C. Donner, H. W. Jensen 2005, Light Diffusion in Multi-Layered Translucent Materials, ACM TOG
//   24(3).
//
// Thickness t, l' = 1 / sigma_t', D = l' / 3, z_b = 2 A D above the upper and below the lower face,
// L = t + z_b,upper + z_b,lower, i from -n to n, d^2 = r^2 + z^2:
//   z_r,i = 2 i L + l',   z_v,i = 2 i L - l' - 2 z_b,upper
//   f(z) = z (1 + sigma_tr d) e^(-sigma_tr d) / d^3
//   R(r) = alpha' / (4 pi) sum of f(z_r,i) - f(z_v,i)
//   T(r) = alpha' / (4 pi) sum of f(t - z_r,i) - f(t - z_v,i)
//
// In mm^-2, per power that has entered. Single scattering is included as in the classical dipole,
// of which this is the slab: for t -> infinity R becomes the dipole's. Without absorption the sum
// may not be integrated term by term (each integrates to +- 1/2), so that totals are those of the
// slab's exact solution. Beyond L / 2 the profiles themselves are taken from its expansion in the
// modes of the slab, sin(k pi (z + z_b) / L) K_0(r sqrt(sigma_tr^2 + (k pi / L)^2)), which
// converges where the images cancel ever more finely; nearer, images are added up to n = 256 or
// until they have died out. The two agree to about 1e-5.
#include "nacre/bssrdf/medium.h"
#include "nacre/optics/fresnel_moments.h"

namespace nacre {

class Multipole {
  public:
    /// `thickness` in mm, at least the transport mean free path (the source must lie within), and
    /// the index of the slab over that of what lies below, `eta_below`. The medium must pass
    /// `check`. Throws InputError for a slab that is too thin.
    Multipole(const ProfileMedium& medium, double thickness, double eta_below,
              BoundaryModel boundary = BoundaryModel::fit);

    /// Profile at r >= 0 (mm) of light that leaves on the side it came from, and opposite.
    double reflectance(double r) const { return profile(r, upper); }
    double transmittance(double r) const { return profile(r, lower); }
    /// Integrals over the disk of radius r.
    double reflectance_within(double r) const { return within(r, upper); }
    double transmittance_within(double r) const { return within(r, lower); }
    /// Over the plane: alpha' sinh(s (t - l' + z_b,lower)) cosh(s z_b,upper) / sinh(s L) and
    /// alpha' sinh(s (l' + z_b,upper)) cosh(s z_b,lower) / sinh(s L), s = sigma_tr.
    double total_reflectance() const { return total(upper); }
    double total_transmittance() const { return total(lower); }
    double sigma_tr() const { return sigma_tr_; }

  private:
    enum Face { upper, lower };
    double profile(double r, Face face) const;
    double within(double r, Face face) const;
    double total(Face face) const;
    /// Sum over the images of `of(height of the face's plane over the image)`, signed.
    template <class F>
    double over_images(Face face, F&& of) const;
    /// Sum over the modes of amplitude times `of(k)`, k^2 = sigma_tr^2 + (i pi / L)^2, at radius r.
    template <class F>
    double over_modes(Face face, double r, F&& of) const;

    double albedo_, sigma_tr_, depth_, thickness_, upper_shift_, lower_shift_, period_;
};

}  // namespace nacre
