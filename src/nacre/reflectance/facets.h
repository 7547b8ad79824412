#pragma once
// Mirror facets by the million: what Torrance-Sparrow, Blinn and Cook-Torrance have in common.
//
//   f = kd/pi + ks F(u) D(h) G / (4 wi.z wo.z),  h = (wi + wo)/|wi + wo|,  u = wi.h = |wi + wo|/2
//
// D is the density of facet normals, int D(h) h.z dh = 1; the 4 is the Jacobian dw = 4 u dh of the
// reflection. Written by T = tan^2 of the angle theta between h and the normal, t = cos(theta):
//   beckmann          D = exp(-T/m^2) / (pi m^2 t^4)         m: sqrt(2) times the slope deviation
//   gauss             D = C exp(-theta^2 / (2 m^2))          m: radians
//   phong             D = (m+2)/(2 pi) t^m                   m: exponent
//   trowbridge_reitz  D = m^2 / (pi (t^2 (m^2-1) + 1)^2)     today's GGX, alpha = m
// and sums of up to three such terms. Sampling: normals with the density D h.z, mirrored; the
// Gaussian, which has no inverse in closed form, by that of angles, theta exp(-theta^2/(2 m^2)).
#include "nacre/math/quadrature.h"
#include "nacre/math/warp.h"
#include "nacre/reflectance/facet_fresnel.h"
#include "nacre/reflectance/microfacet.h"

