#pragma once
// Plastic: a matt base below a smooth dielectric boundary. This is the matt part; the mirror part
// is the boundary's Fresnel reflectance.
//
//   The plastic of Mitsuba (W. Jakob), which is a Lambert base with the correction of
//   J. L. Saunderson 1942, Calculation of the Color of Pigmented Plastics, JOSA 32(12):
//
//   f = rho (1 - F(wi.z)) (1 - F(wo.z)) / (pi eta^2 (1 - r Fi))
//
// F is the reflectance of the boundary from outside, Fi that of diffuse light from inside
// (fresnel_moments.h: 2 C_1 of eta). The series of reflections between base and boundary gives
// r = rho ("nonlinear", which saturates colours); r = 1 keeps the colour of rho.
//
// Parameters: reflectance rho, 0..1; eta >= 1, the index inside over that outside; internal, the
// value of Fi, 0..1; nonlinear. Reciprocal. Energy: the matt part has the albedo
// (1 - F) rho (1 - Fi) / (1 - r Fi), because the mean reflectance Fe from outside has 1 - Fe =
// eta^2 (1 - Fi); so with rho = 1 nothing is lost in any direction, whatever r. Sampling:
// proportional to the cosine.
#include "nacre/math/warp.h"
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/model.h"

namespace nacre {

template <class D, class P = D>
struct Plastic {
    P reflectance;
    D eta;
    D internal;
    bool nonlinear = false;

    Product<D, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const D through = (D(1) - fresnel_dielectric(at_least(wi.z, 0.), eta)) *
                          (D(1) - fresnel_dielectric(at_least(wo.z, 0.), eta));
        return scattered(above(wi, wo) * through);
    }
    Vec3<D> sample(const Vec3<D>&, Vec2<D> u) const { return square_to_cosine_hemisphere(u); }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const { return above(wi, wo) * D(inv_pi) * wi.z; }

    /// The matt part if the shares that pass the boundary on the way in and out have the product
    /// `through`; their smoothness does not matter here, so that rough plastic uses it too.
    Product<D, P> scattered(D through) const {
        using T = Product<D, P>;
        const T r = nonlinear ? T(reflectance) : T(D(1));
        return reflectance * (through * D(inv_pi) / (eta * eta)) / (T(D(1)) - r * internal);
    }
};

}  // namespace nacre
