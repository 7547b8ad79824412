#pragma once
// The metallic-roughness surface of glTF 2.0: a mixture of a metal and of a matt dielectric under a
// rough boundary, as files of scanned and painted objects carry it.
//
//   Khronos Group 2021, glTF 2.0 Specification, 3.9.2 and Appendix B;
//   KHR_materials_ior, KHR_materials_specular (Khronos 2021).
//   P. Shirley, B. Smits, H. Hu, E. Lafortune 1997, A Practitioners' Assessment of Light Reflection
//   Models, Pacific Graphics, section 4 (coupling=shirley).
//
// The formulas are in the description below; D and L: ggx.h, with alpha = roughness^2.
#include "nacre/math/warp.h"
#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/ggx.h"
#include "nacre/reflectance/model.h"

namespace nacre {

enum class MetallicCoupling { half_vector, shirley };

inline const ModelDescription& metallic_roughness_description() {
    static const ModelDescription description{
        .name = "metallic_roughness",
        .title = "Metallic-roughness of glTF 2.0",
        .authors = "Khronos Group",
        .year = 2021,
        .paper = "glTF 2.0 Specification, Appendix B; KHR_materials_ior, KHR_materials_specular",
        .equations = "Appendix B, B.2 and B.3",
        .formula =
            "f = metallic D G Fm / (4 wi.z wo.z)\n"
            "    + (1 - metallic) (base_color C/pi + D G Fd / (4 wi.z wo.z))\n"
            "Fm = base_color + (1 - base_color) (1 - wi.h)^5\n"
            "Fd = specular (f0 + (1 - f0) (1 - wi.h)^5)\n"
            "f0 = min(1, specular_color ((ior - 1)/(ior + 1))^2)\n"
            "D, G: GGX of alpha = roughness^2, masking correlated in height\n"
            "half_vector: C = 1 - Fd\n"
            "shirley:     C = (1 - Fd(wi.z)) (1 - Fd(wo.z)) / (1 - specular (f0 + (1 - f0)/21))",
        .parameters = {choice_parameter(
                           "coupling", "of the matt base to the boundary above it",
                           {{"half_vector", "as Appendix B has it; gains energy at the rim"},
                            {"shirley", "what the boundary lets through, both ways"}}),
                       {.name = "base_color",
                        .meaning = "albedo of the matt base, and normal reflectance of the metal",
                        .kind = ParameterKind::spectrum,
                        .otherwise = 0.5,
                        .aliases = {"baseColor"}},
                       {.name = "metallic", .meaning = "share of the metal", .otherwise = 0.},
                       {.name = "roughness",
                        .meaning = "square root of GGX's alpha, which is 0.001 at least",
                        .otherwise = 0.5},
                       {.name = "ior",
                        .meaning = "index of refraction of the dielectric",
                        .low = 1.,
                        .high = 10.,
                        .otherwise = 1.5,
                        .aliases = {"eta", "int_ior"}},
                       {.name = "specular",
                        .meaning = "weight of the dielectric's boundary",
                        .otherwise = 1.},
                       {.name = "specular_color",
                        .meaning = "colour of the dielectric's normal reflectance",
                        .kind = ParameterKind::spectrum,
                        .high = 100.,
                        .otherwise = 1.}},
        .behaviours =
            {{.options = "coupling=half_vector",
              .energy = Energy::exceeds,
              .energy_note =
                  "a white dielectric reflects nearly twice the light near grazing: 1 - Fd takes "
                  "its angle from the facet, which for diffuse light from above is far from "
                  "grazing, while the boundary mirrors all",
              .witness = "base_color=1 metallic=0 roughness=0.02",
              .witness_degrees = 89.9,
              .at_most = 2.,
              .examples = {"base_color=0.8 roughness=0.3", "base_color=1 roughness=0.1",
                           "base_color=0.9 metallic=1 roughness=0.6"}},
             {.options = "coupling=shirley",
              .energy = Energy::exceeds,
              .energy_note =
                  "a smooth white dielectric reflects all of it; a rough boundary reflects more "
                  "than Fd(wo.z) by 0.0025 at most (ior=1 roughness=0.35, 53 degrees; 0.0015 for "
                  "ior=1.5)",
              .witness = "base_color=1 roughness=0.35 ior=1",
              .witness_degrees = 53.,
              .at_most = 1.003,
              .examples = {"base_color=1 roughness=0.2", "base_color=0.8 metallic=0.5 roughness=1",
                           "base_color=0.9 metallic=1 roughness=0.4",
                           "base_color=1 roughness=0.5 ior=2.5 specular_color=3"}}},
        .sampling =
            "one-sample mixture of the cosine and mirrored visible normals, by their reflectances "
            "at the angle of the viewer",
        .errata = {"KHR_materials_specular takes the largest of the three components of Fd in C. "
                   "Here each wavelength has its own, which differs for a coloured specular_color "
                   "only.",
                   "roughness = 0 is a mirror without blur in the specification; here its lobe is "
                   "0.1 degrees wide."},
        .references = {"Khronos Group 2021, glTF 2.0 Specification, Appendix B",
                       "P. Shirley et al. 1997, A Practitioners' Assessment of Light Reflection "
                       "Models, Pacific Graphics",
                       "C. Schlick 1994, CGF 13(3)", "B. Walter et al. 2007, EGSR, 195-206"},
    };
    return description;
}

template <class D, class P = D, class S = D>
struct MetallicRoughness {
    MetallicCoupling coupling;
    P base_color;
    S metallic, roughness, ior, specular;
    P specular_color;

