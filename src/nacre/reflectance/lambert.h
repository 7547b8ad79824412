#pragma once
// Lambert: the ideal matt surface.
//
//   J. H. Lambert 1760, Photometria; notation of S. Chandrasekhar 1950, Radiative Transfer.
//   f = rho / pi
//
// Reciprocal. Conserves energy: its albedo is rho for every direction. Sampling: proportional to
// the cosine, so the weight is rho.
#include "nacre/math/warp.h"
#include "nacre/reflectance/model.h"

namespace nacre {

inline const ModelDescription& lambert_description() {
    static const ModelDescription description{
        .name = "lambert",
        .title = "Lambert",
        .authors = "J. H. Lambert",
        .year = 1760,
        .paper = "Photometria, sive de mensura et gradibus luminis, colorum et umbrae",
        .equations = "",
        .formula = "f = rho / pi",
        .parameters = {{.name = "reflectance",
                        .meaning = "albedo rho",
                        .kind = ParameterKind::spectrum,
                        .otherwise = 0.5,
                        .aliases = {"kd", "rho"}}},
        .behaviours = {{.energy_note = "the albedo is rho for every direction",
                        .examples = {"reflectance=0.8"}}},
        .sampling = "proportional to the cosine; the weight is rho",
        .albedo = "E = rho",
        .errata = {"Texts that write f = k_d mean an intensity with its own light unit; as a BRDF "
                   "it needs 1/pi, else the albedo is pi k_d."},
        .references = {"J. H. Lambert 1760, Photometria, Augsburg"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct Lambert {
    P reflectance;

    static const ModelDescription& describe() { return lambert_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("reflectance", m.reflectance);
    }

    Product<D, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        return (above(wi, wo) * D(inv_pi)) * reflectance;
    }
    Vec3<D> sample(const Vec3<D>&, Vec2<D> u) const { return square_to_cosine_hemisphere(u); }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const { return above(wi, wo) * D(inv_pi) * wi.z; }
    P albedo(const Vec3<D>&) const { return reflectance; }
};

}  // namespace nacre
