#pragma once
// Rough boundary between two clear media: reflection and refraction by facets.
//
//   B. Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces, EGSR, eq.
//   16-21.
//
//   reflected    f = F D(h) G / (4 |wi.z| |wo.z|),                     h ~ wi + wo
//   refracted    f = (1 - F) D(h) G |wi.h| |wo.h| / (|wi.z| |wo.z| (wo.h + e wi.h)^2)
//                                                                      h ~ wo + e wi
// with e the index on the side of wi over that on the side of wo, h turned to the side of the
// normal. This is the form for radiance (eq. 21 with i = wi, o = wo). Both directions may lie on
// either side of the surface.
//
// Parameters: the distribution of normals; eta > 0, the index inside (z < 0) over that outside;
// reflectance, transmittance, 0..1, factors without physical meaning. Reciprocal in reflection; in
// transmission n_i^2 f(wi, wo) = n_o^2 f(wo, wi) with n the index on the side of each direction.
// Loses the light that is scattered by several facets. Sampling: a normal seen from wo (or any),
// then reflection with probability F.
//
// Only scalars make sense here: the refracted direction of each wavelength is its own.
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/microfacet.h"

namespace nacre {

template <class D, class P, class Distribution>
struct RoughDielectric {
    Distribution distribution;
    D eta;
    P reflectance, transmittance;
    NormalSampling sampling = NormalSampling::visible;

    Product<D, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const Geometry g = geometry(wi, wo);
        const auto facets = distribution.density(g.h) * smith_g1(distribution, wi, g.h) *
                            smith_g1(distribution, wo, g.h) / at_least(abs_(wi.z * wo.z), 1e-12);
        const D f = g.fresnel;
        const auto reflected = facets * (g.same_side * D(0.25) * f);
        const auto refracted =
            facets * ((D(1) - g.same_side) * (D(1) - f) * g.jacobian * abs_(g.cos_o) / (g.e * g.e));
        return reflected * reflectance + refracted * transmittance;
    }
    /// `u1` decides between reflection and refraction; the result is the zero vector where nothing
    /// is scattered.
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u) const {
        const D side = wo.z >= D(0) ? D(1) : D(-1);
        const Vec3<D> h = sample_normal(distribution, sampling, wo * side, u) * side;
        const D cos_o = dot(wo, h);
        if (!(cos_o > D(0))) return {};
        const D e = wo.z >= D(0) ? eta : D(1) / eta;
        const bool mirrored = u1 < fresnel_dielectric(cos_o, e);
        const Vec3<D> wi = mirrored ? reflect(wo, h) : refract(wo, h, e);
        return (wi.z * wo.z > D(0)) == mirrored ? wi : Vec3<D>{};
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const Geometry g = geometry(wi, wo);
        const D side = select(wo.z >= D(0), D(1), D(-1));
        // Back-facing facets are not drawn.
        const D front =
            select(g.cos_o * side > D(0), D(1), D(0)) * select(g.cos_i * wi.z > D(0), D(1), D(0));
        const D normal = normal_pdf(distribution, sampling, wo * side, g.h);
        const D mirrored = g.same_side * g.fresnel / at_least(D(D(4) * abs_(g.cos_o)), 1e-7);
        const D bent = (D(1) - g.same_side) * (D(1) - g.fresnel) * g.jacobian;
        return front * normal * (mirrored + bent);
    }

  private:
    struct Geometry {
        Vec3<D> h;       ///< facet normal on the side of the surface's normal
        D cos_i, cos_o;  ///< of wi and wo with h
        D e;             ///< index on the side of wi over that of wo
        D same_side;     ///< 1 if reflected, else 0
        D fresnel;
        D jacobian;  ///< of h with respect to a refracted wi (Walter et al. 2007, eq. 17)
    };

    static D abs_(D x) { return select(x < D(0), D(-x), x); }

    Geometry geometry(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        Geometry g;
        const D e_far = select(wo.z >= D(0), eta, D(D(1) / eta));
        g.same_side = select(wi.z * wo.z > D(0), D(1), D(0));
        g.e = g.same_side + (D(1) - g.same_side) * e_far;
        const Vec3<D> sum = wo + wi * g.e;
        const D scale = D(1) / sqrt(at_least(dot(sum, sum), 1e-30));
        g.h = sum * (select(sum.z < D(0), D(-1), D(1)) * scale);
        g.cos_i = dot(wi, g.h);
        g.cos_o = dot(wo, g.h);
        g.fresnel = fresnel_dielectric(abs_(g.cos_o), e_far);
        const D denominator = g.cos_o + g.e * g.cos_i;
        g.jacobian = g.e * g.e * abs_(g.cos_i) / at_least(D(denominator * denominator), 1e-12);
        return g;
    }
};

}  // namespace nacre
