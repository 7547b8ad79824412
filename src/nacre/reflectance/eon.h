#pragma once
// EON: Oren-Nayar in Fujii's form, with the light that it loses given back.
//
//   J. Portsmouth, P. Kutz, S. Hill 2025, EON: A Practical Energy-Preserving Rough Diffuse BRDF,
//   JCGT 14(1); single scattering: Y. Fujii, A Tiny Improvement of Oren-Nayar Reflectance Model.
//
// The formulas are in the description below.
#include "nacre/math/warp.h"
#include "nacre/reflectance/model.h"

namespace nacre {

enum class EonVariant { eon, fujii };

inline const ModelDescription& eon_description() {
    static const ModelDescription description{
        .name = "eon",
        .title = "EON (energy-preserving Oren-Nayar)",
        .authors = "J. Portsmouth, P. Kutz, S. Hill; Y. Fujii",
        .year = 2025,
        .paper = "EON: A Practical Energy-Preserving Rough Diffuse BRDF, JCGT 14(1)",
        .equations = "the exact form, with Fujii's single scattering",
        .formula =
            "s = wi.wo - wi.z wo.z, t = max(wi.z, wo.z) if s > 0 else 1\n"
            "A = 1/(1 + (1/2 - 2/(3 pi)) r)\n"
            "fujii: f = rho/pi A (1 + r s/t)\n"
            "eon:   f = fujii + rho_ms/pi (1 - E(wi.z)) (1 - E(wo.z)) / (1 - Em)\n"
            "       E: albedo of fujii for rho = 1, see albedo; Em its mean\n"
            "       Em = A (1 + (2/3 - 28/(15 pi)) r), rho_ms = rho^2 Em/(1 - rho (1 - Em))",
        .parameters = {choice_parameter("variant", "which form",
                                        {{"eon", "with multiple scattering"},
                                         {"fujii", "single scattering only", {"fon"}}}),
                       {.name = "reflectance",
                        .meaning = "albedo rho of the facets",
                        .kind = ParameterKind::spectrum,
                        .otherwise = 0.5,
                        .aliases = {"rho", "kd"}},
                       {.name = "roughness",
                        .meaning = "r: 0 is Lambert",
                        .otherwise = 0.3,
                        .aliases = {"r"}}},
        .behaviours = {{.options = "variant=eon",
                        .energy_note = "exactly: with rho = 1 the albedo is 1 for every direction",
                        .examples = {"reflectance=1 roughness=1", "reflectance=0.5 roughness=0.4",
                                     "reflectance=0.8 roughness=0"}},
                       {.options = "variant=fujii",
                        .energy_note = "loses what is scattered more than once",
                        .examples = {"reflectance=1 roughness=1",
                                     "reflectance=0.5 roughness=0.4"}}},
        .sampling = "proportional to the cosine",
        .albedo =
            "fujii, rho = 1: E(m) = A + r A/pi (q (acos m - q m) + 2/3 ((q/m)(1 - q^3) - q)), "
            "q = sqrt(1 - m^2); eon: rho E + rho_ms (1 - E)",
        .errata = {},
        .references = {"J. Portsmouth, P. Kutz, S. Hill 2025, JCGT 14(1)",
                       "Y. Fujii, A Tiny Improvement of Oren-Nayar Reflectance Model (note)"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct Eon {
    EonVariant variant;
    P reflectance;
    S roughness;

    static const ModelDescription& describe() { return eon_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("variant", m.variant);
        f("reflectance", m.reflectance);
        f("roughness", m.roughness);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        const D gate = above(wi, wo) * D(inv_pi);
        const D s = wi.x * wo.x + wi.y * wo.y;
        const D larger = at_least(select(wi.z > wo.z, wi.z, wo.z), 1e-10);
        const D q = select(s > D(0), D(s / larger), s);
        // Not below 0 by rounding, between opposite directions at the horizon.
        const T single = at_least(T(T(D(1) * scale()) + T(scale() * roughness * q)), 0.);
        if (variant == EonVariant::fujii) return T(gate * single) * reflectance;
        // Without roughness nothing is lost: 0/0 in the quotient, whose limit is 0.
        const T lost = T((T(D(1)) - albedo_of_white(wi)) * (T(D(1)) - albedo_of_white(wo))) /
                       at_least(S(S(1.) - mean_albedo()), 1e-20);
        return T(gate * single) * reflectance + T(gate * lost) * many();
    }
    Vec3<D> sample(const Vec3<D>&, Vec2<D> u) const { return square_to_cosine_hemisphere(u); }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const { return above(wi, wo) * D(inv_pi) * wi.z; }

    Product<Product<D, S>, P> albedo(const Vec3<D>& w) const {
        const T e = albedo_of_white(w);
        if (variant == EonVariant::fujii) return e * reflectance;
        return e * reflectance + T(T(D(1)) - e) * many();
    }

  private:
    using T = Product<D, S>;

    S scale() const { return S(1.) / (S(1.) + S(0.5 - 2. / 3. * inv_pi) * roughness); }
    S mean_albedo() const {
        return scale() * (S(1.) + S(2. / 3. - 28. / 15. * inv_pi) * roughness);
    }
    /// rho_ms, the colour of light scattered more than once.
    Product<S, P> many() const {
        const S e = mean_albedo();
        return reflectance * reflectance * e / (S(1.) - reflectance * (S(1.) - e));
    }
    /// E: with (q/m)(1 - q^3) = q m (1 + q + q^2)/(1 + q), which does not cancel at grazing angles.
    T albedo_of_white(const Vec3<D>& w) const {
        using std::atan2, std::sqrt;
        const D m = at_least(w.z, 1e-20), q = sqrt(w.x * w.x + w.y * w.y);
        const D tail = q * m * (D(1) + q + q * q) / (D(1) + q) - q;
        const D gamma = q * (atan2(q, m) - q * m) + D(2. / 3.) * tail;
        return T(D(1) * scale()) + T(scale() * roughness * D(D(inv_pi) * gamma));
    }
};

}  // namespace nacre
