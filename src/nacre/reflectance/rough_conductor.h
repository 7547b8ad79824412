#pragma once
// Rough metal: single reflection from facets of a conductor.
//
//   B. Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces, EGSR, eq. 20,
//   with the Fresnel equations of a complex index (optics/fresnel.h); the form goes back to
//   K. E. Torrance, E. M. Sparrow 1967, JOSA 57(9).
//
//   f = F(wi.h) D(h) G(wi, wo) / (4 wi.z wo.z)
//
// Parameters: the distribution of normals (beckmann.h, ggx.h); eta >= 0 and k >= 0, the index eta +
// i k relative to the medium outside, no unit; reflectance, 0..1, a factor without physical
// meaning. Reciprocal. Its albedo is at most 1 for every roughness and below 1 even for F = 1:
// light that facets pass on to other facets is lost. Sampling: normals that wo sees (or all),
// mirrored.
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/microfacet.h"

namespace nacre {

template <class D, class P, class Distribution>
struct RoughConductor {
    Distribution distribution;
    P eta, k;
    P reflectance;
    NormalSampling sampling = NormalSampling::visible;

    Product<D, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const Vec3<D> h = half_vector(wi, wo);
        const auto value = above(wi, wo) * distribution.density(h) * smith_g1(distribution, wi, h) *
                           smith_g1(distribution, wo, h) / at_least(D(D(4) * wi.z * wo.z), 1e-12);
        return value * reflectance * fresnel_conductor(at_least(dot(wi, h), 0.), eta, k);
    }
    Vec3<D> sample(const Vec3<D>& wo, Vec2<D> u) const {
        return reflect(wo, sample_normal(distribution, sampling, wo, u));
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const Vec3<D> h = half_vector(wi, wo);
        return above(wi, wo) * normal_pdf(distribution, sampling, wo, h) /
               at_least(D(D(4) * dot(wo, h)), 1e-7);
    }
};

}  // namespace nacre
