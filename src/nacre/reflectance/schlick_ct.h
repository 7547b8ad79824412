#pragma once
// Schlick's rational Cook-Torrance: polynomials and quotients in place of its transcendentals.
//
//   C. Schlick 1994, An Inexpensive BRDF Model for Physically-Based Rendering, CGF 13(3); 1993,
//   Eurographics Workshop on Rendering.
//
// The formulas are in the description below.
//
// D fits exp(-tan^2/m^2)/(m^2 t^4) within 14 % of its peak for m <= 0.5; the integral of D t over
// normals is pi exactly, so D/pi is a density.
#include "nacre/math/warp.h"
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/schlick.h"

namespace nacre {

enum class SchlickCtMasking { published, consistent };
enum class SchlickCtConvention { normalized, literal };

inline const ModelDescription& schlick_ct_description() {
    static const ModelDescription description{
        .name = "schlick_ct",
        .title = "Schlick's rational Cook-Torrance",
        .authors = "C. Schlick",
        .year = 1994,
        .paper =
            "An Inexpensive BRDF Model for Physically-Based Rendering, Computer Graphics "
            "Forum 13(3)",
        .equations = "the rational approximations of F, G and D",
        .formula =
            "f = kd/pi + F G D / (4 pi wi.z wo.z), t = h.z, u = wi.h\n"
            "F = f0 + (1 - f0) (1-u)^5\n"
            "G = g(wi.z) g(wo.z), g(v) = v/(v - k v + k)\n"
            "D = m^3 x/(t (m x^2 - x^2 + m^2)^2), x = max(0, t + m - 1)\n"
            "literal: F G D / (pi wi.z wo.z)",
        .parameters = {choice_parameter("masking", "k of g",
                                        {{"published", "sqrt(2/pi) m: one m for G and D"},
                                         {"consistent",
                                          "m/sqrt(pi): G takes the slope per direction, which "
                                          "is m/sqrt(2)"}}),
                       choice_parameter("convention", "the constant before F G D",
                                        {{"normalized", "1/(4 pi)"},
                                         {"literal", "1/pi, as printed: 4 times too bright"}}),
                       diffuse_parameter(0.3),
                       {.name = "f0",
                        .meaning = "reflectance of the facets at normal incidence",
                        .kind = ParameterKind::spectrum,
                        .otherwise = 0.6,
                        .aliases = {"specular_reflectance", "specularReflectance"}},
                       {.name = "m",
                        .meaning = "slope of the facets, as Beckmann's",
                        .above_low = true,
                        .otherwise = 0.3,
                        .aliases = {"alpha"}}},
        // Whatever f0, the highlight of narrow lobes has an albedo close to 1 near grazing
        // incidence, so that it leaves nothing for kd.
        .behaviours = {{.options = "convention=normalized",
                        .energy_note = "1 is approached as m goes to 0",
                        .conditions = {{.parameter = "kd", .high = 0.}},
                        .examples = {"kd=0 f0=1 m=0.3", "kd=0 f0=0.5 m=0.6", "kd=0 f0=0.9 m=0.15",
                                     "kd=0 f0=1 m=0.3 masking=consistent"}},
                       {.options = "convention=normalized",
                        .energy = Energy::exceeds,
                        .energy_note = "kd is added without taking anything from the highlight: up "
                                       "to 1 + kd for f0 = 1 as m goes to 0",
                        .witness = "kd=1 f0=1 m=0.001",
                        .at_most = 2.,
                        .examples = {"kd=0.2 f0=0.5 m=0.6"}},
                       {.options = "convention=literal",
                        .energy = Energy::exceeds,
                        .energy_note = "4 times too bright",
                        .witness = "kd=0 f0=1 m=0.3",
                        .examples = {"kd=0 f0=1 m=0.3"}}},
        .sampling =
            "one-sample mixture of the cosine and mirrored normals of density D t/pi: t = 1 "
            "- m + m sqrt(u/(m + u (1-m)))",
        .errata =
            {"g is printed v/(v - k v - k), which has poles.",
             "The expression that g fits, y/(y + 1) with y = sqrt(pi h) (2 - erfc sqrt(h)) and h = "
             "v^2/(2 m^2 (1 - v^2)), is called Smith's; his has a factor exp(h) at y. g is within "
             "0.10 of the former and 0.23 of Smith's for m from 0.1 to 0.5.",
             "F/pi with D as printed is 4 times too bright."},
        .references = {"C. Schlick 1994, CGF 13(3), 233-246"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct SchlickCt {
    SchlickCtMasking masking;
    SchlickCtConvention convention;
    P kd, f0;
    S m;

    static const ModelDescription& describe() { return schlick_ct_description(); }
    template <class Self, class F>
    static void parameters(Self& s, F&& f) {
        f("masking", s.masking);
        f("convention", s.convention);
        f("kd", s.kd);
        f("f0", s.f0);
        f("m", s.m);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        using V = Product<D, S>;
        const Vec3<D> h = wi + wo;
        const D u = D(0.5) * sqrt(dot(h, h));
        const S k = m * S(masking == SchlickCtMasking::published
                              ? std::numbers::sqrt2 * std::numbers::inv_sqrtpi
                              : std::numbers::inv_sqrtpi);
        const V g =
            schlick_masking(at_least(wi.z, 1e-7), k) * schlick_masking(at_least(wo.z, 1e-7), k);
        const D constant(convention == SchlickCtConvention::literal ? inv_pi : 0.25 * inv_pi);
        const V scale = V(constant / at_least(D(wi.z * wo.z), 1e-14));
        return above(wi, wo) * (D(inv_pi) * kd + g * density(h) * scale * fresnel_schlick(u, f0));
    }
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        using std::cos, std::sin, std::sqrt;
        if (!(u1 < highlight_share(wo))) return square_to_cosine_hemisphere(u2);
        // 1 - t without cancellation.
        const D v = m * (D(1) - sqrt(u2.x / (m + u2.x * (D(1) - m))));
        const D sine = sqrt(v * (D(2) - v)), phi = D(2 * std::numbers::pi) * u2.y;
        return reflect(wo, Vec3<D>{sine * cos(phi), sine * sin(phi), D(1) - v});
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const Vec3<D> h = wi + wo;
        const D share = highlight_share(wo), length2 = at_least(dot(h, h), 1e-20);
        return above(wi, wo) * (share * density(h) * h.z * D(0.5 * inv_pi) / length2 +
                                (D(1) - share) * D(inv_pi) * wi.z);
    }

    /// D of a half vector of any length.
    Product<D, S> density(const Vec3<D>& h) const {
        using std::sqrt;
        using V = Product<D, S>;
        const D tan2 = (h.x * h.x + h.y * h.y) / at_least(D(h.z * h.z), 1e-12);
        const D secant = sqrt(D(1) + tan2);
        const V versine = V(tan2 / (secant * (secant + D(1))));  // 1 - t
        const V x = at_least(V(V(m) - versine), 0.), x2 = x * x, m2 = V(m * m);
        const V q = m2 - x2 * V(S(1) - m);
        return V(secant) * V(m) * m2 * x / (q * q);
    }

  private:
    D highlight_share(const Vec3<D>& wo) const {
        return D(specular_share(kd, P(fresnel_schlick(D(at_least(wo.z, 0.)), f0))));
    }
};

}  // namespace nacre
