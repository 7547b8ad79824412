#pragma once
// What all reflectance models have in common.
//
// A model is a struct template over its number types, one model a file:
//
//   template <class D, class P>       // D: directions; P: parameters
//   struct Name {
//       P parameter;                  // public, documented: meaning, range, unit
//       Product<D, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const;   // BRDF, sr^-1, no cosine
//       Vec3<D> sample(const Vec3<D>& wo, Vec2<D> u) const;               // draws wi
//       D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const;                // its density, sr^-1
//   };
//
// `eval` and `pdf` contain no branches on values, so that the same source runs on one direction and
// four wavelengths (D = float, P = Spectral), on packs of directions, on double, and on dual
// numbers. Where a model is undefined (below the horizon) it is zero: write `above` for that and
// keep denominators away from zero with `at_least`, since a product with zero does not stop a NaN.
// `sample` maps u in [0,1)^2 to wi, on plain numbers; it may return directions below the horizon,
// whose value is zero. Directions are unit vectors in the local frame (z = normal), wi to the
// light, wo to the viewer.
#include <cmath>
#include <numbers>

#include "nacre/math/lanes.h"
#include "nacre/math/vec.h"

namespace nacre {

/// The number type of a product of a D and a P: float times Spectral is Spectral.
template <class D, class P>
using Product = decltype(std::declval<D>() * std::declval<P>());

inline constexpr double inv_pi = std::numbers::inv_pi;

/// 1 where both directions are above the horizon, else 0.
template <class D>
D above(const Vec3<D>& wi, const Vec3<D>& wo) {
    return select(wi.z > D(0), D(1), D(0)) * select(wo.z > D(0), D(1), D(0));
}

/// The larger of x and a bound that keeps what is divided by it finite.
template <class D>
D at_least(D x, double bound) {
    return select(x > D(bound), x, D(bound));
}

/// Unit half vector of two directions; finite (but meaningless) where they are opposite.
template <class D>
Vec3<D> half_vector(const Vec3<D>& wi, const Vec3<D>& wo) {
    using std::sqrt;
    const Vec3<D> h = wi + wo;
    return h * (D(1) / sqrt(at_least(dot(h, h), 1e-30)));
}

}  // namespace nacre
