#pragma once
// What all reflectance models have in common.
//
// A model is a struct template over its number types, one model a file:
//
//   template <class D, class P = D, class S = D>  // D: directions; P: colours; S: shape
//   struct Name {
//       P kd;                         // public members: the parameters
//       S n;
//       template <class Self, class F>
//       static void parameters(Self& m, F&& f) { f("kd", m.kd); f("n", m.n); }  // in the order of
//       static const ModelDescription& describe();                             // the description
//       Product<D, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const;  // BRDF, sr^-1, no cosine
//       Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const;  // draws wi; u1 picks the lobe
//       D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const;          // its density, sr^-1
//   };
//
// and may have: `sample(wo, u2)` instead where there is one lobe; `albedo(wi)`, if a closed form is
// known for all parameters; `prepare()`, called once the parameters are set, for what follows from
// them; `mirror(wo)` and `mirror_probability(wo)` for an unblurred mirror part (evaluator.h).
//
// `eval` and `pdf` contain no branches on values (on options they may), so that the same source
// runs on one direction and four wavelengths (D = S = float, P = Spectral), on packs of directions
// (D = Wide, P = S = float), on double, and on dual numbers of the parameters (D = double, P = S =
// Jet; `eval` only). What mixes directions and shape has the type Product<D, S>: convert before
// calling pow(T(x), T(n)). Where a model is undefined (below the horizon) it is zero: write `above`
// for that and keep denominators away from zero with `at_least`, since a product with zero does not
// stop a NaN. `sample` maps numbers in [0, 1) to wi, on plain numbers; it may return directions
// below the horizon, whose value is zero. Directions are unit vectors in the local frame (z =
// normal), wi to the light, wo to the viewer.
#include <cmath>
#include <numbers>

#include "nacre/math/lanes.h"
#include "nacre/math/vec.h"
#include "nacre/reflectance/description.h"

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

/// The mean over wavelengths of a colour: what lobes are chosen by.
template <class P>
auto mean_of(const P& p) {
    if constexpr (requires { P::size; })
        return sum(p) / P::size;
    else
        return p;
}

/// With which probability to draw from the highlight of a model with a diffuse part; 0 if black.
template <class P>
auto specular_share(const P& kd, const P& ks) {
    const auto d = mean_of(kd), s = mean_of(ks);
    using T = std::decay_t<decltype(s)>;
    return s / at_least(T(s + d), 1e-30);
}

/// The direction that mirrors `w` about the normal.
template <class D>
Vec3<D> mirrored(const Vec3<D>& w) {
    return {-w.x, -w.y, w.z};
}

}  // namespace nacre
