#include "nacre/measured/fit_plan.h"

#include <algorithm>

namespace nacre {
namespace {

bool one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// What a fit leaves alone unless asked; see fit_plan.h.
bool is_left(const ModelDescription& model, const Parameter& p, bool isotropic) {
    if (model.name == "lafortune")
        return one_of(p.name, {"mirror", "ks2", "ks3"}) ||
               (isotropic && one_of(p.name, {"cxy", "cxz", "cyz"}));
    if (model.name == "schlick") return isotropic && one_of(p.name, {"p", "p2"});
    // Natural light.
    return p.name == "parallel";
}

/// The first alias of p that another parameter of the model has as well; its own name if none.
std::string_view common_name(const ModelDescription& model, const Parameter& p) {
    for (std::string_view alias : p.aliases)
        for (const Parameter& other : model.parameters)
            if (&other != &p &&
                std::find(other.aliases.begin(), other.aliases.end(), alias) != other.aliases.end())
                return alias;
    if (model.name == "lafortune" && one_of(p.name, {"cx", "cy"})) return "cx";
    return p.name;
}

}  // namespace

std::vector<Unknown> plan_unknowns(const ModelDescription& model, const Settings& given,
                                   bool isotropic) {
    std::vector<bool> fixed(model.parameters.size());
    for (const Setting& s : given)
        for (int i : find_parameters(model.name, model.parameters, s.name)) fixed[i] = true;
    std::vector<Unknown> unknowns;
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
        const Parameter& p = model.parameters[i];
        if (fixed[i] || is_left(model, p, isotropic)) continue;
        if (p.kind != ParameterKind::spectrum && p.kind != ParameterKind::scalar) continue;
        Unknown u{std::string(p.name), {int(i)}, p.kind == ParameterKind::spectrum, p.low, p.high,
                  p.otherwise};
        if (p.above_low) u.low = p.low + 1e-3 * (p.otherwise - p.low);
        // Black shows nothing of the lobe that it weights.
        if (u.colour && u.start == 0.) u.start = std::min(0.1, 0.1 * p.high);
        if (isotropic) {
            const std::string name(common_name(model, p));
            const auto same = std::find_if(unknowns.begin(), unknowns.end(),
                                           [&](const Unknown& o) { return o.name == name; });
            if (same != unknowns.end()) {
                same->parameters.push_back(int(i));
                continue;
            }
            // The name must set no more than what the fit may vary.
            bool free = true;
            for (int k : find_parameters(model.name, model.parameters, name))
                free = free && !fixed[k];
            if (free) u.name = name;
        }
        unknowns.push_back(std::move(u));
    }
    return unknowns;
}

std::vector<std::vector<double>> plan_starts(const std::vector<Unknown>& unknowns) {
    std::vector<double> defaults;
    std::vector<int> scalars;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
        defaults.push_back(unknowns[i].start);
        if (!unknowns[i].colour) scalars.push_back(int(i));
    }
    const auto value = [&](int i, int which) {
        const Unknown& u = unknowns[i];
        constexpr double factor[3] = {1., 0.25, 4.}, part[3] = {0.5, 0.1, 0.9};
        const double x =
            u.start != 0. ? u.start * factor[which] : u.low + part[which] * (u.high - u.low);
        return std::clamp(x, u.low, u.high);
    };
    std::vector<std::vector<double>> starts;
    const bool together = scalars.size() > 3;
    int count = 1;
    for (std::size_t k = 0; k < (together ? 1 : scalars.size()); ++k) count *= 3;
    for (int n = 0; n < count; ++n) {
        std::vector<double> start = defaults;
        int rest = n;
        for (int i : scalars) {
            start[i] = value(i, rest % 3);
            if (!together) rest /= 3;
        }
        starts.push_back(std::move(start));
    }
    return starts;
}

}  // namespace nacre
