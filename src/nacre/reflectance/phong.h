#pragma once
// Phong: a power of the cosine between the viewer and the mirror direction.
//
//   Bui Tuong Phong 1975, Illumination for Computer Generated Pictures, CACM 18(6); as a BRDF:
//   R. R. Lewis 1994, Making Shaders More Physically Plausible, Computer Graphics Forum 13(2).
//
// The formulas are in the description below: Lewis' form, and Phong's intensity over the light's
// cosine.
#include "nacre/math/warp.h"
#include "nacre/reflectance/cosine_lobe.h"

namespace nacre {

enum class PhongVariant { modified, classic };

inline const ModelDescription& phong_description() {
    static const ModelDescription description{
        .name = "phong",
        .title = "Phong",
        .authors = "Bui Tuong Phong; R. R. Lewis",
        .year = 1975,
        .paper = "Illumination for Computer Generated Pictures, Communications of the ACM 18(6)",
        .equations = "the unnumbered shading function; modified: Lewis 1994",
        .formula =
            "modified: f = kd/pi + ks (n+2)/(2 pi) max(0, R.wo)^n\n"
            "classic:  f = kd/pi + ks max(0, R.wo)^n / wi.z\n"
            "R = (-wi.x, -wi.y, wi.z)",
        .parameters = {choice_parameter(
                           "variant", "which form",
                           {{"modified", "Lewis' normalised, reciprocal form"},
                            {"classic", "Phong's intensity as a BRDF: divided by the cosine"}}),
                       diffuse_parameter(0.5),
                       specular_parameter(0.2),
                       {.name = "n",
                        .meaning = "exponent: the larger, the narrower the highlight",
                        .high = 1e6,
                        .otherwise = 30.,
                        .aliases = {"exponent"}}},
        .bounds = {{.parameters = {"kd", "ks"}}},
        .behaviours = {{.options = "variant=modified",
                        .energy_note = "for kd + ks <= 1; the highlight fades towards grazing as "
                                       "the horizon cuts it",
                        .examples = {"kd=0.3 ks=0.6 n=20", "kd=0 ks=1 n=1", "kd=0.5 ks=0.5 n=200"}},
                       {.options = "variant=classic",
                        .reciprocal = false,
                        .energy = Energy::exceeds,
                        .energy_note = "grows without bound towards grazing incidence, as 1/wi.z",
                        .witness = "kd=0 ks=1 n=20",
                        .witness_degrees = 89.,
                        .examples = {"kd=0.3 ks=0.6 n=20", "kd=0 ks=1 n=2"}}},
        .sampling =
            "one-sample mixture of the cosine and, with probability ks/(kd+ks), "
            "(n+1)/(2 pi) cos^n about the mirror direction",
        .albedo =
            "modified, kd = 0: ks at normal incidence, ks (n+2)/(2 pi) B((n+1)/2, 3/2) at "
            "grazing; classic: 2 pi ks/(n+2) at normal incidence",
        .errata = {"Often printed with k_d in place of k_d/pi, although k_d is called an albedo."},
        .references = {"B. T. Phong 1975, CACM 18(6), 311-317",
                       "R. R. Lewis 1994, CGF 13(2), 109-120",
                       "E. P. Lafortune, Y. D. Willems 1994, Using the Modified Phong Reflectance "
                       "Model for Physically Based Rendering, report CW197, K.U. Leuven"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct Phong {
    PhongVariant variant;
    P kd, ks;
    S n;

    static const ModelDescription& describe() { return phong_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("variant", m.variant);
        f("kd", m.kd);
        f("ks", m.ks);
        f("n", m.n);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using T = Product<D, S>;
        const T lobe = cosine_power(mirrored(wi), wo, n);
        const T scale = variant == PhongVariant::modified ? T((n + D(2)) * D(0.5 * inv_pi))
                                                          : T(D(1) / at_least(wi.z, 1e-7));
        return above(wi, wo) * (D(inv_pi) * kd + T(lobe * scale) * ks);
    }
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        return u1 < specular_share(kd, ks) ? sample_cosine_power(mirrored(wo), n, u2)
                                           : square_to_cosine_hemisphere(u2);
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const D share = D(specular_share(kd, ks));
        const D lobe = D((n + D(1)) * D(0.5 * inv_pi)) * cosine_power(mirrored(wo), wi, n);
        return above(wi, wo) * (share * lobe + (D(1) - share) * D(inv_pi) * wi.z);
    }
};

}  // namespace nacre
