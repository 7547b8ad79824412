#include "nacre/vectors/scattering.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"

namespace nacre {
namespace {

using nlohmann::json;

struct Group {
    const char* name;
    Measure measure;
    double tolerance;
    CompareGroup compare;
};

// What is rounded and what is fitted by quadrature decides the tolerance: closed forms in double
// precision are compared to 1e-10, those that subtract to 1e-9. Adding and doubling adds to 1e-8
// what the vectors state for their own quadrature; simulations are compared in standard errors. The
// diffusion equation is solved on grids that reach 1e-3, and 1e-2 where a point source is near.
constexpr Group groups[] = {
    {"phase", Measure::relative, 1e-10, compare_phase},
    {"fresnel", Measure::relative, 1e-10, compare_fresnel},
    {"dipole", Measure::relative, 1e-9, compare_dipole},
    {"better_dipole", Measure::relative, 1e-9, compare_better_dipole},
    {"photon_beam_diffusion", Measure::relative, 1e-6, compare_photon_beam},
    {"directional_dipole", Measure::relative, 1e-9, compare_directional_dipole},
    {"normalized_diffusion", Measure::relative, 1e-10, compare_normalised_diffusion},
    {"chiang2016", Measure::relative, 1e-10, compare_chiang},
    {"kubelka_munk", Measure::relative, 1e-10, compare_kubelka_munk},
    {"hanrahan_krueger", Measure::relative, 1e-9, compare_hanrahan_krueger},
    {"slab_adding_doubling", Measure::absolute, 1e-8, compare_slab},
    {"semi_infinite", Measure::absolute, 1e-8, compare_half_space},
    {"monte_carlo", Measure::standard_errors, 4., compare_monte_carlo},
    {"diffusion_pde", Measure::relative, 1e-3, compare_diffusion},
    {"dipole_triangle_integrals", Measure::relative, 1e-8, compare_triangle},
    {"skin_jacques", Measure::relative, 1e-10, compare_skin},
    {"materials_jensen2001", Measure::relative, 1e-10, compare_materials},
    {"published_anchors", Measure::absolute, 1e-8, compare_anchors},
};

}  // namespace

bool is_scattering_file(const json& all) {
    return std::any_of(std::begin(groups), std::end(groups),
                       [&](const Group& g) { return all.contains(g.name); });
}

VectorReport check_scattering(const json& all, const std::string& path, const TellGroup& tell) {
    VectorReport report;
    for (const auto& [name, rows] : all.items()) {
        if (name == "meta") continue;
        const auto group = std::find_if(std::begin(groups), std::end(groups),
                                        [&](const Group& g) { return name == g.name; });
        if (group == std::end(groups)) {
            report.not_covered.push_back(name);
            continue;
        }
        Comparison result(group->measure, group->tolerance);
        try {
            group->compare(rows, result);
        } catch (const json::exception& error) {
            throw InputError(fmt::format("group '{}' of '{}': {}", name, path, error.what()));
        }
        report.groups.push_back({.name = name,
                                 .count = result.count(),
                                 .measure = group->measure,
                                 .deviation = result.deviation(),
                                 .tolerance = result.tolerance(),
                                 .good = result.good(),
                                 .worst = result.where()});
        if (tell) tell(report.groups.back());
    }
    return report;
}

}  // namespace nacre
