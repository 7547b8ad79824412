#pragma once
// Blinn 1977: Torrance and Sparrow's facets for computer graphics.
//
//   J. F. Blinn 1977, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 77.
//
// The intensity k_s D G F / (n.v) of the paper over n.l, whose D has the peak 1 and is one half at
// the angle beta from the normal. The formulas are in the description below;
// G: v-cavities, as in torrance_sparrow.h.
#include "nacre/reflectance/facets.h"

namespace nacre {

enum class BlinnDistribution { phong, torrance_sparrow, trowbridge_reitz };

/// Lowers ks until kd + 4 ks/D_n is at most 1.
void bring_below_mirror(NamedNumbers& numbers);

inline const ModelDescription& blinn_torrance_sparrow_description() {
    static const ModelDescription description = [] {
        ModelDescription d{
            .name = "blinn_torrance_sparrow",
            .title = "Blinn's Torrance-Sparrow",
            .authors = "J. F. Blinn",
            .year = 1977,
            .paper = "Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 77",
            .equations = "unnumbered; D1, D2, D3 with the constants c1, c2, c3",
            .formula =
                "f = kd/pi + ks D G F / (wi.z wo.z), t = h.z = cos(theta)\n"
                "phong:            D = t^Ns, Ns = -ln 2 / ln cos(beta)\n"
                "torrance_sparrow: D = exp(-(C1 theta)^2), C1 = sqrt(ln 2)/beta\n"
                "trowbridge_reitz: D = (C2^2/(t^2 (C2^2-1) + 1))^2,\n"
                "                  C2^2 = (1 - cos^2 beta)/(sqrt 2 - cos^2 beta)\n"
                "G = min(1, 2 t wi.z/u, 2 t wo.z/u), u = wi.h",
            .parameters = {choice_parameter("distribution", "of the facets",
                                            {{"phong", "Blinn's D1", {"P"}},
                                             {"torrance_sparrow", "his D2, a Gaussian", {"TS"}},
                                             {"trowbridge_reitz", "his D3", {"TR", "ggx"}}},
                                            2, {"Datt"}),
                           diffuse_parameter(0.5),
                           {.name = "ks",
                            .meaning = "weight of the highlight",
                            .kind = ParameterKind::spectrum,
                            .high = 100.,
                            .otherwise = 0.5},
                           {.name = "beta",
                            .meaning = "angle from the normal at which D is one half",
                            .unit = "degrees",
                            .high = 89.,
                            .above_low = true,
                            .otherwise = 15.,
                            .aliases = {"beta_deg"}}},
            .behaviours =
                // The highlight is 4 ks/D_n times that of facets with a normalised density in
            // V-shaped grooves, which reflect at most what they get.
            {{.energy_note =
                  "D_n, the peak of the normalised density, is (Ns+2)/(2 pi), 1/(pi C2^2) or, "
                  "of the Gaussian, torrance_sparrow's C of m = beta/sqrt(2 ln 2)",
              .joint = {.text = "kd + 4 ks/D_n up to 1", .bring_within = bring_below_mirror},
              .examples = {"kd=0 ks=0.5 distribution=phong beta=20 fresnel=one",
                           "kd=0 ks=0.5 distribution=torrance_sparrow beta=10 n=1.8",
                           "kd=0.3 ks=0.4 distribution=trowbridge_reitz beta=15"}},
             {.options = "ks=4 kd=0 fresnel=one",
              .energy = Energy::exceeds,
              .energy_note = "for larger ks: D is not normalised",
              .witness = "distribution=phong beta=20",
              .examples = {"distribution=phong beta=20"}}},
            .sampling = "one-sample mixture of the cosine and mirrored normals of density D h.z",
            .errata =
                {"Secondary literature prints the Trowbridge-Reitz form without its outer square, "
                 "and C2 <= 0 where it is >= 0.",
                 "A listing of these models in circulation defines sqrt(2) as 1.7725, which is "
                 "sqrt(pi)."},
            .references = {"J. F. Blinn 1977, SIGGRAPH 77, 192-198",
                           "T. S. Trowbridge, K. P. Reitz 1975, JOSA 65(5), 531-536"},
        };
        add_fresnel_parameters(d.parameters);
        return d;
    }();
    return description;
}

inline FacetDistribution facets_of(BlinnDistribution form) {
    return form == BlinnDistribution::phong              ? FacetDistribution::phong
           : form == BlinnDistribution::torrance_sparrow ? FacetDistribution::gauss
                                                         : FacetDistribution::trowbridge_reitz;
}

template <class D, class P = D, class S = D>
struct BlinnTorranceSparrow : FacetReflection<D, P, S> {
    using Facets = FacetReflection<D, P, S>;

    BlinnDistribution form;
    S beta;

    static const ModelDescription& describe() { return blinn_torrance_sparrow_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("distribution", m.form);
        f("kd", m.kd);
        f("ks", m.ks);
        f("beta", m.beta);
        m.fresnel.parameters(m.fresnel, f);
    }
    void prepare() {
        this->distribution = facets_of(form);
        this->m[0] = width_of_half_height(this->distribution, beta * S(std::numbers::pi / 180));
        Facets::prepare();
        // The common form divides by 4 and has a normalised D.
        this->scale = S(4) / this->peak();
    }
};

}  // namespace nacre
