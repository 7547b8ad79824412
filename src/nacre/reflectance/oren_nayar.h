#pragma once
// Oren-Nayar: a matt surface of V-shaped cavities with Lambertian facets.
//
//   M. Oren, S. K. Nayar 1994, Generalization of Lambert's Reflectance Model, SIGGRAPH 94, eq.
//   27-30.
//
// The formulas of both forms are in the description below, by the angles of incidence.
#include "nacre/math/warp.h"
#include "nacre/reflectance/model.h"

namespace nacre {

enum class OrenNayarVariant { full, qualitative };

inline const ModelDescription& oren_nayar_description() {
    static const ModelDescription description{
        .name = "oren_nayar",
        .title = "Oren-Nayar",
        .authors = "M. Oren, S. K. Nayar",
        .year = 1994,
        .paper = "Generalization of Lambert's Reflectance Model, SIGGRAPH 94",
        .equations = "27-29 (full), 30 (qualitative)",
        .formula =
            "alpha = max(ti, to), beta = min(ti, to), p = phi_i - phi_o, s2 = sigma^2\n"
            "A = 1 - s2/(2 (s2 + 0.33)), B = 0.45 s2/(s2 + 0.09)\n"
            "qualitative: f = rho/pi (A + B max(0, cos p) sin(alpha) tan(beta))\n"
            "full:        f = rho/pi (A + cos p C2 tan(beta) + (1 - |cos p|) C3 "
            "tan((alpha+beta)/2))\n"
            "                 + 0.17 rho^2/pi s2/(s2 + 0.13) (1 - cos p (2 beta/pi)^2)\n"
            "             C2 = B (sin(alpha) - [cos p < 0] (2 beta/pi)^3)\n"
            "             C3 = 0.125 s2/(s2 + 0.09) (4 alpha beta/pi^2)^2; 0 where this is below 0",
        .parameters = {choice_parameter(
                           "variant", "which form",
                           {{"full", "with interreflections between facets"},
                            {"qualitative", "the paper's simplification, used in most programs"}}),
                       {.name = "reflectance",
                        .meaning = "albedo rho of the facets",
                        .kind = ParameterKind::spectrum,
                        .otherwise = 0.5,
                        .aliases = {"rho", "kd"}},
                       {.name = "sigma",
                        .meaning = "standard deviation of the facets' slope angle",
                        .unit = "rad",
                        .high = 1.5707963267948966,
                        .otherwise = 0.3}},
        // Albedos rise towards grazing incidence, where alpha = pi/2 and the integrals over beta
        // and p are constants:
        //   full         rho (A + 0.215386 B + 0.642183 C) + rho^2 E,
        //                C = s2/8/(s2 + 0.09), E = 0.17 s2/(s2 + 0.13)
        //   qualitative  rho (A + B/2)
        .behaviours =
            {{.options = "variant=full",
              .energy_note = "the most, 0.9996, is approached at grazing incidence for sigma = "
                             "0.289: rho (A + 0.2154 B + 0.0803 s2/(s2 + 0.09)) + 0.17 rho^2 "
                             "s2/(s2 + 0.13)",
              .conditions = {{.parameter = "reflectance", .high = 0.954}},
              .examples = {"reflectance=0.8 sigma=0.3", "reflectance=0.954 sigma=0.29"}},
             {.options = "variant=full",
              .energy = Energy::exceeds,
              .energy_note =
                  "by 5.1 % at most, at grazing incidence for rho = 1, sigma = 0.304; 2 % "
                  "at 80 degrees",
              .witness = "reflectance=1 sigma=0.304",
              .witness_degrees = 89.99,
              .at_most = 1.05102,
              .examples = {"reflectance=1 sigma=1"}},
             {.options = "variant=qualitative",
              .energy = Energy::exceeds,
              .energy_note = "by 1.52 % at most, at grazing incidence for rho = 1, sigma = 0.1985: "
                             "rho (A + B/2); the albedo at normal incidence is rho A",
              .witness = "reflectance=1 sigma=0.1985",
              .witness_degrees = 89.99,
              .at_most = 1.01518,
              .examples = {"reflectance=0.8 sigma=0.3", "reflectance=1 sigma=1"}}},
        .sampling = "proportional to the cosine",
        .albedo = "qualitative: rho A at normal incidence",
        .errata = {"The slope's standard deviation sigma is an angle; programs that take it as a "
                   "roughness in 0..1 are off by a factor.",
                   "The full form falls below 0 between opposite directions near the horizon, for "
                   "sigma above 0.66 and dark facets (its limit there is rho/pi (A - 6 B/pi + 0.34 "
                   "rho s2/(s2 + 0.13))); it is 0 there."},
        .references = {"M. Oren, S. K. Nayar 1994, SIGGRAPH 94, 239-246"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct OrenNayar {
    OrenNayarVariant variant;
    P reflectance;
    S sigma;

    static const ModelDescription& describe() { return oren_nayar_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("variant", m.variant);
        f("reflectance", m.reflectance);
        f("sigma", m.sigma);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using T = Product<D, S>;
        const S s2 = sigma * sigma;
        const S a = S(1.) - S(0.5) * s2 / (s2 + S(0.33));
        const S b = S(0.45) * s2 / (s2 + S(0.09));
        const D gate = above(wi, wo) * D(inv_pi);
        const D xy = wi.x * wo.x + wi.y * wo.y;
        if (variant == OrenNayarVariant::qualitative) {
            // cos p sin(alpha) tan(beta) = sin_i sin_o cos p / max(cos_i, cos_o).
            const D larger = at_least(select(wi.z > wo.z, wi.z, wo.z), 1e-10);
            return T(gate * T(T(a * D(1)) + b * D(select(xy > D(0), xy, D(0)) / larger))) *
                   reflectance;
        }
        using std::atan2, std::sqrt;
        const D si = sqrt(wi.x * wi.x + wi.y * wi.y), so = sqrt(wo.x * wo.x + wo.y * wo.y);
        const D cos_p = xy / at_least(D(si * so), 1e-30);
        const D ti = atan2(si, wi.z), to = atan2(so, wo.z);
        const auto upper = wi.z < wo.z;  // wi is the more inclined one
        const D alpha = select(upper, ti, to), beta = select(upper, to, ti);
        const D sin_alpha = select(upper, si, so);
        const D tan_beta = select(upper, so, si) / at_least(select(upper, wo.z, wi.z), 1e-10);
        // tan of the mean angle = (sum of sines) / (sum of cosines).
        const D tan_mean = (si + so) / at_least(D(wi.z + wo.z), 1e-10);
        const D q = D(2 * inv_pi) * beta, r = D(4 * inv_pi * inv_pi) * alpha * beta;
        const D away = select(cos_p < D(0), D(q * q * q), D(0));
        // Both cancel where both directions are close to the horizon: 1 - q^3 by the series of the
        // elevation pi/2 - beta, 1 - sin(alpha) by the cosine.
        const D cos_alpha = select(upper, wi.z, wo.z), cos_beta = select(upper, wo.z, wi.z);
        const D c2 = cos_beta * cos_beta;
        const D rest = D(2 * inv_pi) * cos_beta * (D(1) + c2 * (D(1. / 6) + D(0.075) * c2));
        const D close = rest * (D(1) + q + q * q) - cos_alpha * cos_alpha / (D(1) + sin_alpha);
        const D lobe = select(cos_p < D(0),
                              D(select(cos_beta < D(0.01), close, D(sin_alpha - away))), sin_alpha);
        const S c3 = S(0.125) * s2 / (s2 + S(0.09));
        const D across = D(1) - select(cos_p < D(0), D(-cos_p), cos_p);
        const T direct =
            T(a * D(1)) + b * D(cos_p * tan_beta * lobe) + c3 * D(across * tan_mean * r * r);
        const T between = S(0.17) * s2 / (s2 + S(0.13)) * D(D(1) - cos_p * q * q);
        using V = Product<T, P>;
        const V f =
            T(gate * direct) * reflectance + T(gate * between) * (reflectance * reflectance);
        return at_least(f, 0.);
    }
    Vec3<D> sample(const Vec3<D>&, Vec2<D> u) const { return square_to_cosine_hemisphere(u); }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const { return above(wi, wo) * D(inv_pi) * wi.z; }
};

}  // namespace nacre
