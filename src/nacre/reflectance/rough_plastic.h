#pragma once
// Rough plastic: a matt base below a rough dielectric boundary.
//
//   As in Mitsuba (W. Jakob); the boundary is that of B. Walter et al. 2007 (rough_dielectric.h).
//   f = rs F(wi.h) D(h) G / (4 wi.z wo.z) + rho T(wi.z) T(wo.z) / (pi eta^2 (1 - r Fi))
//
// T is the share of light that passes the rough boundary from outside, Fi the reflectance of the
// boundary to diffuse light from inside, both for single reflection by facets and tabulated over
// the cosine once for each distribution and index (rough_boundary.h). r is as in plastic.h.
//
// Parameters: the isotropic distribution; eta > 0, the index inside over outside; reflectance rho
// and specular rs, 0..1. Reciprocal. Conserves energy for rho, rs <= 1. Light that several facets
// reflect counts as transmitted outside, where T = 1 - R, and so is not lost.
//
// Sampling: the boundary's visible normals with the probability `specular_probability`, else the
// cosine.
#include "nacre/reflectance/plastic.h"
#include "nacre/reflectance/rough_boundary.h"

namespace nacre {

template <class P, class Distribution>
struct RoughPlastic {
    Distribution distribution;
    Plastic<float, P> base;  ///< its `internal` is the boundary's
    P specular;
    const RoughBoundary* boundary;
    float specular_weight;  ///< share of the samples that goes to the mirror part at T = 1/2
    NormalSampling sampling = NormalSampling::visible;

    P eval(const Vec3f& wi, const Vec3f& wo) const {
        const Vec3f h = half_vector(wi, wo);
        const float mirrored = above(wi, wo) * distribution.density(h) *
                               smith_g1(distribution, wi, h) * smith_g1(distribution, wo, h) *
                               fresnel_dielectric(at_least(dot(wi, h), 0.), base.eta) /
                               at_least(4.f * wi.z * wo.z, 1e-12);
        const float through =
            above(wi, wo) * boundary->transmittance_at(wi.z) * boundary->transmittance_at(wo.z);
        return mirrored * specular + base.scattered(through);
    }
    float specular_probability(const Vec3f& wo) const {
        const float t = boundary->transmittance_at(wo.z);
        const float mirror = (1.f - t) * specular_weight, matt = t * (1.f - specular_weight);
        return mirror / at_least(mirror + matt, 1e-30);
    }
    /// `u1` chooses the part.
    Vec3f sample(const Vec3f& wo, float u1, Vec2f u) const {
        return u1 < specular_probability(wo)
                   ? reflect(wo, sample_normal(distribution, sampling, wo, u))
                   : square_to_cosine_hemisphere(u);
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const {
        const Vec3f h = half_vector(wi, wo);
        const float p = specular_probability(wo);
        return above(wi, wo) *
               (p * normal_pdf(distribution, sampling, wo, h) / at_least(4.f * dot(wo, h), 1e-7) +
                (1.f - p) * float(inv_pi) * wi.z);
    }
};

}  // namespace nacre
