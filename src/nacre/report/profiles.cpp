// The chart of diffusion profiles beside a simulation of the same half space.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "nacre/bssrdf/profile.h"
#include "nacre/layers/slab_monte_carlo.h"
#include "nacre/math/error.h"
#include "nacre/render/profile_tables.h"
#include "nacre/report/experiment.h"
#include "nacre/scene/subsurface.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

constexpr double near_mfp = 0.03, far_mfp = 12;  // transport mean free paths that are shown
constexpr int points = 60;

/// Light that leaves between r and r + dr, over dr, in mm^-1: the area below a curve is light.
double per_length(double r, double density) { return 2 * std::numbers::pi * r * density; }

std::vector<std::string> profiles_of(const std::vector<ExperimentRow>& rows) {
    std::vector<std::string> names;
    for (const ExperimentRow& row : rows) {
        if (row.peer) continue;
        const TechniqueDescription& technique = techniques().find(row.setting.choice.technique);
        if (std::ranges::find(technique.parameters, "profile", &Parameter::name) ==
            technique.parameters.end())
            continue;
        const std::string chosen = row.setting.choice.option("profile");
        const std::string name = chosen.empty() ? SubsurfaceSettings().profile : chosen;
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    return names;
}

ordered_json analytic(const std::string& name, const ProfileMedium& medium, double mfp) {
    const auto profile = make_profile(name, medium);
    ordered_json list = ordered_json::array();
    for (int i = 0; i <= points; ++i) {
        const double r = mfp * near_mfp * std::pow(far_mfp / near_mfp, double(i) / points);
        list.push_back({r, per_length(r, profile->eval(r))});
    }
    return {{"name", name}, {"points", list}};
}

/// Photons in rings that are so wide that the noise is below the width of a line.
ordered_json simulated(const ProfileMedium& medium, double mfp) {
    LayerStack stack;
    stack.layers = {{medium.sigma_s, medium.sigma_a, medium.g,
                     std::numeric_limits<double>::infinity(), medium.eta}};
    stack.eta_below = medium.eta;
    SlabMonteCarloOptions options;
    options.photons = 300'000;
    options.bins.radius = 1000;
    options.bins.radius_width = far_mfp * mfp / options.bins.radius;
    const SlabMonteCarloResult r = slab_monte_carlo(stack, options);
    const double entered = 1 - r.totals.specular;
    ordered_json list = ordered_json::array();
    // Bins grow with the radius: sums over a fifth of it.
    for (int first = 0; first < options.bins.radius;) {
        const int last = std::min(options.bins.radius, std::max(first + 2, int(first * 1.2)));
        double power = 0, area = 0;
        for (int i = first; i < last; ++i) {
            const double ring = 2. * i + 1;
            power += r.reflected_radius[i].mean * ring;
            area += ring;
        }
        const double width = options.bins.radius_width;
        const double inner = first * width, outer = last * width;
        // The radius that halves the ring's area.
        const double at = std::sqrt(0.5 * (inner * inner + outer * outer));
        if (power > 0) list.push_back({at, per_length(at, power / area / entered)});
        first = last;
    }
    return {{"name", "simulation"}, {"reference", true}, {"points", list}};
}

}  // namespace

ordered_json profile_chart(const Scene& scene, const std::vector<ExperimentRow>& rows) {
    const std::vector<std::string> names = profiles_of(rows);
    const auto shape = std::ranges::find_if(scene.shapes, is_translucent);
    if (names.empty() || shape == scene.shapes.end()) return nullptr;
    const Bands bands(scene.mode);
    ProfileMedium medium =
        medium_in_bands(*shape->interior, boundary_eta(*shape), bands)[bands.count() / 2];
    medium.sigma_s /= scene.mm_per_unit;
    medium.sigma_a /= scene.mm_per_unit;
    if (!(medium.sigma_s > 0)) return nullptr;
    const double mfp = 1 / medium.sigma_t_prime();
    ordered_json series = ordered_json::array();
    try {
        series.push_back(simulated(medium, mfp));
    } catch (const InputError&) {
        // Matter that absorbs nothing has no end of walks: profiles alone.
    }
    for (const std::string& name : names) try {
            series.push_back(analytic(name, medium, mfp));
        } catch (const InputError&) {
            // A profile that does not take this medium: its row says why.
        }
    return {
        {"id", "profiles"},
        {"title", "Diffusion profiles"},
        {"text",
         fmt::format(
             "How much of the light that entered a flat half space of '{}' at one "
             "point leaves at a distance r, 2 pi r R(r), {}: the profiles beside a simulation of "
             "a narrow beam that falls in along the normal. The simulation holds "
             "light that was scattered once; most profiles leave it to a term of "
             "its own. Transport mean free path {:.3g} mm.",
             shape->name, scene.mode == ColorMode::rgb_bands ? "green band" : "600 nm", mfp)},
        {"kind", "lines"},
        {"x", {{"title", "distance"}, {"unit", "mm"}, {"log", true}}},
        {"y", {{"title", "2πr R(r)"}, {"unit", "mm⁻¹"}, {"log", false}}},
        {"series", series}};
}

}  // namespace nacre
