#pragma once
// The Beckmann distribution of facet normals: a surface whose slopes are normally distributed.
//
//   P. Beckmann, A. Spizzichino 1963, The Scattering of Electromagnetic Waves from Rough Surfaces.
//   B. Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces, EGSR, eq.
//   25-29.
//   E. Heitz 2014, Understanding the Masking-Shadowing Function, JCGT 3(2), section 5 (anisotropy).
//   E. Heitz, E. d'Eon 2014, Importance Sampling Microfacet-Based BSDFs using the Distribution of
//   Visible Normals, EGSR.
//
//   D(h) = exp(-(hx^2/ax^2 + hy^2/ay^2) / hz^2) / (pi ax ay hz^4)
//   Lambda(w) = (erf(a) - 1 + exp(-a^2) / (a sqrt(pi))) / 2,
//               a = |wz| / sqrt(ax^2 wx^2 + ay^2 wy^2)
//
// Parameters: alpha_x, alpha_y > 0, sqrt(2) times the standard deviation of the slopes along x and
// y. Lambda is exact; the rational fit of Walter et al. 2007 (eq. 27), used by many renderers, is
// off by up to 0.35 %, which the density of visible normals would inherit. Visible normals are
// drawn by inverting the distribution function of their slopes with Newton's method.
#include "nacre/reflectance/microfacet.h"

namespace nacre {

/// D: directions; A: roughness.
template <class D, class A = D>
struct Beckmann {
    using Number = D;
    using Value = Product<D, A>;

    A alpha_x, alpha_y;

    /// Density of facet normals, sr^-1; 0 below the horizon.
    Value density(const Vec3<D>& h) const {
        using std::exp;
        const Value x = h.x / alpha_x, y = h.y / alpha_y;
        const D z2 = at_least(D(h.z * h.z), 1e-8);
        const D upper = select(h.z > D(1e-4), D(1), D(0));
        return upper * exp(-(x * x + y * y) / z2) /
               (D(std::numbers::pi) * alpha_x * alpha_y * (z2 * z2));
    }

    /// Smith's Lambda: mean projected area that is hidden over that which is seen.
    Value lambda(const Vec3<D>& w) const {
        using std::erf, std::exp;
        const Value a = microfacet_detail::inverse_slope(w, alpha_x, alpha_y);
        const Value tail = exp(-a * a) / (a * Value(std::sqrt(std::numbers::pi)));
        const Value l = Value(0.5) * (erf(a) - Value(1) + tail);
        return at_least(l, 0.);
    }

    /// A facet normal from all there are: density D(h) h.z.
    Vec3<D> sample_all(Vec2<D> u) const {
        using std::log, std::sqrt;
        return microfacet_detail::normal_of_polar_slope(sqrt(-log(D(1) - u.x)), u.y, alpha_x,
                                                        alpha_y);
    }

    /// A facet normal from those that `w` (w.z > 0) sees: density D(h) G1(w) (w.h) / w.z.
    Vec3<D> sample_visible(const Vec3<D>& w, Vec2<D> u) const {
        using std::sqrt;
        // In the space where alpha is 1, in the frame whose x points along w.
        const Vec3<D> v = normalize(Vec3<D>{alpha_x * w.x, alpha_y * w.y, w.z});
        const D sin_theta = sqrt(v.x * v.x + v.y * v.y);
        const D cos_phi = sin_theta > D(0) ? v.x / sin_theta : D(1);
        const D sin_phi = sin_theta > D(0) ? v.y / sin_theta : D(0);
        const D along = visible_slope(v.z, sin_theta, u.x), across = visible_slope(D(1), D(0), u.y);
        const D x = (cos_phi * along - sin_phi * across) * alpha_x;
        const D y = (sin_phi * along + cos_phi * across) * alpha_y;
        return normalize(Vec3<D>{-x, -y, D(1)});
    }

  private:
    /// Slope x at which the visible part of the standard distribution,
    ///   p(t) = exp(-t^2) (cos - t sin) / sqrt(pi),  t < cot,
    /// has the share u of its integral
    ///   P(x) = cos erfc(-x) / 2 + sin exp(-x^2) / (2 sqrt(pi)).
    /// P is convex below the mode of p and concave above, so Newton's method from there never
    /// overshoots.
    static D visible_slope(D cos_theta, D sin_theta, D u) {
        using std::abs, std::erfc, std::exp, std::sqrt;
        const D inv_sqrt_pi = D(1 / std::sqrt(std::numbers::pi));
        const auto integral = [&](D x) {
            return D(0.5) * (cos_theta * erfc(-x) + sin_theta * inv_sqrt_pi * exp(-x * x));
        };
        const D end = sin_theta > D(0.1) * cos_theta ? cos_theta / sin_theta : D(10);
        // Beyond these shares a float cannot tell the slopes apart.
        const D target = std::clamp(u, D(1e-7), D(1 - 1e-7)) * integral(end);
        D x = -sin_theta / (cos_theta + sqrt(cos_theta * cos_theta + D(2) * sin_theta * sin_theta));
        for (int step = 0; step < 32; ++step) {
            const D slope = (cos_theta - x * sin_theta) * exp(-x * x) * inv_sqrt_pi;
            const D move = (target - integral(x)) / std::max(slope, D(1e-20));
            const D next = std::min(x + move, end);
            const bool done = abs(next - x) < D(1e-6);
            x = next;
            if (done) break;
        }
        return x;
    }
};

}  // namespace nacre
