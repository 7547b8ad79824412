#include "nacre/reflectance/schlick.h"

namespace nacre {

// The manual page of schlick.h, apart from it for length.
const ModelDescription& schlick_description() {
    const auto layer = [](std::string_view name, std::string_view meaning, double otherwise,
                          bool above_low, std::vector<std::string_view> aliases = {}) {
        return Parameter{.name = name,
                         .meaning = meaning,
                         .above_low = above_low,
                         .otherwise = otherwise,
                         .aliases = std::move(aliases)};
    };
    static const ModelDescription description{
        .name = "schlick",
        .title = "Schlick",
        .authors = "C. Schlick",
        .year = 1994,
        .paper =
            "An Inexpensive BRDF Model for Physically-Based Rendering, Computer Graphics "
            "Forum 13(3)",
        .equations =
            "the single and double layer models, Z, A, G and the three directional factors",
        .formula =
            "one: f = S Q;  two: f = S Q + (1 - S) S' Q'\n"
            "constant: S = c;  fresnel: S = c + (1 - c) (1-u)^5, u = wi.h\n"
            "Z = r/(1 + r t^2 - t^2)^2, t = h.z\n"
            "A = sqrt(p/(p^2 - p^2 w^2 + w^2)), w = cos of the azimuth of h\n"
            "g(v) = v/(v - k v + k), v = wi.z, v' = wo.z, N = 4 pi v v'\n"
            "simple:             Q = Z A/N\n"
            "reemission:         Q = (g g' Z A + 1 - g g')/N\n"
            "reemission_bounded: Q = g g' Z A/N + (1 - g g')/pi\n"
            "mixture:            Q = a/pi + b Z A/N + (1-a-b) mirror\n"
            "mixture_reemission: Q = a/pi + b (g g' Z A + 1 - g g')/N + (1-a-b) mirror\n"
            "masked:             Q = g g' Z A/N\n"
            "b = 4 r (1-r); a = 1 - b for r >= 1/2, else 0",
        .parameters =
            {choice_parameter(
                 "form", "the directional factor Q",
                 {{"simple", "no masking", {"73"}},
                  {"reemission", "what is masked comes out again, as printed", {"76"}},
                  {"reemission_bounded", "the same, re-emitted as Lambert's law", {"761"}},
                  {"mixture", "diffuse, glossy and mirror by r", {"77"}},
                  {"mixture_reemission", "mixture, its glossy part that of reemission", {"771"}},
                  {"masked", "what is masked is lost"}},
                 5),
             choice_parameter(
                 "spectral", "the spectral factor S",
                 {{"fresnel", "c, rising to 1 at grazing incidence"}, {"constant", "c", {"const"}}},
                 0, {"S"}),
             choice_parameter("layers", "how many layers",
                              {{"one", "homogeneous", {"hom"}},
                               {"two", "heterogeneous: a second below the first", {"het"}}}),
             choice_parameter("masking", "k of g",
                              {{"published", "r"},
                               {"slope", "sqrt(2/pi) r/2, of a Gaussian slope of r/2"},
                               {"ggx", "sqrt(r)/2, that of the GGX distribution which Z is"},
                               {"given", "the parameters k and k2"}},
                              2),
             {.name = "c",
              .meaning = "reflectance at normal incidence",
              .kind = ParameterKind::spectrum,
              .otherwise = 0.8,
              .aliases = {"C"}},
             layer("r", "roughness: 0 mirror, 1 diffuse", 0.1, true),
             layer("p", "isotropy: 1 isotropic, towards 0 a brushed surface", 1., true),
             layer("k", "masking, with masking=given", 0.1, false),
             {.name = "c2",
              .meaning = "reflectance of the second layer",
              .kind = ParameterKind::spectrum,
              .otherwise = 0.5,
              .aliases = {"C2"}},
             layer("r2", "roughness of the second layer", 1., true),
             layer("p2", "isotropy of the second layer", 1., true),
             layer("k2", "masking of the second layer, with masking=given", 0.1, false)},
        .behaviours =
            // p = 1 is GGX facets with Smith's masking, which reflect no more than they get, and
        // two constant layers are a mean of such lobes. Of two others each is at most 1.
        {{.options = "form=masked masking=ggx layers=one",
          .energy_note = "for p = 1 exactly; the most with any p is approached at normal "
                         "incidence as r goes to 0",
          .examples = {"spectral=constant c=1 r=0.2", "c=0.5 r=0.05 p=0.5"}},
         {.options = "form=masked masking=ggx layers=two spectral=constant",
          .examples = {"c=0.3 r=0.1 c2=0.6 r2=1"}},
         {.options = "form=masked masking=ggx layers=two spectral=fresnel",
          .energy = Energy::exceeds,
          .energy_note = "a narrow first layer reflects by its mirror angle, a wide second one "
                         "transmits by smaller ones: below 2, of which 1.794 is "
                         "reached at 89.8 degrees across the tangent for c=0 r=1e-9 c2=1 "
                         "r2=0.1686 p2=0.3013",
          .witness = "c=0 r=1e-6 c2=1 r2=0.188",
          .witness_degrees = 89.31,
          .at_most = 2.,
          .examples = {"c=0.04 r=0.1 c2=0.6 r2=1"}},
         {.options = "form=simple",
          .energy = Energy::exceeds,
          .energy_note = "grows without bound towards grazing incidence; 1/(1+r) at the normal",
          .witness = "spectral=constant c=1 r=0.2",
          .witness_degrees = 80.,
          .examples = {"spectral=constant c=1 r=0.2", "c=0.3 r=0.1 p=0.3"}},
         {.options = "form=reemission masking=published",
          .energy = Energy::exceeds,
          .energy_note = "the re-emitted part is divided by 4 pi v v' too",
          .witness = "spectral=constant c=1 r=0.2",
          .witness_degrees = 80.,
          .examples = {"spectral=constant c=1 r=0.2", "layers=two c=0.3 r=0.1 p=0.3"}},
         {.options = "form=reemission_bounded masking=published",
          .energy = Energy::exceeds,
          .energy_note = "at grazing incidence, by the lobe alone",
          .witness = "spectral=constant c=1 r=0.2",
          .witness_degrees = 80.,
          .examples = {"spectral=constant c=1 r=0.2"}},
         {.options = "form=mixture",
          .energy = Energy::exceeds,
          .energy_note = "at grazing incidence",
          .witness = "spectral=constant c=1 r=0.2",
          .witness_degrees = 80.,
          .examples = {"spectral=constant c=1 r=0.2", "c=0.5 r=0.8 p=0.5"}},
         {.options = "form=mixture_reemission masking=published",
          .energy = Energy::exceeds,
          .energy_note = "at grazing incidence",
          .witness = "spectral=constant c=1 r=0.2",
          .witness_degrees = 80.,
          .examples = {"spectral=constant c=1 r=0.2"}}},
        .isotropy =
            "isotropic for p = 1, else anisotropic: a brushed surface, its scratches along "
            "the tangent",
        .sampling =
            "one-sample mixture of the cosine and mirrored normals of density Z t A^2/pi: "
            "t^2 = u/(r - r u + u), azimuth atan2(sin x, p cos x) with x uniform",
        .albedo = "simple, p = 1, constant c = 1, normal incidence: 1/(1+r)",
        .errata =
            {"Z is printed without its numerator r; with it the integral of Z t over normals is "
             "pi, and Z/pi is the GGX distribution with alpha^2 = r.",
             "g is printed v/(v - k v - k), which has poles; it is v/(v - k v + k).",
             "The mixture is described as containing the whole of the first or second form; it is "
             "their numerators, or 1/(4 pi v v') counts twice.",
             "r = 1 is called Lambert's law: true of the mixture, not of the simple form, which "
             "is 1/(4 pi v v').",
             "The mean of A over azimuths is (2/pi) sqrt(p) K(1 - p^2), below 1 for p < 1 (0.744 "
             "for p = 0.1): anisotropy loses light. The mean of A^2 is 1.",
             "Recommended is form=masked masking=ggx, the only one without gain, with one layer or "
             "spectral=constant."},
        .references = {"C. Schlick 1994, CGF 13(3), 233-246",
                       "C. Schlick 1993, A Customizable Reflectance Model for Everyday Rendering, "
                       "Eurographics Workshop on Rendering, 73-84"},
    };
    return description;
}

}  // namespace nacre
