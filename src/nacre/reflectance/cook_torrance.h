#pragma once
// Cook-Torrance: facets for metals and plastics, with colour from Fresnel's equations.
//
//   R. L. Cook, K. E. Torrance 1981, A Reflectance Model for Computer Graphics, SIGGRAPH 81; 1982,
//   ACM TOG 1(1).
//   f = kd/pi + ks F(u) D(h) G / (4 wi.z wo.z)    (facets.h: distributions; facet_fresnel.h: F)
//   G: v_cavity          min(1, 2 t wi.z/u, 2 t wo.z/u), t = h.z, u = wi.h
//      smith             1 / ((1 + L(wi)) (1 + L(wo)))
//      smith_correlated  1 / (1 + L(wi) + L(wo))
//      sancer            the same with Beckmann's L whatever the distribution
//   Beckmann's L = exp(-a^2)/(2 a sqrt(pi)) - erfc(a)/2, a = cot(theta)/m; Trowbridge-Reitz'
//   L = (sqrt(1 + 1/a^2) - 1)/2; Gauss and Phong take Beckmann's of the same width at the normal.
#include "nacre/reflectance/facets.h"

namespace nacre {

enum class CookTorranceConvention { normalized, m2_over_pi, four_m2 };
enum class CookTorranceWidth { m, half_height, unclipped };

inline const ModelDescription& cook_torrance_description() {
    static const ModelDescription description = [] {
        ModelDescription d{
            .name = "cook_torrance",
            .title = "Cook-Torrance",
            .authors = "R. L. Cook, K. E. Torrance",
            .year = 1982,
            .paper =
                "A Reflectance Model for Computer Graphics, ACM Transactions on Graphics 1(1); "
                "first SIGGRAPH 81",
            .equations = "the unnumbered R_s, D, G of section 2",
            .formula =
                "f = kd/pi + ks F D G / (4 wi.z wo.z), t = h.z = cos(theta), u = wi.h\n"
                "beckmann:         D = exp(-tan^2(theta)/m^2) / (pi m^2 t^4)\n"
                "gauss:            D = C exp(-theta^2 / (2 m^2))\n"
                "phong:            D = (m+2)/(2 pi) t^m\n"
                "trowbridge_reitz: D = m^2 / (pi (t^2 (m^2-1) + 1)^2)\n"
                "several:          D = w1 D(m) + w2 D(m2) + w3 D(m3), over w1 + w2 + w3\n"
                "v_cavity:         G = min(1, 2 t wi.z/u, 2 t wo.z/u)\n"
                "smith:            G = 1/((1 + L(wi)) (1 + L(wo))); correlated: 1/(1 + L(wi) + "
                "L(wo))",
            .parameters =
                {choice_parameter("distribution", "of the facets",
                                  {{"beckmann", "normally distributed slopes", {"sum"}},
                                   {"gauss", "normally distributed angles, Torrance and Sparrow"},
                                   {"phong", "a power of the cosine, Blinn"},
                                   {"trowbridge_reitz", "of ellipsoids: long tails", {"ggx"}}},
                                  0, {"D"}),
                 choice_parameter(
                     "masking", "shadowing and masking G",
                     {{"v_cavity", "of V-shaped grooves", {"vcavity"}},
                      {"smith", "Smith 1967, separable", {"smith_sep"}},
                      {"smith_correlated", "the same, correlated in height", {"smith_corr"}},
                      {"sancer", "Sancer 1969: as smith_correlated, with Beckmann's Lambda"},
                      {"none", "1", {"one"}}},
                     0, {"G"}),
                 choice_parameter(
                     "convention", "the constant before D G F / (wi.z wo.z)",
                     {{"normalized",
                       "exact: 1/4 with D as above; 1/pi with Cook and Torrance's exp()/(4 m^2 "
                       "t^4); "
                       "1 with Hall's exp()/(4 pi m^2 t^4)"},
                      {"m2_over_pi",
                       "1/pi with exp()/(m^2 t^4), often printed: 4 times too bright"},
                      {"four_m2", "1 with exp()/(4 m^2 t^4), also printed: pi times too bright"}}),
                 diffuse_parameter(0.3),
                 specular_parameter(0.7),
                 {.name = "m",
                  .meaning = "width: slope (beckmann), angle in radians (gauss), exponent (phong), "
                             "alpha (trowbridge_reitz)",
                  .high = 1e5,
                  .above_low = true,
                  .otherwise = 0.3,
                  .aliases = {"alpha", "ms_0"}},
                 choice_parameter("width", "what gives m",
                                  {{"m", "itself"},
                                   {"half_height",
                                    "beta, at which D is half of D at the normal; Beckmann's "
                                    "m^2 = -tan^2(beta) / ln(cos^4(beta)/2)"},
                                   {"unclipped",
                                    "beta, by Hall's other rule for Beckmann's m, (1 + sqrt(tan "
                                    "beta)) / (2 sqrt(pi)), which keeps his D below 1"}}),
                 {.name = "beta",
                  .meaning = "angle from the normal, with width=half_height and unclipped",
                  .unit = "degrees",
                  .high = 89.,
                  .above_low = true,
                  .otherwise = 15.,
                  .aliases = {"beta_deg"}},
                 {.name = "terms",
                  .meaning = "how many terms D has",
                  .kind = ParameterKind::integer,
                  .low = 1.,
                  .high = 3.,
                  .otherwise = 1.},
                 {.name = "w1", .meaning = "weight of D(m)", .otherwise = 1., .aliases = {"w_0"}},
                 {.name = "w2", .meaning = "weight of D(m2)", .otherwise = 1., .aliases = {"w_1"}},
                 {.name = "m2",
                  .meaning = "width of a second term",
                  .high = 1e5,
                  .above_low = true,
                  .otherwise = 0.5,
                  .aliases = {"ms_1"}},
                 {.name = "w3", .meaning = "weight of D(m3)", .otherwise = 1., .aliases = {"w_2"}},
                 {.name = "m3",
                  .meaning = "width of a third term",
                  .high = 1e5,
                  .above_low = true,
                  .otherwise = 0.5,
                  .aliases = {"ms_2"}}},
            .bounds = {{.parameters = {"kd", "ks"}}},
            .behaviours =
                // Masking that belongs to the density shares out the projected area of the facets,
            // so that no more is reflected than meets the surface.
            {{.options = "convention=normalized masking=v_cavity",
              .energy_note = "for kd + ks <= 1",
              .examples = {"kd=0 ks=1 m=0.2 fresnel=one", "kd=0.2 ks=0.8 width=half_height beta=15",
                           "kd=0 ks=1 distribution=phong m=30 fresnel=conductor n=0.2 k=3.4"}},
             {.options = "convention=normalized",
              .energy_note = "for kd + ks <= 1",
              .conditions = {{.parameter = "masking", .choices = {"smith", "smith_correlated"}},
                             {.parameter = "distribution",
                              .choices = {"beckmann", "trowbridge_reitz"}}},
              .examples = {"kd=0 ks=1 distribution=trowbridge_reitz m=0.3 "
                           "masking=smith_correlated fresnel=schlick f0=0.9",
                           "kd=0 ks=1 terms=2 m=0.15 m2=0.5 w1=0.4 w2=0.6 "
                           "masking=smith_correlated fresnel=one"}},
             // Towards grazing incidence 1/(1 + L) is as the mean slope of one side, which in
             // units of Beckmann's of the same width is sqrt(pi) for Trowbridge-Reitz' and
             // Phong's of exponent 0, and less for the others.
             {.options = "convention=normalized",
              .energy = Energy::exceeds,
              .energy_note = "where Beckmann's Lambda serves another distribution: by a factor "
                             "of sqrt(pi) = 1.77245 at most, which trowbridge_reitz with "
                             "sancer approaches at grazing incidence",
              .witness = "masking=sancer kd=0 ks=1 distribution=trowbridge_reitz m=0.33 "
                         "fresnel=one",
              .witness_degrees = 89.99,
              .at_most = 1.772454,
              .conditions = {{.parameter = "masking",
                              .choices = {"smith", "smith_correlated", "sancer"}}},
              .examples = {"kd=0.3 ks=0.7 distribution=gauss m=0.4 masking=smith n=1.8",
                           "kd=0 ks=1 terms=2 m=0.15 m2=0.5 w1=0.4 w2=0.6 masking=sancer "
                           "fresnel=one"}},
             {.options = "convention=m2_over_pi",
              .energy = Energy::exceeds,
              .energy_note = "4 times too bright",
              .witness = "kd=0 ks=1 m=0.3 fresnel=one",
              .examples = {"kd=0 ks=1 m=0.3 fresnel=one"}},
             {.options = "convention=four_m2",
              .energy = Energy::exceeds,
              .energy_note = "pi times too bright",
              .witness = "kd=0 ks=1 m=0.3 fresnel=one",
              .examples = {"kd=0 ks=1 m=0.3 fresnel=one"}},
             {.options = "convention=normalized masking=none",
              .energy = Energy::exceeds,
              .energy_note = "facets that hide each other are counted twice",
              .witness = "kd=0 ks=1 m=0.3 fresnel=one",
              .witness_degrees = 80.,
              .examples = {"kd=0 ks=1 m=0.3 fresnel=one"}}},
            .sampling =
                "one-sample mixture of the cosine and mirrored normals of density D h.z "
                "(gauss: the density of its angles); highlight by its Fresnel factor",
            .errata =
                {"F/pi belongs with exp()/(4 m^2 t^4), F/4 with exp()/(pi m^2 t^4): the same. F/pi "
                 "with exp()/(m^2 t^4) is 4 times too bright, F with exp()/(4 m^2 t^4) pi times: "
                 "both are in print, and are options here.",
                 "The exponent is printed as (tan(theta)/m^2)^2; it is (tan(theta)/m)^2.",
                 "The Trowbridge-Reitz form is printed without its outer square.",
                 "The reflectance of parallel light on a metal is printed with (2nkc - G2)^2 in "
                 "the denominator; it is (2nkc + G2)^2.",
                 "Beckmann's m is sqrt(2) times the standard deviation of the slope along one "
                 "direction."},
            .references = {"R. L. Cook, K. E. Torrance 1982, ACM TOG 1(1), 7-24",
                           "P. Beckmann, A. Spizzichino 1963, The Scattering of Electromagnetic "
                           "Waves from Rough Surfaces",
                           "B. G. Smith 1967, IEEE TAP 15(5); M. I. Sancer 1969, IEEE TAP 17(5)",
                           "R. Hall 1989, Illumination and Color in Computer Generated Imagery",
                           "B. Walter et al. 2007, Microfacet Models for Refraction through Rough "
                           "Surfaces, EGSR"},
        };
        add_fresnel_parameters(d.parameters);
        return d;
    }();
    return description;
}

template <class D, class P = D, class S = D>
struct CookTorrance : FacetReflection<D, P, S> {
    using Facets = FacetReflection<D, P, S>;

