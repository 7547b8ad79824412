#pragma once
// GGX facets with Smith's masking, and the light that they scatter among themselves.
//
//   B. Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces, EGSR.
//   E. Heitz 2014, Understanding the Masking-Shadowing Function, JCGT 3(2); 2018, Sampling the GGX
//   Distribution of Visible Normals, JCGT 7(4).
//   C. Kulla, A. Conty 2017, Revisiting Physically Based Shading at Imageworks, SIGGRAPH course;
//   after C. Kelemen, L. Szirmay-Kalos 2001.
//
// The formulas are in the description below; D and L: ggx.h; E and E_avg: ggx_albedo.h.
#include "nacre/math/quadrature.h"
#include "nacre/math/warp.h"
#include "nacre/reflectance/facet_fresnel.h"
#include "nacre/reflectance/ggx.h"
#include "nacre/reflectance/ggx_albedo.h"

namespace nacre {

enum class GgxMasking { smith_correlated, smith };
enum class GgxCompensation { none, kulla_conty, slides };

inline const ModelDescription& ggx_smith_description() {
    static const ModelDescription description = [] {
        ModelDescription d{
            .name = "ggx",
            .title = "GGX with Smith's masking",
            .authors =
                "B. Walter, S. R. Marschner, H. Li, K. E. Torrance; E. Heitz; C. Kulla, A. "
                "Conty",
            .year = 2007,
            .paper =
                "Microfacet Models for Refraction through Rough Surfaces, Eurographics "
                "Symposium on Rendering",
            .equations =
                "20, 23, 33-36; correlated: Heitz 2014, 99; compensation: Kulla and Conty "
                "2017",
            .formula =
                "f = kd/pi + ks (F D G / (4 wi.z wo.z)\n"
                "    + F_ms (1 - E(wi)) (1 - E(wo)) / (pi (1 - E_avg)))\n"
                "D = 1/(pi au av ((h.x/au)^2 + (h.y/av)^2 + h.z^2)^2)\n"
                "L(w) = (sqrt(1 + ((au w.x)^2 + (av w.y)^2)/w.z^2) - 1)/2\n"
                "smith_correlated: G = 1/(1 + L(wi) + L(wo))\n"
                "smith:            G = 1/((1 + L(wi)) (1 + L(wo)))\n"
                "kulla_conty: F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg))\n"
                "slides:      F_ms = F_avg E_avg / (1 - F_avg (1 - E_avg))\n"
                "E: albedo of D G with F = 1, E_avg = 2 int E mu dmu, F_avg likewise",
            .parameters = {choice_parameter(
                               "masking", "shadowing and masking G",
                               {{"smith_correlated", "correlated in height", {"smith_corr"}},
                                {"smith", "separable", {"smith_sep"}}},
                               0, {"G"}),
                           choice_parameter(
                               "compensation", "of the light that is scattered more than once",
                               {{"none", "lost"},
                                {"kulla_conty",
                                 "given back, and coloured as often as it is reflected",
                                 {"F2"}},
                                {"slides",
                                 "as the slides of 2017 colour it: one reflection too few",
                                 {"F1"}}},
                               0, {"tint"}),
                           diffuse_parameter(0.),
                           specular_parameter(1.),
                           {.name = "alpha_u",
                            .meaning = "roughness along the tangent",
                            .high = 1.5,
                            .above_low = true,
                            .otherwise = 0.3,
                            .aliases = {"alpha", "alphaU", "m"}},
                           {.name = "alpha_v",
                            .meaning = "roughness across the tangent",
                            .high = 1.5,
                            .above_low = true,
                            .otherwise = 0.3,
                            .aliases = {"alpha", "alphaV", "m"}}},
            .bounds = {{.parameters = {"kd", "ks"}}},
            .behaviours =
                // Smith's masking shares out the projected area of the facets: E is at most 1, and
            // E + (1 - E) F_ms with F_ms <= 1 too, if E is that of the facets: alpha_u =
            // alpha_v.
            {{.options = "compensation=none",
              .energy_note = "for kd + ks <= 1",
              .examples = {"fresnel=one alpha=0.2", "fresnel=one alpha=0.9 masking=smith",
                           "kd=0.3 ks=0.6 alpha_u=0.1 alpha_v=0.5 fresnel=conductor n=0.2 k=3.4",
                           "kd=0.5 ks=0.5 alpha=0.3 n=1.5"}},
             {.options = "compensation=kulla_conty masking=smith_correlated",
              .energy_note = "for kd + ks <= 1; to 1e-6 all of it for fresnel=one",
              .conditions = {{.parameter = "alpha_v", .same_as = "alpha_u"}},
              .examples = {"fresnel=schlick f0=0.9 alpha=0.5", "fresnel=schlick f0=0.6 alpha=1",
                           "kd=0.3 ks=0.6 alpha=0.3 fresnel=conductor n=0.2 k=3.4"}},
             {.options = "compensation=slides masking=smith_correlated",
              .energy_note = "for kd + ks <= 1, as kulla_conty; brighter than facets of that "
                             "colour can be",
              .conditions = {{.parameter = "alpha_v", .same_as = "alpha_u"}},
              .examples = {"fresnel=schlick f0=0.5 alpha=0.8"}},
             {.options = "masking=smith_correlated",
              .energy = Energy::exceeds,
              .energy_note = "anisotropic facets get what isotropic ones of alpha = "
                             "sqrt(alpha_u alpha_v) lose: 1.091 is reached at 89.266 degrees "
                             "and 0.4 rad from the tangent for alpha_u=0.2348 "
                             "alpha_v=0.000588 fresnel=one",
              .witness = "compensation=kulla_conty alpha_u=0.1725 alpha_v=0.00085 fresnel=one",
              .witness_degrees = 89.387,
              .at_most = 1.1,
              .conditions = {{.parameter = "compensation", .choices = {"kulla_conty", "slides"}}},
              .examples = {"compensation=kulla_conty alpha_u=0.1 alpha_v=0.5 fresnel=one"}}},
            .isotropy = "isotropic for alpha_u = alpha_v, else anisotropic",
            .sampling =
                "one-sample mixture of the cosine (diffuse and compensation, by their "
                "albedos) and mirrored visible normals",
            .albedo = "fresnel=one, alpha = 1, normal incidence: 1 - ln 2; with kulla_conty: 1",
            .errata = {"The slides' F_ms lacks one factor F_avg: light that is reflected twice at "
                       "least loses colour twice at least.",
                       "Compensation is that of isotropic facets with correlated masking; with "
                       "alpha_u != alpha_v it takes alpha = sqrt(alpha_u alpha_v)."},
            .references = {"B. Walter et al. 2007, EGSR, 195-206",
                           "T. S. Trowbridge, K. P. Reitz 1975, JOSA 65(5), 531-536",
                           "E. Heitz 2014, JCGT 3(2); 2018, JCGT 7(4)",
                           "C. Kulla, A. Conty 2017, Revisiting Physically Based Shading at "
                           "Imageworks, SIGGRAPH course"},
        };
        add_fresnel_parameters(d.parameters);
        // The vectors of kulla_conty have E_avg from 64 azimuths, 3e-7 too large (0.630648957 for
        // alpha = 0.6 instead of 0.630648616, to which their own quadrature converges).
        return d;
    }();
    return description;
}

template <class D, class P = D, class S = D>
struct GgxSmith {
    GgxMasking masking;
    GgxCompensation compensation;
    P kd, ks;
    S alpha_u, alpha_v;
    FacetFresnel<P, S> fresnel;

