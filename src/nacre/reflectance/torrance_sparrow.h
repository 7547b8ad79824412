#pragma once
// Torrance-Sparrow: mirror facets in V-shaped grooves, their angles normally distributed.
//
//   K. E. Torrance, E. M. Sparrow 1967, Theory for Off-Specular Reflection from Roughened Surfaces,
//   JOSA 57(9).
//
// The formulas are in the description below.
#include "nacre/reflectance/facets.h"

namespace nacre {

enum class TorranceSparrowConvention { normalized, peak };

inline const ModelDescription& torrance_sparrow_description() {
    static const ModelDescription description = [] {
        ModelDescription d{
            .name = "torrance_sparrow",
            .title = "Torrance-Sparrow",
            .authors = "K. E. Torrance, E. M. Sparrow",
            .year = 1967,
            .paper =
                "Theory for Off-Specular Reflection from Roughened Surfaces, Journal of the "
                "Optical Society of America 57(9)",
            .equations = "the distribution of facets and the geometrical attenuation factor",
            .formula =
                "f = kd/pi + ks F D G / (4 wi.z wo.z)\n"
                "h = (wi + wo)/|wi + wo|, cos(theta) = h.z, u = wi.h\n"
                "D = C exp(-theta^2 / (2 m^2)), G = min(1, 2 h.z wi.z/u, 2 h.z wo.z/u)\n"
                "normalized: int D h.z dh = 1; peak: C = 1",
            .parameters = {choice_parameter(
                               "convention", "the constant C of the distribution",
                               {{"normalized", "facets project to the whole surface"},
                                {"peak", "1, as in the paper, whose measurements were relative"}}),
                           diffuse_parameter(0.3),
                           specular_parameter(0.7),
                           {.name = "m",
                            .meaning = "standard deviation of the angle between facets and "
                                       "surface, along one direction",
                            .unit = "radians",
                            .high = 10.,
                            .above_low = true,
                            .otherwise = 0.2}},
            .bounds = {{.parameters = {"kd", "ks"}}},
            .behaviours =
                // Smith's or V-shaped masking shares out the projected area of the facets: with a
            // normalised density no more is reflected than meets the surface.
            {{.options = "convention=normalized",
              .energy_note = "for kd + ks <= 1",
              .examples = {"kd=0 ks=1 m=0.2 fresnel=one", "kd=0.4 ks=0.6 m=0.4 n=1.8",
                           "kd=0 ks=1 m=0.1 fresnel=conductor n=0.2 k=3.4 parallel=0.9"}},
             {.options = "convention=peak",
              .energy_note = "there C = 1 is below the normalised constant, which is 1 for m = "
                             "0.45655",
              .conditions = {{.parameter = "m", .high = 0.4565}},
              .examples = {"kd=0 ks=1 m=0.2 fresnel=one", "kd=0.3 ks=0.7 m=0.3 n=1.8"}}},
            .sampling =
                "one-sample mixture of the cosine and mirrored normals, whose angles have "
                "the density theta exp(-theta^2/(2 m^2)); highlight by its Fresnel factor",
            .errata =
                {"Secondary literature gives the angle theta by arcsin(sin(phi_r) sin(theta_r) / "
                 "sin(2 theta_i')), which is ambiguous: for theta_i = 60, theta_r = 80, phi_r = "
                 "180 "
                 "degrees it gives 50, the truth is 70. Here it follows from the vector h.",
                 "1/C is pi times the integral of sin(2a) exp(-a^2/(2 m^2)) over [0, pi/2], not "
                 "m sqrt(2 pi), which normalises a density of one variable."},
            .references = {"K. E. Torrance, E. M. Sparrow 1967, JOSA 57(9), 1105-1114"},
        };
        add_fresnel_parameters(d.parameters);
        return d;
    }();
    return description;
}

template <class D, class P = D, class S = D>
struct TorranceSparrow : FacetReflection<D, P, S> {
    using Facets = FacetReflection<D, P, S>;

    TorranceSparrowConvention convention;

    static const ModelDescription& describe() { return torrance_sparrow_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("convention", m.convention);
        f("kd", m.kd);
        f("ks", m.ks);
        f("m", m.m[0]);
        m.fresnel.parameters(m.fresnel, f);
    }
    void prepare() {
        this->distribution = FacetDistribution::gauss;
        Facets::prepare();
        if (convention == TorranceSparrowConvention::peak) this->scale = S(1) / this->peak();
    }
};

}  // namespace nacre
