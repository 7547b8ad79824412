#pragma once
// Minnaert: surfaces that darken or brighten towards the rim, such as the Moon.
//
//   M. Minnaert 1941, The Reciprocity Principle in Lunar Photometry, Astrophysical Journal 93.
//   f = rho (k + 1)/(2 pi) (wi.z wo.z)^(k - 1)
#include <nacre/math/warp.h>
#include <nacre/reflectance/model.h>

namespace nacre {

inline const ModelDescription& minnaert_description() {
    static const ModelDescription description{
        .name = "minnaert",
        .title = "Minnaert",
        .authors = "M. Minnaert",
        .year = 1941,
        .paper = "The Reciprocity Principle in Lunar Photometry, Astrophysical Journal 93",
        .equations = "the law that bears his name",
        .formula = "f = rho (k + 1)/(2 pi) (wi.z wo.z)^(k - 1)",
        .parameters = {{.name = "reflectance",
                        .meaning = "albedo rho at normal incidence",
                        .kind = ParameterKind::spectrum,
                        .otherwise = 0.5,
                        .aliases = {"rho"}},
                       {.name = "k",
                        .meaning = "limb darkening: 1 is Lambert, above 1 darker towards the rim",
                        .low = 1.,
                        .high = 10.,
                        .otherwise = 1.5}},
        .behaviours = {{.energy_note = "the albedo is rho wi.z^(k - 1)",
                        .examples = {"reflectance=1 k=2", "reflectance=0.7 k=1.2"}}},
        .sampling = "proportional to the cosine",
        .albedo = "rho wi.z^(k - 1)",
        .references = {"M. Minnaert 1941, Astrophysical Journal 93, 403-410"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct Minnaert {
    P reflectance;
    S k;

    static const ModelDescription& describe() { return minnaert_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("reflectance", m.reflectance);
        f("k", m.k);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::pow;
        using T = Product<D, S>;
        const T shape = pow(T(at_least(D(wi.z * wo.z), 1e-12)), T(D(1) * (k - S(1.))));
        return T(above(wi, wo) * shape * ((k + S(1.)) * S(0.5 * inv_pi))) * reflectance;
    }
    Vec3<D> sample(const Vec3<D>&, Vec2<D> u) const { return square_to_cosine_hemisphere(u); }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const { return above(wi, wo) * D(inv_pi) * wi.z; }

    Product<Product<D, S>, P> albedo(const Vec3<D>& wi) const {
        using std::pow;
        using T = Product<D, S>;
        return pow(T(at_least(wi.z, 0.)), T(D(1) * (k - S(1.)))) * reflectance;
    }
};

}  // namespace nacre
