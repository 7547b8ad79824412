#pragma once
// The GGX distribution of facet normals: that of the normals of an ellipsoid, with long tails.
//
//   T. S. Trowbridge, K. P. Reitz 1975, Average Irregularity Representation of a Rough Surface for
//   Ray Reflection, JOSA 65(5).
//   B. Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces, EGSR, eq.
//   33-36.
//   E. Heitz 2014, Understanding the Masking-Shadowing Function, JCGT 3(2), section 5 (anisotropy).
//   J. Dupuy, A. Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps, CGF 42(8); the
//   same density as E. Heitz 2018, Sampling the GGX Distribution of Visible Normals, JCGT 7(4).
//
//   D(h) = 1 / (pi ax ay (hx^2/ax^2 + hy^2/ay^2 + hz^2)^2)
//   Lambda(w) = (sqrt(1 + 1/a^2) - 1) / 2,  a = |wz| / sqrt(ax^2 wx^2 + ay^2 wy^2)
//
// Parameters: alpha_x, alpha_y > 0, the slopes along x and y above which half of the facets lie.
#include "nacre/reflectance/microfacet.h"

namespace nacre {

/// D: directions; A: roughness.
template <class D, class A = D>
struct Ggx {
    using Number = D;
    using Value = Product<D, A>;

    A alpha_x, alpha_y;

    /// Density of facet normals, sr^-1; 0 below the horizon.
    Value density(const Vec3<D>& h) const {
        const Value x = h.x / alpha_x, y = h.y / alpha_y;
        // At least 0.4 for a unit vector; the half vector of opposite directions is none.
        const Value r = at_least(Value(x * x + y * y + h.z * h.z), 1e-6);
        const D upper = select(h.z > D(0), D(1), D(0));
        return upper / (D(std::numbers::pi) * alpha_x * alpha_y * (r * r));
    }

    /// Smith's Lambda: mean projected area that is hidden over that which is seen.
    Value lambda(const Vec3<D>& w) const {
        using std::sqrt;
        const Value a = microfacet_detail::inverse_slope(w, alpha_x, alpha_y);
        // (sqrt(1 + t) - 1) / 2 without the difference of like numbers.
        const Value t = Value(1) / (a * a);
        return Value(0.5) * t / (Value(1) + sqrt(Value(1) + t));
    }

    /// A facet normal from all there are: density D(h) h.z.
    Vec3<D> sample_all(Vec2<D> u) const {
        using std::sqrt;
        return microfacet_detail::normal_of_polar_slope(sqrt(u.x / (D(1) - u.x)), u.y, alpha_x,
                                                        alpha_y);
    }

    /// A facet normal from those that `w` (w.z > 0) sees: density D(h) G1(w) (w.h) / w.z.
    Vec3<D> sample_visible(const Vec3<D>& w, Vec2<D> u) const {
        using std::cos, std::sin, std::sqrt;
        const Vec3<D> v = normalize(Vec3<D>{alpha_x * w.x, alpha_y * w.y, w.z});
        // The rays that a hemisphere mirrors to v come uniformly from a spherical cap around it.
        const D phi = D(2 * std::numbers::pi) * u.x;
        const D z = (D(1) - u.y) * (D(1) + v.z) - v.z;
        const D r = sqrt(std::max(D(0), D(1) - z * z));
        const Vec3<D> h = Vec3<D>{r * cos(phi), r * sin(phi), z} + v;
        return normalize(Vec3<D>{alpha_x * h.x, alpha_y * h.y, std::max(h.z, D(1e-7))});
    }
};

}  // namespace nacre