    static const ModelDescription& describe() { return metallic_roughness_description(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("coupling", m.coupling);
        f("base_color", m.base_color);
        f("metallic", m.metallic);
        f("roughness", m.roughness);
        f("ior", m.ior);
        f("specular", m.specular);
        f("specular_color", m.specular_color);
    }

    Product<Product<D, S>, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        using V = Product<D, S>;
        using T = Product<V, P>;
        const Ggx<D, S> ggx = facets();
        const D u = D(0.5) * sqrt(dot(wi + wo, wi + wo));
        const V g = V(D(1)) / (V(D(1)) + ggx.lambda(wi) + ggx.lambda(wo));
        const V lobe =
            ggx.density(half_vector(wi, wo)) * g * V(D(0.25) / at_least(D(wi.z * wo.z), 1e-14));
        const T metal = fresnel_schlick(T(u), T(base_color)), boundary = at<T>(u);
        T through = T(D(1)) - boundary;
        if (coupling == MetallicCoupling::shirley) {
            const P rest = P(S(1)) - P(specular) * (f0_ + (P(S(1)) - f0_) * P(S(1. / 21.)));
            through = (T(D(1)) - at<T>(at_least(wi.z, 0.))) *
                      (T(D(1)) - at<T>(at_least(wo.z, 0.))) / T(at_least(rest, 1e-6));
        }
        const T matt = T(D(inv_pi)) * T(base_color) * through;
        return T(above(wi, wo)) *
               (T(metallic) * T(lobe) * metal + T(S(1) - metallic) * (matt + T(lobe) * boundary));
    }
    Vec3<D> sample(const Vec3<D>& wo, D u1, Vec2<D> u2) const {
        if (!(u1 < highlight_share(wo))) return square_to_cosine_hemisphere(u2);
        return reflect(wo, facets().sample_visible(wo, u2));
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        using std::sqrt;
        const D length = sqrt(at_least(dot(wi + wo, wi + wo), 1e-20));
        const D lobe = visible_density(facets(), wo, half_vector(wi, wo)) * D(0.5) / length;
        const D share = highlight_share(wo);
        return above(wi, wo) * (share * lobe + (D(1) - share) * D(inv_pi) * wi.z);
    }

    void prepare() {
        const S r = (ior - S(1)) / (ior + S(1));
        const P normal = specular_color * P(S(r * r)), one = P(S(1));
        f0_ = select(normal < one, normal, one);
    }

  private:
    P f0_ = P(0.f);

    Ggx<D, S> facets() const {
        const S alpha = at_least(S(roughness * roughness), 1e-3);
        return {alpha, alpha};
    }
    /// Fd at the cosine u.
    template <class T>
    T at(const D& u) const {
        return T(specular) * fresnel_schlick(T(u), T(f0_));
    }
    D highlight_share(const Vec3<D>& wo) const {
        const D mu = at_least(wo.z, 0.);
        const P metal = fresnel_schlick(P(mu), base_color);
        return D(specular_share(P(base_color * P(S(1) - metallic)),
                                P(P(metallic) * metal + P(S(1) - metallic) * at<P>(mu))));
    }
};

}  // namespace nacre
