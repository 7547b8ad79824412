#pragma once
// How much light a rough dielectric boundary lets pass, tabulated for rough plastic.
#include <algorithm>
#include <array>

#include "nacre/reflectance/beckmann.h"
#include "nacre/reflectance/ggx.h"

namespace nacre {

/// Share of the light from `w` (w.z > 0) that a boundary of relative index eta (far over near side)
/// mirrors by single reflection from facets: the integral over the normals h that w sees of F(w.h)
/// G1(w', h), w' being w mirrored by h, with n x n nodes. Light that facets send on to other facets
/// does not count.
template <class Distribution>
double rough_reflectance(const Distribution& distribution, const Vec3d& w, double eta,
                         std::size_t n = 32);

/// A boundary of one isotropic distribution of normals and one index.
///
/// The tables are Mitsuba's: the transmittance at 64 equally spaced cosines, the internal
/// reflectance as twice the plain mean of R mu over the same 64 from inside. That mean weighs the
/// end mu = 1 in full and divides by 64 instead of 63, so that the result is 1 to 2 % lower than
/// the integral, and a matt base below the boundary about 2 % darker. Kept, since scenes are
/// matched to pictures of that renderer.
struct RoughBoundary {
    static constexpr int size = 64;
    std::array<float, size> transmittance;  ///< from outside, at the cosines i / 63
    float internal;                         ///< reflectance of diffuse light inside

    /// `eta` > 0 is the index inside over outside. Takes about 0.1 s.
    template <class Distribution>
    RoughBoundary(const Distribution& distribution, double eta);

    float transmittance_at(float cosine) const {
        const float x = std::clamp(cosine, 0.f, 1.f) * (size - 1);
        const int i = std::min(int(x), size - 2);
        const float t = x - float(i);
        return (1.f - t) * transmittance[i] + t * transmittance[i + 1];
    }
};

// Compiled once for these distributions.
extern template RoughBoundary::RoughBoundary(const Beckmann<double>&, double);
extern template RoughBoundary::RoughBoundary(const Ggx<double>&, double);
extern template double rough_reflectance(const Beckmann<double>&, const Vec3d&, double,
                                         std::size_t);
extern template double rough_reflectance(const Ggx<double>&, const Vec3d&, double, std::size_t);

}  // namespace nacre
