#pragma once
// Rough plastic: a matt base below a rough dielectric boundary.
//
//   As in Mitsuba (W. Jakob); the boundary is that of B. Walter et al. 2007 (rough_dielectric.h).
//   f = rs F(wi.h) D(h) G / (4 wi.z wo.z) + rho T(wi.z) T(wo.z) / (pi eta^2 (1 - r Fi))
//
// T is the share of light that passes the rough boundary from outside, Fi the reflectance of the
// boundary to diffuse light from inside, both for single reflection by facets and tabulated over
// the cosine once for each distribution and index (RoughBoundary). r is as in plastic.h.
//
// Parameters: the isotropic distribution; eta > 0, the index inside over outside; reflectance rho
// and specular rs, 0..1. Reciprocal. Conserves energy for rho, rs <= 1. Light that several facets
// reflect counts as transmitted outside, where T = 1 - R, and so is not lost.
//
// The tables are Mitsuba's: T at 64 equally spaced cosines, Fi as twice the plain mean of R mu over
// the same 64 from inside. That mean weighs the end mu = 1 in full and divides by 64 instead of 63,
// so that Fi comes out 1 to 2 % lower than the integral, and the matt part about 2 % darker. Kept,
// since scenes are matched to that renderer's pictures.
//
// Sampling: the boundary's visible normals with the probability `specular_probability`, else the
// cosine.
#include <vector>

#include "nacre/math/quadrature.h"
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/microfacet.h"
#include "nacre/reflectance/plastic.h"

namespace nacre {

/// Share of the light from `w` (w.z > 0) that a boundary of relative index eta (far over near side)
/// mirrors by single reflection from facets: the integral over visible normals h of F(w.h) G1(w',
/// h), w' being w mirrored. `nodes` are used for both numbers of the sampled square.
template <class Distribution>
double rough_reflectance(const Distribution& distribution, const Vec3d& w, double eta,
                         const GaussLegendre& nodes) {
    double sum = 0.;
    for (std::size_t i = 0; i < nodes.node.size(); ++i)
        for (std::size_t j = 0; j < nodes.node.size(); ++j) {
            const Vec2<double> u{0.5 + 0.5 * nodes.node[i], 0.5 + 0.5 * nodes.node[j]};
            const Vec3d h = distribution.sample_visible(w, u);
            const Vec3d out = reflect(w, h);
            if (!(out.z > 0.)) continue;
            sum += 0.25 * nodes.weight[i] * nodes.weight[j] *
                   fresnel_dielectric(std::max(dot(w, h), 0.), eta) *
                   smith_g1(distribution, out, h);
        }
    return sum;
}

/// What rough plastic needs to know of its boundary.
struct RoughBoundary {
    static constexpr int size = 64;
    std::array<float, size> transmittance;  ///< T at the cosines i / 63
    float internal;                         ///< Fi

    /// For a distribution of double numbers.
    template <class Distribution>
    static RoughBoundary compute(const Distribution& distribution, double eta) {
        RoughBoundary boundary;
        // Leaving the denser side, F has a kink at the critical angle, which wants more nodes.
        const GaussLegendre coarse(32), fine(128);
        double internal = 0.;
        for (int i = 0; i < size; ++i) {
            const double mu = std::max(1e-6, double(i) / (size - 1));
            const Vec3d w{std::sqrt(1. - mu * mu), 0., mu};
            boundary.transmittance[i] = static_cast<float>(
                1. - rough_reflectance(distribution, w, eta, eta > 1. ? coarse : fine));
            internal += 2. * mu / size *
                        rough_reflectance(distribution, w, 1. / eta, eta > 1. ? fine : coarse);
        }
        boundary.internal = static_cast<float>(internal);
        return boundary;
    }

    float transmittance_at(float cosine) const {
        const float x = std::clamp(cosine, 0.f, 1.f) * (size - 1);
        const int i = std::min(int(x), size - 2);
        const float t = x - float(i);
        return (1.f - t) * transmittance[i] + t * transmittance[i + 1];
    }
};

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
