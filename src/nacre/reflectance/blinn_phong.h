#pragma once
// Blinn-Phong: a power of the cosine between half vector and normal.
//
//   J. F. Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 77;
//   normalisation: F. Giesen 2009, Phong Normalization Factors.
//
// The formulas are in the description below.
#include "nacre/math/warp.h"
#include "nacre/reflectance/cosine_lobe.h"

namespace nacre {

enum class BlinnPhongVariant { normalized, classic };

inline const ModelDescription& blinn_phong_description() {
    static const ModelDescription description{
        .name = "blinn_phong",
        .title = "Blinn-Phong",
        .authors = "J. F. Blinn; F. Giesen",
        .year = 1977,
        .paper = "Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 77",
        .equations = "the unnumbered alternative to Phong's highlight",
        .formula =
            "normalized: f = kd/pi + ks (n+2)(n+4) / (8 pi (2^(-n/2) + n)) (n.h)^n\n"
            "classic:    f = kd/pi + ks (n.h)^n / wi.z\n"
            "h = (wi + wo)/|wi + wo|",
        .parameters = {choice_parameter(
                           "variant", "which form",
                           {{"normalized", "reciprocal, albedo ks at normal incidence (Giesen)"},
                            {"classic", "Blinn's intensity as a BRDF: divided by the cosine"}}),
                       diffuse_parameter(0.5),
                       specular_parameter(0.2),
                       {.name = "n",
                        .meaning = "exponent: the larger, the narrower the highlight; about four "
                                   "times Phong's for the same width",
                        .high = 1e6,
                        .otherwise = 120.,
                        .aliases = {"exponent"}}},
        .bounds = {{.parameters = {"kd", "ks"}}},
        .behaviours = {{.options = "variant=normalized",
                        .energy_note = "for kd + ks <= 1; the highlight fades towards grazing",
                        .examples = {"kd=0.3 ks=0.6 n=20", "kd=0 ks=1 n=1", "kd=0.5 ks=0.5 n=300"}},
                       {.options = "variant=classic",
                        .reciprocal = false,
                        .energy = Energy::exceeds,
                        .energy_note = "grows without bound towards grazing incidence, as 1/wi.z, "
                                       "and for small n at normal incidence",
                        .witness = "kd=0 ks=1 n=2",
                        .witness_degrees = 0.,
                        .examples = {"kd=0.3 ks=0.6 n=20", "kd=0 ks=1 n=5"}}},
        .sampling =
            "one-sample mixture of the cosine and, with probability ks/(kd+ks), half "
            "vectors with density (n+1)/(2 pi) (n.h)^n, mirrored",
        .albedo = "normalized, kd = 0: ks at normal incidence",
        .errata = {"Sometimes printed with H = (wi + wo)/2, whose length is not 1: that form fades "
                   "with the angle between light and viewer.",
                   "Often printed with k_d in place of k_d/pi."},
        .references = {"J. F. Blinn 1977, SIGGRAPH 77, 192-198",
                       "F. Giesen 2009, Phong Normalization Factors (note)"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct BlinnPhong {
    BlinnPhongVariant variant;
    P kd, ks;
    S n;

    static const ModelDescription& describe() { return blinn_phong_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("variant", m.variant);
        f("kd", m.kd);
        f("ks", m.ks);
        f("n", m.n);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::exp2, std::exp;
        using T = Product<D, S>;
        const T scale = variant == BlinnPhongVariant::normalized ? T(D(1)) * blinn_normalization(n)
                                                                 : T(D(1) / at_least(wi.z, 1e-7));
        const T lobe = half_cosine_power(wi, wo, n);
        return above(wi, wo) * (D(inv_pi) * kd + T(lobe * scale) * ks);
    }
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        if (!(u1 < specular_share(kd, ks))) return square_to_cosine_hemisphere(u2);
        return reflect(wo, sample_cosine_power(Vec3<D>{D(0), D(0), D(1)}, n, u2));
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const D u = dot(wi, half_vector(wi, wo));
        const D lobe = (n + D(1)) * D(0.5 * inv_pi) * half_cosine_power(wi, wo, n) /
                       at_least(D(D(4) * u), 1e-7);
        const D share = D(specular_share(kd, ks));
        return above(wi, wo) * (share * lobe + (D(1) - share) * D(inv_pi) * wi.z);
    }
};

}  // namespace nacre
