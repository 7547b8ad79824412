#pragma once
// What a facet reflects: Fresnel's equations and their approximations, as options of a model.
//
//   schlick        f0 + (1 - f0) (1-u)^5, u = wi.h            (C. Schlick 1994)
//   dielectric     of index n, unpolarised
//   conductor      of index n + i k: h Rp + (1-h) Rs, h the share of light polarised parallel to
//                  the plane of incidence; h = 1/2 is natural light
//   dielectric_f0  the dielectric whose normal reflectance is f0, n = (1+sqrt f0)/(1-sqrt f0):
//                  Cook and Torrance's recipe for colours
//   power4         (1-u)^4: no reflection at normal incidence, off by 0.086 for n = 1.5 and 0.17
//                  for n = 2.4
//   one            a perfect mirror
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/model.h"

namespace nacre {

enum class FresnelForm { dielectric, conductor, schlick, dielectric_f0, power4, one };

template <class P, class S>
struct FacetFresnel {
    FresnelForm form = FresnelForm::dielectric;
    P n, k, f0;
    S parallel;

    /// Reflectance at the cosine u between light and facet.
    template <class D>
    Product<D, P> at(const D& u) const {
        using V = Product<D, P>;
        const V c = V(u);
        switch (form) {
            case FresnelForm::conductor: {
                const auto r = fresnel_conductor_polarised(c, n, k);
                return V(parallel * r.p + (S(1) - parallel) * r.s);
            }
            case FresnelForm::schlick:
                return V(fresnel_schlick(c, f0));
            case FresnelForm::dielectric_f0: {
                const P bounded = select(f0 < P(0.9999f), f0, P(0.9999f));  // 1 has no index
                return V(fresnel_dielectric(c, index_of_normal_reflectance(bounded)));
            }
            case FresnelForm::power4: {
                const D m = D(1) - u, m2 = m * m;
                return V(m2 * m2);
            }
            case FresnelForm::one:
                return V(D(1));
            case FresnelForm::dielectric:
                break;
        }
        return V(fresnel_dielectric(c, n));
    }

    /// Visits the members in the order of `parameters_of_fresnel`.
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("fresnel", m.form);
        f("n", m.n);
        f("k", m.k);
        f("f0", m.f0);
        f("parallel", m.parallel);
    }
};

inline void add_fresnel_parameters(std::vector<Parameter>& parameters) {
    parameters.push_back(choice_parameter(
        "fresnel", "what a facet reflects",
        {{"dielectric", "index n"},
         {"conductor", "index n + i k"},
         {"schlick", "Schlick 1994: from f0 up to 1 with the fifth power"},
         {"dielectric_f0", "the dielectric of normal reflectance f0 (Cook and Torrance's recipe)"},
         {"power4", "(1-u)^4: an old simplification, black at normal incidence"},
         {"one", "everything"}},
        0, {"F"}));
    parameters.push_back({.name = "n",
                          .meaning = "index of refraction, relative to the outside",
                          .kind = ParameterKind::spectrum,
                          .high = 10.,
                          .above_low = true,
                          .otherwise = 1.5,
                          .aliases = {"eta", "int_ior", "intIOR"}});
    parameters.push_back({.name = "k",
                          .meaning = "index of absorption, of a conductor",
                          .kind = ParameterKind::spectrum,
                          .high = 20.,
                          .otherwise = 3.});
    parameters.push_back(
        {.name = "f0",
         .meaning = "reflectance at normal incidence, of schlick and dielectric_f0",
         .kind = ParameterKind::spectrum,
         .otherwise = 0.5});
    parameters.push_back({.name = "parallel",
                          .meaning =
                              "share of the light that is polarised parallel to the plane of "
                              "incidence, on a conductor",
                          .otherwise = 0.5,
                          .aliases = {"h"}});
}

}  // namespace nacre