namespace nacre {

enum class FacetDistribution { beckmann, gauss, phong, trowbridge_reitz };
enum class FacetMasking { v_cavity, smith, smith_correlated, sancer, none };

namespace facet_detail {

/// tan^2 of the angle between a vector of any length and the normal.
template <class D>
D tangent2(const Vec3<D>& h) {
    return (h.x * h.x + h.y * h.y) / at_least(D(h.z * h.z), 1e-12);
}

/// C of the Gaussian: 1/C = pi int_0^{pi/2} sin(2 a) exp(-a^2 / (2 m^2)) da. Nine deviations hold
/// all but 1e-17 of the integral, and 32 nodes integrate it to rounding.
template <class S>
S gauss_constant(S m) {
    using std::exp, std::sin;
    static const GaussLegendre nodes(32);
    const S all = S(std::numbers::pi / 2), nine = S(9) * m;
    const S half = S(0.5) * select(nine < all, nine, all);
    S sum = S(0);
    for (std::size_t i = 0; i < nodes.node.size(); ++i) {
        const S a = half * S(1. + nodes.node[i]), x = a / m;
        sum += S(nodes.weight[i]) * sin(S(2) * a) * exp(S(-0.5) * x * x);
    }
    return S(inv_pi) / (half * sum);
}

/// D by T = tan^2 theta; `constant` is that of the Gaussian.
template <class D, class S>
Product<D, S> facet_density(FacetDistribution kind, const D& tan2, const S& m, const S& constant) {
    using std::atan2, std::exp, std::log1p, std::sqrt;
    using V = Product<D, S>;
    const D sec2 = D(1) + tan2;
    switch (kind) {
        case FacetDistribution::gauss: {
            const V x = V(D(atan2(D(sqrt(tan2)), D(1)))) / V(m);
            return V(constant) * exp(V(V(D(-0.5)) * x * x));
        }
        case FacetDistribution::phong:
            return V((m + S(2)) * S(0.5 * inv_pi)) * exp(V(V(m) * V(D(-0.5) * log1p(tan2))));
        case FacetDistribution::trowbridge_reitz: {
            const V m2 = V(m * m), q = V(sec2) / (m2 + V(tan2));
            return V(D(inv_pi)) * m2 * q * q;
        }
        case FacetDistribution::beckmann:
            break;
    }
    const V m2 = V(m * m);
    return exp(V(V(-tan2) / m2)) * V(D(inv_pi) * sec2 * sec2) / m2;
}

/// D at the normal.
template <class S>
S facet_peak(FacetDistribution kind, S m, S constant) {
    if (kind == FacetDistribution::gauss) return constant;
    if (kind == FacetDistribution::phong) return (m + S(2)) * S(0.5 * inv_pi);
    return S(inv_pi) / (m * m);
}

/// Density of sampled normals per solid angle: D h.z, of the Gaussian that of its angles.
template <class D, class S>
Product<D, S> normal_density(FacetDistribution kind, const D& tan2, const S& m, const S& constant) {
    using std::atan2, std::exp, std::expm1, std::sqrt;
    using V = Product<D, S>;
    const D cosine = D(1) / sqrt(D(1) + tan2);
    if (kind != FacetDistribution::gauss) return V(cosine) * facet_density(kind, tan2, m, constant);
    const D tan = sqrt(at_least(tan2, 1e-20)), theta = atan2(tan, D(1));
    const V x = V(theta) / V(m);
    const S whole = -expm1(S(-std::numbers::pi * std::numbers::pi / 8) / (m * m));
    return V(theta / (tan * cosine)) * exp(V(V(D(-0.5)) * x * x)) /
           V(S(2 * std::numbers::pi) * m * m * whole);
}

/// tan(theta) of a sampled normal.
template <class D, class S>
D sample_tangent(FacetDistribution kind, D u, S m) {
    using std::exp, std::expm1, std::log, std::sqrt, std::tan;
    const D rest = D(1) - u;
    switch (kind) {
        case FacetDistribution::gauss: {
            const D whole = -expm1(D(-std::numbers::pi * std::numbers::pi / 8) / (m * m));
            return tan(m * sqrt(D(-2) * log(D(1) - u * whole)));
        }
        case FacetDistribution::phong:
            return sqrt(expm1(D(-2) * log(rest) / (m + D(2))));
        case FacetDistribution::trowbridge_reitz:
            return m * sqrt(u / rest);
        case FacetDistribution::beckmann:
            break;
    }
    return m * sqrt(-log(rest));
}

/// The slope m of the Beckmann distribution that is as wide at the normal.
template <class S>
S equivalent_slope(FacetDistribution kind, S m) {
    using std::sqrt;
    if (kind == FacetDistribution::gauss) return S(std::numbers::sqrt2) * m;
    if (kind == FacetDistribution::phong) return sqrt(S(2) / (m + S(2)));
    return m;
}

/// Lambda of B. G. Smith 1967: hidden over seen projected area, from m tan(theta).
template <class V>
V lambda_beckmann(const V& m_tan) {
    const V inverse = V(1) / m_tan;
    return smith_beckmann_lambda(V(select(inverse < V(30), inverse, V(30))));
}
template <class V>
V lambda_trowbridge_reitz(const V& m_tan) {
    using std::sqrt;
    const V q = m_tan * m_tan;
    return V(0.5) * q / (V(1) + sqrt(V(1) + q));
}

/// tan of the angle between w and the normal, within [1e-12, 1e7].
template <class D>
D bounded_tangent(const Vec3<D>& w) {
    using std::sqrt;
    return sqrt(at_least(D(w.x * w.x + w.y * w.y), 1e-24)) / at_least(w.z, 1e-7);
}

/// G of V-shaped grooves of equal slopes (Torrance and Sparrow 1967, in Blinn's form of 1977):
/// min(1, 2 t wi.z / u, 2 t wo.z / u).
template <class D>
D v_cavity(const Vec3<D>& wi, const Vec3<D>& wo) {
    const Vec3<D> h = wi + wo;
    const D less = select(wi.z < wo.z, wi.z, wo.z);
    const D g = D(4) * h.z * less / at_least(dot(h, h), 1e-12);
    return select(g < D(1), g, D(1));
}

}  // namespace facet_detail

// The half-height angle beta (radians, in (0, pi/2)), at which D is half of D at the normal: J. F.
// Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH; the
// Beckmann distribution: R. Hall 1989, Illumination and Color in Computer Generated Imagery. That
// one has its peak off the normal for m > 1/sqrt(2).
template <class S>
S width_of_half_height(FacetDistribution kind, S beta) {
    using std::cos, std::log, std::sqrt, std::tan;
    const S c = cos(beta), c2 = c * c;
    switch (kind) {
        case FacetDistribution::gauss:  // C1 = sqrt(ln 2)/beta, exp(-(C1 theta)^2)
            return beta / S(std::sqrt(2. * std::numbers::ln2));
        case FacetDistribution::phong:
            return S(-std::numbers::ln2) / log(c);
        case FacetDistribution::trowbridge_reitz:
            return sqrt((S(1) - c2) / (S(std::numbers::sqrt2) - c2));
        case FacetDistribution::beckmann:
            break;
    }
    return tan(beta) / sqrt(-log(S(0.5) * c2 * c2));
}
/// Hall's other rule for Beckmann's m, (1 + sqrt(tan beta)) / (2 sqrt(pi)): not half height, but
/// exp(-T/m^2) / (4 pi m^2 t^4) stays below 1, so that old displays did not clip.
template <class S>
S width_unclipped(S beta) {
    using std::sqrt, std::tan;
    return (S(1) + sqrt(tan(beta))) * S(0.5 * std::numbers::inv_sqrtpi);
}

/// The reflectance of such a surface; the models derive from it and say which members the user
/// sets.
template <class D, class P, class S>
struct FacetReflection {
    FacetDistribution distribution = FacetDistribution::beckmann;
    FacetMasking masking = FacetMasking::v_cavity;
    FacetFresnel<P, S> fresnel;
    P kd, ks;
    S m[3] = {S(1), S(1), S(1)}, weight[3] = {S(1), S(1), S(1)};
    int terms = 1;   ///< of D: how many of m and weight count
    S scale = S(1);  ///< of the highlight, for conventions

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        using V = Product<D, S>;
        const Vec3<D> h = wi + wo;
        const D tan2 = facet_detail::tangent2(h), u = D(0.5) * sqrt(dot(h, h));
        V density = V(D(0));
        for (int j = 0; j < terms; ++j)
            density +=
                V(weight[j]) * facet_detail::facet_density(distribution, tan2, m[j], constant_[j]);
        const V g = shadowing(wi, wo) * V(D(0.25) / at_least(D(wi.z * wo.z), 1e-14));
        return above(wi, wo) * (D(inv_pi) * kd + V(V(scale) * density * g) * (ks * fresnel.at(u)));
    }
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        using std::cos, std::sin;
        const D share = highlight_share(wo);
        if (!(u1 < share)) return square_to_cosine_hemisphere(u2);
        const D pick = u1 / share;
        const int j = pick < D(weight[0]) ? 0 : pick < D(weight[0] + weight[1]) ? 1 : 2;
        const D tan = facet_detail::sample_tangent(distribution, u2.x, m[std::min(j, terms - 1)]);
        const D phi = D(2 * std::numbers::pi) * u2.y;
        return reflect(wo, normalize(Vec3<D>{tan * cos(phi), tan * sin(phi), D(1)}));
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        const Vec3<D> h = wi + wo;
        const D tan2 = facet_detail::tangent2(h);
        D lobe = D(0);
        for (int j = 0; j < terms; ++j)
            lobe +=
                D(weight[j]) * facet_detail::normal_density(distribution, tan2, m[j], constant_[j]);
        const D share = highlight_share(wo), length = sqrt(at_least(dot(h, h), 1e-20));
        return above(wi, wo) * (share * lobe * D(0.5) / length + (D(1) - share) * D(inv_pi) * wi.z);
    }

    /// Relative weights become shares; what D needs is computed.
    void prepare() {
        S sum = S(0);
        for (int j = 0; j < terms; ++j) sum += weight[j];
        for (int j = 0; j < terms; ++j) {
            weight[j] = weight[j] / at_least(sum, 1e-30);
            constant_[j] = distribution == FacetDistribution::gauss
                               ? facet_detail::gauss_constant(m[j])
                               : S(0);
        }
    }
    /// D at the normal.
    S peak() const {
        S sum = S(0);
        for (int j = 0; j < terms; ++j)
            sum += weight[j] * facet_detail::facet_peak(distribution, m[j], constant_[j]);
        return sum;
    }

  private:
    S constant_[3] = {};

    /// Smith's Lambda is linear in the distribution of slopes, so that of a sum is the sum.
    template <class V>
    V lambda(const Vec3<D>& w) const {
        const V tan = V(facet_detail::bounded_tangent(w));
        V sum = V(D(0));
        for (int j = 0; j < terms; ++j) {
            const V x = tan * V(facet_detail::equivalent_slope(distribution, m[j]));
            sum += V(weight[j]) * (distribution == FacetDistribution::trowbridge_reitz &&
                                           masking != FacetMasking::sancer
                                       ? facet_detail::lambda_trowbridge_reitz(x)
                                       : facet_detail::lambda_beckmann(x));
        }
        return sum;
    }
    Product<D, S> shadowing(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using V = Product<D, S>;
        switch (masking) {
            case FacetMasking::v_cavity:
                return V(facet_detail::v_cavity(wi, wo));
            case FacetMasking::none:
                return V(D(1));
            case FacetMasking::smith:
                return V(D(1)) / ((V(D(1)) + lambda<V>(wi)) * (V(D(1)) + lambda<V>(wo)));
            case FacetMasking::smith_correlated:
            case FacetMasking::sancer:
                break;
        }
        return V(D(1)) / (V(D(1)) + lambda<V>(wi) + lambda<V>(wo));
    }
    D highlight_share(const Vec3<D>& wo) const {
        return D(specular_share(kd, P(ks * fresnel.at(at_least(wo.z, 0.)))));
    }
};

}  // namespace nacre