    CookTorranceConvention convention;
    CookTorranceWidth width;
    S beta;

    static const ModelDescription& describe() { return cook_torrance_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("distribution", m.distribution);
        f("masking", m.masking);
        f("convention", m.convention);
        f("kd", m.kd);
        f("ks", m.ks);
        f("m", m.m[0]);
        f("width", m.width);
        f("beta", m.beta);
        f("terms", m.terms);
        f("w1", m.weight[0]);
        f("w2", m.weight[1]);
        f("m2", m.m[1]);
        f("w3", m.weight[2]);
        f("m3", m.m[2]);
        m.fresnel.parameters(m.fresnel, f);
    }
    void prepare() {
        const S radians = beta * S(std::numbers::pi / 180);
        if (width == CookTorranceWidth::half_height)
            this->m[0] = width_of_half_height(this->distribution, radians);
        else if (width == CookTorranceWidth::unclipped)
            this->m[0] = this->distribution == FacetDistribution::beckmann
                             ? width_unclipped(radians)
                             : width_of_half_height(this->distribution, radians);
        Facets::prepare();
        this->scale = convention == CookTorranceConvention::m2_over_pi ? S(4)
                      : convention == CookTorranceConvention::four_m2  ? S(std::numbers::pi)
                                                                       : S(1);
    }
};

}  // namespace nacre
