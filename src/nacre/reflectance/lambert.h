#pragma once
// Lambert: the ideal matt surface.
//
//   J. H. Lambert 1760, Photometria; notation of S. Chandrasekhar 1950, Radiative Transfer.
//   f = rho / pi
//
// Parameter: rho, the albedo, 0..1, no unit. Reciprocal. Conserves energy for rho <= 1: its albedo
// is rho for every direction. Sampling: proportional to the cosine, so the weight is rho.
#include "nacre/math/warp.h"
#include "nacre/reflectance/model.h"

namespace nacre {

template <class D, class P = D>
struct Lambert {
    P reflectance;  ///< albedo, 0..1

    Product<D, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        return (above(wi, wo) * D(inv_pi)) * reflectance;
    }
    Vec3<D> sample(const Vec3<D>&, Vec2<D> u) const { return square_to_cosine_hemisphere(u); }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const { return above(wi, wo) * D(inv_pi) * wi.z; }
};

}  // namespace nacre
