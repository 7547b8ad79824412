#pragma once
// What the distributions of facet normals have in common: masking, densities of sampled normals.
//
// A distribution offers `density`, `lambda`, `sample_all` and `sample_visible` (see beckmann.h,
// ggx.h). Masking and shadowing are Smith's (B. G. Smith 1967, Geometrical Shadowing of a Random
// Rough Surface, IEEE Trans. AP 15(5)) in the separable form G(wi, wo) = G1(wi) G1(wo), as in
// Walter et al. 2007, eq. 23.
#include <algorithm>

#include "nacre/reflectance/model.h"

namespace nacre {

namespace microfacet_detail {

/// |cot theta| / alpha of a direction, alpha along its azimuth.
template <class D, class A>
Product<D, A> inverse_slope(const Vec3<D>& w, A alpha_x, A alpha_y) {
    using std::sqrt;
    using T = Product<D, A>;
    const T x = w.x * alpha_x, y = w.y * alpha_y;
    // The bounds keep quotients and squares of the result within single precision.
    const T z2 = at_least(T(w.z * w.z), 1e-16), xy2 = at_least(T(x * x + y * y), 1e-16);
    return sqrt(T(z2 / xy2));
}

/// The normal of slope (alpha_x r cos phi, alpha_y r sin phi), phi = 2 pi u.
template <class D, class A>
Vec3<D> normal_of_polar_slope(D r, D u, A alpha_x, A alpha_y) {
    using std::cos, std::sin;
    const D phi = D(2 * std::numbers::pi) * u;
    return normalize(Vec3<D>{alpha_x * r * cos(phi), alpha_y * r * sin(phi), D(1)});
}

}  // namespace microfacet_detail

/// Smith's Lambda of Beckmann's distribution, hidden over seen projected area, by a =
/// cot(theta) / alpha > 0; for small alpha a may be bounded by 30, from where on it is zero.
template <class V>
V smith_beckmann_lambda(const V& a) {
    using std::erfc, std::exp;
    return exp(-a * a) / (V(2. / std::numbers::inv_sqrtpi) * a) - V(0.5) * erfc(a);
}

/// Share of the facets of normal h that `w` sees; 0 where w is behind the facet or the facet's
/// front is on the other side of the surface than w.
template <class Distribution, class D>
typename Distribution::Value smith_g1(const Distribution& distribution, const Vec3<D>& w,
                                      const Vec3<D>& h) {
    using V = typename Distribution::Value;
    const D front = select(dot(w, h) * w.z > D(0), D(1), D(0));
    return front / (V(1) + distribution.lambda(w));
}

/// Density of normals drawn by sample_visible for a direction w with w.z > 0.
template <class Distribution, class D>
typename Distribution::Value visible_density(const Distribution& distribution, const Vec3<D>& w,
                                             const Vec3<D>& h) {
    return smith_g1(distribution, w, h) * distribution.density(h) *
           (dot(w, h) / at_least(w.z, 1e-7));
}

/// Which normals a material draws.
enum class NormalSampling { visible, all };

template <class Distribution, class D>
Vec3<D> sample_normal(const Distribution& distribution, NormalSampling sampling, const Vec3<D>& w,
                      Vec2<D> u) {
    return sampling == NormalSampling::visible ? distribution.sample_visible(w, u)
                                               : distribution.sample_all(u);
}

/// Density of `sample_normal`, per solid angle of h.
template <class Distribution, class D>
typename Distribution::Value normal_pdf(const Distribution& distribution, NormalSampling sampling,
                                        const Vec3<D>& w, const Vec3<D>& h) {
    return sampling == NormalSampling::visible ? visible_density(distribution, w, h)
                                               : distribution.density(h) * h.z;
}

}  // namespace nacre
