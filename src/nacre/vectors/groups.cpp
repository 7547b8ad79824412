#include "nacre/vectors/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace nacre {
namespace {

void give_whole_highlight(Settings& settings) {
    for (const Setting& s : settings)
        if (s.name == "ks") return;
    settings.push_back({"ks", 1.});
}

/// The vectors give the wavelength in micrometres.
void lambda_in_nanometres(Settings& settings) {
    for (Setting& s : settings)
        if (s.name == "lambda") s.value = 1e3 * std::get<double>(s.value);
}

/// The vectors give lobes without weights, and matrices as nine numbers.
void weigh_lobes(Settings& settings) {
    const auto given = [&](std::string_view name) {
        return std::any_of(settings.begin(), settings.end(),
                           [&](const Setting& s) { return s.name == name; });
    };
    for (int lobe = 0; lobe < 3; ++lobe) {
        const std::string key = fmt::format("lobes_{}_", lobe);
        if (given(key + "n") && !given(key + "ks")) settings.push_back({key + "ks", 1.});
    }
    for (const char* lower : {"_M_1_0", "_M_2_0", "_M_2_1"})
        std::erase_if(settings, [&](const Setting& s) { return s.name.ends_with(lower); });
}

const std::map<std::string_view, std::vector<ReferenceGroup>>& table() {
    static const std::map<std::string_view, std::vector<ReferenceGroup>> all = {
        {"lambert", {{.name = "lambert"}, {.name = "pdf_cosine", .pdf = true}}},
        {"oren_nayar",
         {{.name = "oren_nayar_full", .settings = "variant=full"},
          {.name = "oren_nayar", .settings = "variant=qualitative"}}},
        {"eon",
         {{.name = "oren_nayar_fujii", .settings = "variant=fujii"},
          {.name = "eon", .settings = "variant=eon"}}},
        {"phong",
         {{.name = "phong_brdf", .settings = "variant=classic"},
          {.name = "modified_phong", .settings = "variant=modified"},
          {.name = "pdf_phong", .settings = "kd=0 ks=1", .pdf = true}}},
        {"blinn_phong",
         {{.name = "blinn_phong_brdf", .settings = "variant=classic"},
          {.name = "normalized_blinn_phong", .settings = "variant=normalized"},
          {.name = "pdf_blinn", .settings = "kd=0 ks=1", .pdf = true}}},
        {"torrance_sparrow",
         {{.name = "cook_torrance_gauss", .ignored = {"D", "G"}, .adapt = give_whole_highlight}}},
        {"blinn_torrance_sparrow", {{.name = "blinn_torrance_sparrow"}}},
        {"cook_torrance",
         {{.name = "cook_torrance_beckmann", .adapt = give_whole_highlight},
          {.name = "cook_torrance_phong", .adapt = give_whole_highlight},
          {.name = "cook_torrance_tr", .adapt = give_whole_highlight},
          {.name = "cook_torrance_multi", .settings = "terms=2"},
          {.name = "cook_torrance_sancer", .adapt = give_whole_highlight},
          {.name = "pdf_beckmann", .settings = "kd=0 ks=1", .pdf = true},
          {.name = "pdf_ggx", .settings = "kd=0 ks=1", .pdf = true}}},
        {"ggx",
         {{.name = "ggx_smith", .ignored = {"D"}},
          {.name = "kulla_conty", .settings = "ks=1 fresnel=schlick", .tolerance = 1e-6},
          {.name = "pdf_vndf_ggx", .settings = "ks=1 fresnel=one", .pdf = true}}},
        {"metallic_roughness", {{.name = "metallic_roughness"}}},
        {"ward",
         {{.name = "ward_iso"},
          {.name = "ward_aniso"},
          {.name = "ward_fast"},
          {.name = "ward_duer"},
          {.name = "ward_gmd"},
          {.name = "ward_original", .albedos_only = true},
          {.name = "ward_original_aniso", .albedos_only = true},
          {.name = "ward_duer_aniso", .albedos_only = true},
          {.name = "ward_gmd_aniso", .albedos_only = true},
          {.name = "pdf_ward", .settings = "kd=0 ks=1", .pdf = true}}},
        {"schlick",
         {{.name = "schlick94", .settings = "masking=given"},
          {.name = "pdf_schlick", .settings = "form=simple", .pdf = true}}},
        {"schlick_ct", {{.name = "schlick_ct"}}},
        {"he_torrance", {{.name = "he_torrance", .adapt = lambda_in_nanometres}}},
        {"lafortune",
         {{.name = "lafortune", .settings = "norm=none", .adapt = weigh_lobes},
          {.name = "pdf_lafortune", .settings = "kd=0 ks=1", .pdf = true}}},
    };
    return all;
}

}  // namespace

std::span<const ReferenceGroup> groups_of(std::string_view model) {
    const auto at = table().find(model);
    return at == table().end() ? std::span<const ReferenceGroup>() : at->second;
}

}  // namespace nacre
