#pragma once
// Light that is scattered exactly once below the surface, for renderers that follow the refracted
// view ray and connect its points to lights.
//
//   H. W. Jensen, S. Marschner, M. Levoy, P. Hanrahan 2001, A Practical Model for Subsurface Light
//   Transport, SIGGRAPH 2001, section 2.3; P. Hanrahan, W. Krueger 1993, Reflection from Layered
//   Surfaces due to Subsurface Scattering, SIGGRAPH 93.
//
// At distance s_o along the refracted view ray, with the light's way through the medium s_i' long:
//   L_o = integral over s_o of sigma_s p(cos) e^(-sigma_t (s_i' + s_o)) T_i T_o / eta^2 E_i / mu_i'
// where E_i is the light's irradiance on the surface (W mm^-2), T_i and T_o the Fresnel
// transmittances of entry and exit, mu_i' the inner cosine of the light, and cos the cosine between
// the directions of propagation before and after. sigma_s and g are the full ones, not reduced. The
// eta^2 that radiance gains inside is in E_i / mu_i' already; the one that it loses outwards is
// 1 / eta^2.
//
// Templates over the number type: float, double, four wavelengths.
#include <cmath>
#include <type_traits>

#include "nacre/math/lanes.h"
#include "nacre/math/lanes_math.h"
#include "nacre/math/vec.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/phase_henyey_greenstein.h"

namespace nacre {

namespace single_scattering_detail {

/// Henyey and Greenstein's function for numbers and, a lane at a time, for packs.
template <class T>
T phase(T g, T cos_theta) {
    if constexpr (std::is_floating_point_v<T>) {
        return HenyeyGreensteinPhase<T>{g}.eval(cos_theta);
    } else {
        T value;
        for (int i = 0; i < T::size; ++i) value.set(i, phase(g[i], cos_theta[i]));
        return value;
    }
}

}  // namespace single_scattering_detail

/// s_i': the refracted way of light, from the distance s_i (mm) from the point to the surface in
/// the unrefracted direction to the light, whose cosine with the normal there is cos_i: exact where
/// the surface is flat.
template <class T>
T refracted_light_distance(T s_i, T cos_i, T eta) {
    return s_i * cos_i / refracted_cosine(cos_i, eta);
}

/// sigma_tc with e^(-sigma_tc s_o) = e^(-sigma_t s_i') e^(-sigma_t s_o) under a flat surface, where
/// `geometry` is G = |n . wo'| / |n . wi'|; the extinctions may differ at exit and entry
/// (textures).
template <class T, class G>
T combined_extinction(T sigma_t_exit, T sigma_t_entry, G geometry) {
    return sigma_t_exit + T(geometry) * sigma_t_entry;
}

template <class T>
struct SingleScattering {
    T sigma_s, sigma_t;  ///< mm^-1, sigma_t > 0
    T g;                 ///< mean cosine, in (-1, 1)

    /// The integrand above without T_i T_o / eta^2 E_i / mu_i', in mm^-1 sr^-1.
    T integrand(T s_o, T s_i_refracted, T cos_theta) const {
        using std::exp;
        return sigma_s * single_scattering_detail::phase(g, cos_theta) *
               exp(-sigma_t * (s_i_refracted + s_o));
    }

    /// BRDF (sr^-1) of the once-scattered light of a half space below a smooth surface, the
    /// integral above over s_o from 0 to infinity: Hanrahan and Krueger's first order for infinite
    /// depth,
    ///   W p T_i T_o / (eta^2 (mu_i' + mu_o')).
    /// Directions away from the surface, z > 0, or 0 is returned.
    T half_space_brdf(const Vec3<T>& wi, const Vec3<T>& wo, T eta) const {
        const T mu_i = refracted_cosine(wi.z, eta), mu_o = refracted_cosine(wo.z, eta);
        // Tangential components shrink by eta; light arrives along -wi' and leaves along wo'.
        const T cos_theta = -(wi.x * wo.x + wi.y * wo.y) / (eta * eta) - mu_i * mu_o;
        const T through =
            (T(1) - fresnel_dielectric(wi.z, eta)) * (T(1) - fresnel_dielectric(wo.z, eta));
        const T value = sigma_s / sigma_t * single_scattering_detail::phase(g, cos_theta) *
                        through / (eta * eta * (mu_i + mu_o));
        return select((wi.z > T(0)) & (wo.z > T(0)), value, T(0));
    }
};

/// Distance along the view ray with density sigma_t e^(-sigma_t s), from u in [0, 1); for one
/// channel.
template <class T>
T sample_scattering_distance(T sigma_t, T u) {
    using std::log1p;
    return -log1p(-u) / sigma_t;
}

}  // namespace nacre
