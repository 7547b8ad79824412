#pragma once
// The directional dipole: diffuse part of the BSSRDF from a ray source rather than a point source,
// so that it depends on where the light comes from.
//
//   J. R. Frisvad, T. Hachisuka, T. K. Kjeldsen 2014, Directional Dipole Model for Subsurface
//   Scattering, ACM TOG 34(1).
//
// With x = xo - xi, w12 the refracted direction of the light, D = 1 / (3 sigma_t'), s = sigma_tr:
//   S_d = S'(x, w12, d_r) - S'(xo - xv, wv, d_v)
//   S'(x, w, d) = e^(-s d) / (4 C_phi(1/eta) 4 pi^2 d^3) { C_phi(eta) (d^2/D + 3 (1 + s d) x.w)
//     - C_E(eta) [3 D (1 + s d) w.no - ((1 + s d) + 3 D (3 (1 + s d) + (s d)^2) / d^2 x.w) x.no] }
//   d_r^2 = r^2 + D mu0 (D mu0 - 2 d_e cos_beta) if mu0 = -no.w12 > 0, else r^2 + 1 / (3 sigma_t)^2
//   d_e = 2.131 D / sqrt(alpha'),  cos_beta = -sqrt((r^2 - (x.w12)^2) / (r^2 + d_e^2))
//   n* the unit vector along ni less its part along x (ni at r = 0), xv = xi + 2 A d_e n*,
//   wv = w12 mirrored in the plane of n*, d_v = |xo - xv|
// C_phi and C_E from the fits of d'Eon and Irving 2011, A = (1 - C_E) / (2 C_phi); they are used at
// eta = 1 as well, where they do not vanish.
//
// In mm^-2 sr^-1, without Fresnel factors: light enters and leaves with 1 - F. The unscattered and
// once-scattered light of the paper's delta-Eddington beam is not in it. It is not reciprocal and
// may be negative (options below). Checked against an independent oracle, which was read against
// one public implementation; not against a simulation.
#include <numbers>

#include "nacre/math/lanes.h"
#include "nacre/math/lanes_math.h"
#include "nacre/math/vec.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"

namespace nacre {

struct DirectionalDipoleOptions {
    bool clamp = true;        ///< negative values become 0
    bool symmetrise = false;  ///< (S(i, o) + S(o, i)) / 2, which is reciprocal
};

/// A point of the surface, its unit normal outwards, and a unit direction away from the surface (to
/// the light, to the viewer), all in one frame; mm.
template <class T>
struct SurfaceRay {
    Vec3<T> position, normal, direction;
};

/// A template over its number type: float, double, or four wavelengths, whose geometry is the same
/// in every lane.
template <class T>
class DirectionalDipole {
  public:
    /// Coefficients in mm^-1, sigma_s > 0, g in (-1, 1), eta = n_medium / n_outside >= 1.
    DirectionalDipole(T sigma_s, T sigma_a, T g, double eta, DirectionalDipoleOptions options = {})
        : options_(options), eta_(eta) {
        using std::sqrt;
        const T reduced = sigma_s * (T(1) - g), sigma_t_prime = reduced + sigma_a;
        diffusion_ = T(1) / (T(3) * sigma_t_prime);
        sigma_tr_ = sqrt(sigma_a / diffusion_);
        extrapolation_ = T(2.131) * diffusion_ / sqrt(reduced / sigma_t_prime);
        nearest_ = T(1) / (T(3) * (sigma_s + sigma_a));
        const double c_phi = 0.25 * (1. - two_c1_fit(eta)), c_e = 0.5 * (1. - three_c2_fit(eta));
        c_phi_ = T(c_phi);
        c_e_ = T(c_e);
        image_shift_ = T((1. - c_e) / c_phi) * extrapolation_;
        normalisation_ = T(std::numbers::inv_pi * std::numbers::inv_pi / 16. /
                           (0.25 * (1. - two_c1_fit(1. / eta))));
    }

    /// S_d for light that enters at `in` and leaves at `out`.
    T eval(const SurfaceRay<T>& in, const SurfaceRay<T>& out) const {
        T value = one_way(in, out.position, out.normal);
        if (options_.symmetrise) value = T(0.5) * (value + one_way(out, in.position, in.normal));
        return options_.clamp ? select(value > T(0), value, T(0)) : value;
    }

  private:
    T one_way(const SurfaceRay<T>& in, const Vec3<T>& xo, const Vec3<T>& no) const {
        using std::sqrt;
        const Vec3<T> x = xo - in.position, w = refract(in.direction, in.normal, T(eta_));
        const T r2 = dot(x, x), along = dot(x, w), mu = -dot(no, w);

        const T cos_beta =
            -sqrt(positive(r2 - along * along) / (r2 + extrapolation_ * extrapolation_));
        const T dm = diffusion_ * mu;
        const T d_r = sqrt(r2 + select(mu > T(0), T(dm * (dm - T(2) * extrapolation_ * cos_beta)),
                                       T(nearest_ * nearest_)));

        const Vec3<T> n = image_normal(x, r2, in.normal);
        const Vec3<T> xv = x - n * image_shift_;
        const Vec3<T> wv = w - n * (T(2) * dot(w, n));
        return source(x, w, d_r, no) - source(xv, wv, length(xv), no);
    }

    /// n*: the normal less its part along x; the normal itself where that is nothing.
    Vec3<T> image_normal(const Vec3<T>& x, T r2, const Vec3<T>& normal) const {
        using std::sqrt;
        const T safe = select(r2 > T(0), r2, T(1));
        const Vec3<T> across = normal - x * (dot(normal, x) / safe);
        const T size2 = dot(across, across);
        const auto exists = size2 > T(1e-12);
        const T scale = T(1) / sqrt(select(exists, size2, T(1)));
        return {select(exists, T(across.x * scale), normal.x),
                select(exists, T(across.y * scale), normal.y),
                select(exists, T(across.z * scale), normal.z)};
    }

    /// S'(x, w, d).
    T source(const Vec3<T>& x, const Vec3<T>& w, T d, const Vec3<T>& no) const {
        using std::exp;
        const T sd = sigma_tr_ * d, one = T(1) + sd, xw = dot(x, w), d2 = d * d;
        const T fluence = d2 / diffusion_ + T(3) * one * xw;
        const T flux = T(3) * diffusion_ * one * dot(w, no) -
                       (one + T(3) * diffusion_ * (T(3) * one + sd * sd) / d2 * xw) * dot(x, no);
        return normalisation_ * exp(-sd) / (d2 * d) * (c_phi_ * fluence - c_e_ * flux);
    }

    static T positive(T v) { return select(v > T(0), v, T(0)); }

    DirectionalDipoleOptions options_;
    double eta_;
    T diffusion_, sigma_tr_, extrapolation_, nearest_, c_phi_, c_e_, image_shift_, normalisation_;
};

}  // namespace nacre
