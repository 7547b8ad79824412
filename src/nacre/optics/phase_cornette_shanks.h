#pragma once
// Cornette and Shanks 1992, Physically reasonable analytic expression for the single-scattering
// phase function, Applied Optics 31(16):
//   p = 3 (1 - g^2) (1 + cos^2) / (8 pi (2 + g^2) (1 + g^2 - 2 g cos)^(3/2)),   -1 < g < 1.
// Tends to Rayleigh as g -> 0, which Henyey-Greenstein does not. Its mean cosine is not g but
// 3 g (4 + g^2) / (5 (2 + g^2)).
#include <algorithm>
#include <cmath>

#include "nacre/optics/phase_henyey_greenstein.h"
#include "nacre/optics/phase_rayleigh.h"

namespace nacre {

template <class T>
struct CornetteShanksPhase {
    T g;

    T eval(T cos_theta) const {
        return T(1.5) * (T(1) + cos_theta * cos_theta) / (T(2) + g * g) *
               HenyeyGreensteinPhase<T>{g}.eval(cos_theta);
    }

    /// Inverse of the distribution function by Newton's method kept within a shrinking bracket.
    T sample_cos(T u) const {
        // Below this g the lobe is Rayleigh's times 1 + 3 g cos up to g^2, less than single
        // precision and statistics can tell, while the closed form loses its digits as 1 / g^3.
        if (std::abs(g) < T(1e-3)) return sample_near_rayleigh(static_cast<double>(u));
        const CornetteShanksPhase<double> p{static_cast<double>(g)};
        const double wanted = static_cast<double>(u), constant = p.antiderivative(-1.);
        double low = -1., high = 1.;
        double c = HenyeyGreensteinPhase<double>{p.g}.sample_cos(wanted);
        for (int i = 0; i < 40; ++i) {
            const double error = p.antiderivative(c) - constant - wanted;
            (error > 0. ? high : low) = c;
            double next = c - error / (2. * std::numbers::pi * p.eval(c));
            if (!(next > low && next < high)) next = 0.5 * (low + high);
            const double change = std::abs(next - c);
            c = next;
            if (change < 1e-9) break;  // Newton's next step would be of the order of its square
        }
        return static_cast<T>(c);
    }
    T mean_cosine() const { return T(3) * g * (T(4) + g * g) / (T(5) * (T(2) + g * g)); }

    /// An antiderivative of 2 pi p by the cosine; with x = 1 + g^2 - 2 g cos the integrand is a
    /// polynomial of x over x^(3/2).
    T antiderivative(T cos_theta) const {
        using std::sqrt;
        const T g2 = g * g, b = T(1) + g2, x = b - T(2) * g * cos_theta, root = sqrt(x);
        const T sum = (T(4) * g2 + b * b) / root + b * T(2) * root - x * root / T(3);
        return T(3) * (T(1) - g2) / (T(16) * (T(2) + g2) * g2 * g) * sum;
    }

  private:
    // One Newton step from Rayleigh's sample: the distribution function gains (9 g / 32) (2 c^2 +
    // c^4 - 3) to first order in g.
    T sample_near_rayleigh(double u) const {
        const RayleighPhase<double> rayleigh;
        const double c = rayleigh.sample_cos(u), c2 = c * c;
        const double gain = 9. / 32. * static_cast<double>(g) * (2. * c2 + c2 * c2 - 3.);
        const double moved = c - gain / (2. * std::numbers::pi * rayleigh.eval(c));
        return static_cast<T>(std::clamp(moved, -1., 1.));
    }
};

}  // namespace nacre
