#pragma once
// Normalised diffusion: two exponentials over r, fitted to Monte Carlo simulations, that integrate
// to the surface albedo and are sampled in closed form.
//
//   P. H. Christensen, B. Burley 2015, Approximate Reflectance Profiles for Efficient Subsurface
//   Scattering, Pixar Technical Memo 15-04.
//
//   R(r) = A (e^(-r/d) + e^(-r/(3 d))) / (8 pi d r),   d = l / s(A)
//   searchlight        s = 1.85 - A + 7 |A - 0.8|^3      l: mean free path; light at a right angle
//   diffuse            s = 1.9 - A + 3.5 (A - 0.8)^2     l: mean free path; diffuse light
//   diffuse_free_path  s = 3.5 + 100 (A - 0.33)^4        l: diffuse mean free path 1/sigma_tr
//
// In mm^-2. A is the surface albedo of all scattered light, single scattering included, in [0, 1];
// R is infinite, but integrable, at r = 0. Erratum: the paper says that the cumulative distribution
// cannot be inverted analytically. It can: e^(-r/(3d)) = y solves y^3 + 3 y = 4 (1 - u), Cardano.
#include <cmath>
#include <numbers>

#include "nacre/math/lanes.h"
#include "nacre/math/lanes_math.h"

namespace nacre {

enum class NormalisedDiffusionFit { searchlight, diffuse, diffuse_free_path };

/// s(A) of the three fits.
template <class T>
T normalised_diffusion_scale(T albedo, NormalisedDiffusionFit fit) {
    using std::abs;
    switch (fit) {
        case NormalisedDiffusionFit::diffuse: {
            const T x = albedo - T(0.8);
            return T(1.9) - albedo + T(3.5) * x * x;
        }
        case NormalisedDiffusionFit::diffuse_free_path: {
            const T x = albedo - T(0.33);
            return T(3.5) + T(100) * (x * x) * (x * x);
        }
        case NormalisedDiffusionFit::searchlight:
            break;
    }
    const T x = abs(T(albedo - T(0.8)));
    return T(1.85) - albedo + T(7) * x * x * x;
}

/// A template over its number type; sampling is for plain numbers.
template <class T>
struct NormalisedDiffusion {
    T albedo;  ///< A
    T d;       ///< mm

    /// `free_path` in mm, > 0, of the kind that the fit wants.
    NormalisedDiffusion(T albedo_, T free_path,
                        NormalisedDiffusionFit fit = NormalisedDiffusionFit::searchlight)
        : albedo(albedo_), d(free_path / normalised_diffusion_scale(albedo_, fit)) {}

    /// R at distance r > 0 (mm). Both exponentials are powers of one.
    T eval(T r) const {
        using std::exp;
        const T e = exp(-r / (T(3) * d));
        return albedo * T(0.125 * std::numbers::inv_pi) * e * (T(1) + e * e) / (d * r);
    }
    /// Integral of R over the disk of radius r: A (1 - e^(-r/d)/4 - 3 e^(-r/(3d))/4).
    T cumulative(T r) const {
        using std::exp;
        const T e = exp(-r / (T(3) * d));
        return albedo * (T(1) - T(0.25) * e * (T(3) + e * e));
    }
    T total() const { return albedo; }

    /// Radius with density 2 pi r R(r) / A from u in [0, 1): the inverse of cumulative / A.
    /// Cardano's root as hyperbolic functions, y = 2 sinh(asinh(2 (1 - u)) / 3), so that large
    /// radii keep their digits.
    T sample(T u) const {
        using std::asinh, std::log, std::sinh;
        return T(-3) * d * log(T(2) * sinh(asinh(T(2) * (T(1) - u)) / T(3)));
    }
    /// Density of `sample` per area, mm^-2; the same for every A.
    T pdf(T r) const {
        using std::exp;
        const T e = exp(-r / (T(3) * d));
        return T(0.125 * std::numbers::inv_pi) * e * (T(1) + e * e) / (d * r);
    }
};

}  // namespace nacre