    static const ModelDescription& describe() { return ggx_smith_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("masking", m.masking);
        f("compensation", m.compensation);
        f("kd", m.kd);
        f("ks", m.ks);
        f("alpha_u", m.alpha_u);
        f("alpha_v", m.alpha_v);
        m.fresnel.parameters(m.fresnel, f);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        using V = Product<D, S>;
        const Ggx<D, S> ggx{alpha_u, alpha_v};
        const D u = D(0.5) * sqrt(dot(wi + wo, wi + wo));
        const V li = ggx.lambda(wi), lo = ggx.lambda(wo), one = V(D(1));
        const V g =
            masking == GgxMasking::smith ? one / ((one + li) * (one + lo)) : one / (one + li + lo);
        const V facets =
            ggx.density(half_vector(wi, wo)) * g * V(D(0.25) / at_least(D(wi.z * wo.z), 1e-14));
        Product<V, P> f = D(inv_pi) * kd + facets * (ks * fresnel.at(u));
        if (compensation != GgxCompensation::none)
            f += lost(wi) * lost(wo) * V(S(inv_pi) / (S(1) - albedo_.average())) * (ks * colour_);
        return above(wi, wo) * f;
    }
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        if (!(u1 < highlight_share(wo))) return square_to_cosine_hemisphere(u2);
        return reflect(wo, Ggx<D, S>{alpha_u, alpha_v}.sample_visible(wo, u2));
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        const D length = sqrt(at_least(dot(wi + wo, wi + wo), 1e-20));
        const D lobe =
            visible_density(Ggx<D, S>{alpha_u, alpha_v}, wo, half_vector(wi, wo)) * D(0.5) / length;
        const D share = highlight_share(wo);
        return above(wi, wo) * (share * lobe + (D(1) - share) * D(inv_pi) * wi.z);
    }

    void prepare() {
        using std::sqrt;
        if (compensation == GgxCompensation::none) return;
        albedo_ = GgxAlbedo<S>(sqrt(alpha_u * alpha_v));
        static const GaussLegendre nodes(16);  // 1e-6 for metals, exact for Schlick's polynomial
        P average = P(0.f);
        for (std::size_t i = 0; i < nodes.node.size(); ++i) {
            const S mu = S(0.5 + 0.5 * nodes.node[i]);
            average += P(S(nodes.weight[i]) * mu * fresnel.at(mu));
        }
        const S e = albedo_.average();
        colour_ = average * e / (P(S(1)) - average * P(S(1) - e));
        if (compensation == GgxCompensation::kulla_conty) colour_ = colour_ * average;
    }

  private:
    GgxAlbedo<S> albedo_;
    P colour_ = P(0.f);

    /// What single scattering loses of the light from w.
    Product<D, S> lost(const Vec3<D>& w) const {
        using std::sqrt;
        return Product<D, S>(D(1)) -
               albedo_(at_least(w.z, 1e-7), D(sqrt(at_least(D(w.x * w.x + w.y * w.y), 1e-30))));
    }
    D highlight_share(const Vec3<D>& wo) const {
        const D mu = at_least(wo.z, 0.);
        if (compensation == GgxCompensation::none)
            return D(specular_share(kd, P(ks * fresnel.at(mu))));
        const D gone = lost(wo);
        return D(specular_share(P(kd + ks * colour_ * P(gone)),
                                P(ks * fresnel.at(mu) * P(D(1) - gone))));
    }
};

}  // namespace nacre
