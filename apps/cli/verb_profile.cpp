// nacre profile: how far light spreads below a surface, by the diffusion profiles and by slab Monte
// Carlo.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/number_option.h"
#include "apps/cli/plot.h"
#include "apps/cli/profile_medium.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/streams.h"
#include "apps/cli/verb.h"
#include "nacre/bssrdf/profile.h"
#include "nacre/bssrdf/radial_integral.h"
#include "nacre/layers/slab_monte_carlo.h"
#include "nacre/math/error.h"

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

struct ProfileArguments {
    std::string profile, output;
    MediumOptions medium;
    std::vector<std::string> set;
    std::optional<double> rmax;
    std::uint64_t photons = 0, seed = 0;
    bool cumulative = false, json = false, quiet = false;
};

/// R or its integral over the radii, of one profile or of the simulation.
struct Column {
    std::string name;
    bool simulated = false;
    double total = 0., total_error = 0.;
    std::vector<double> value = {}, within = {}, value_error = {}, within_error = {};
};

/// Radii in even steps of their logarithm: edges of rings, each a multiple of the first, which is a
/// bin of the simulation.
std::vector<double> ring_edges(const ProfileMedium& m, const ProfileArguments& o) {
    const double free_path = 1. / m.sigma_t_prime();
    const double sigma_tr = std::sqrt(3. * m.sigma_a * m.sigma_t_prime());
    // Ten lengths of the exponential fall, between 10 and 100 free paths.
    const double to =
        o.rmax.value_or(std::clamp(10. / sigma_tr, 10. * free_path, 100. * free_path));
    // Near the source a hundredth of a free path is fine enough; a simulation has 1e4 bins.
    const double bins = std::clamp(std::ceil(to / (0.01 * free_path)), 100., 1e4);
    constexpr double per_decade = 20.;
    std::vector<double> edges;
    double bin = 0.;
    for (double step = 0.; bin < bins; ++step) {
        const double next = std::min(bins, std::round(std::pow(10., step / per_decade)));
        if (next > bin) edges.push_back(next * to / bins);
        bin = next;
    }
    return edges;
}

double middle(double from, double to) { return std::sqrt(from * to); }

Column evaluate(const RadialProfile& profile, const std::vector<double>& edges, bool rings) {
    Column c{.name = std::string(profile.description().name), .total = profile.total()};
    const auto value = [&](double r) { return profile.eval(r); };
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const double a = edges[i], b = edges[i + 1];
        c.value.push_back(rings ? ring_integral(a, b, value) / (std::numbers::pi * (b * b - a * a))
                                : value(middle(a, b)));
        c.within.push_back(profile.cumulative(rings ? b : middle(a, b)));
    }
    return c;
}

/// Of the light that entered, which is how profiles count: the mirrored light is no part of it.
Column simulate(const ProfileMedium& m, const std::vector<double>& edges,
                const ProfileArguments& o) {
    SlabMonteCarloOptions options;
    options.photons = o.photons;
    options.seed = o.seed;
    options.bins.radius_width = edges.front();
    options.bins.radius = int(std::lround(edges.back() / edges.front()));
    const PhotonProgress progress(o.quiet, "--mc");
    const double infinite_depth = std::numeric_limits<double>::infinity();
    const SlabMonteCarloResult r = slab_monte_carlo(
        {{{m.sigma_s, m.sigma_a, m.g, infinite_depth, m.eta}}}, options, progress.work());
    const double width = edges.front(), entered = 1. - r.totals.specular;
    Column c{.name = "monte_carlo",
             .simulated = true,
             .total = (r.totals.reflectance - r.totals.specular) / entered,
             .total_error = r.error.reflectance / entered};
    // A photon leaves in one bin only, so the errors of bins add up as squares (a little less).
    double within = 0., within_square = 0.;
    const auto bin_of = [&](double edge) { return std::size_t(std::lround(edge / width)); };
    const auto add_bins = [&](std::size_t from, std::size_t to) {
        double sum = 0., square = 0.;
        for (std::size_t b = from; b < to; ++b) {
            const double area = std::numbers::pi * width * width * double(2 * b + 1);
            sum += area * r.reflected_radius[b].mean / entered;
            square += std::pow(area * r.reflected_radius[b].error / entered, 2);
        }
        within += sum;
        within_square += square;
        return std::pair(sum, std::sqrt(square));
    };
    add_bins(0, 1);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const double a = edges[i], b = edges[i + 1], area = std::numbers::pi * (b * b - a * a);
        const auto [sum, error] = add_bins(bin_of(a), bin_of(b));
        c.value.push_back(sum / area);
        c.value_error.push_back(error / area);
        c.within.push_back(within);
        c.within_error.push_back(std::sqrt(within_square));
    }
    return c;
}

/// The profile of that name, or all. Of all, those are left out, with a word on why, that cannot be
/// made of the medium, and an option goes to those that have it.
std::vector<std::unique_ptr<RadialProfile>> chosen_profiles(const ProfileMedium& medium,
                                                            const ProfileArguments& o) {
    Settings settings;
    for (const std::string& s : o.set) settings.push_back(parse_setting(s));
    std::vector<std::unique_ptr<RadialProfile>> chosen;
    if (o.profile != "all") {
        chosen.push_back(make_profile(o.profile, medium, settings));
        return chosen;
    }
    const auto has = [](const ProfileDescription& p, const Setting& s) {
        return std::any_of(p.options.begin(), p.options.end(),
                           [&](const Parameter& option) { return option.name == s.name; });
    };
    for (const Setting& s : settings)
        if (std::none_of(profiles().begin(), profiles().end(),
                         [&](const ProfileDescription* p) { return has(*p, s); }))
            throw InputError(fmt::format("no profile has an option '{}'", s.name));
    for (const ProfileDescription* p : profiles()) {
        Settings own;
        for (const Setting& s : settings)
            if (has(*p, s)) own.push_back(s);
        try {
            chosen.push_back(make_profile(p->name, medium, own));
        } catch (const InputError& error) {
            if (!own.empty()) throw;
            say("nacre: left out: {}\n", error.what());
        }
    }
    return chosen;
}

Table table_of(const std::vector<Column>& columns, const std::vector<double>& radii,
               const std::string& title, bool cumulative) {
    std::string words = title;
    if (const std::size_t at = words.find("mm^-1"); at != words.npos) words.replace(at, 5, "mm⁻¹");
    Table t{.title = words,
            .columns = {"r_mm"},
            .rows = {},
            .kind = PlotKind::logarithmic,
            .y_label = cumulative ? "share of the light that leaves within the distance"
                                  : "diffuse reflectance R / mm⁻²",
            .x_label = "distance from entry / mm",
            .names = {""}};
    // In even steps of the logarithm the areas of rings are as r^2; what lies within needs none.
    if (!cumulative)
        for (const double r : radii) t.weights.push_back(r * r);
    t.rows.resize(radii.size());
    for (std::size_t i = 0; i < radii.size(); ++i) t.rows[i] = {radii[i]};
    const auto put = [&](const std::string& name, const std::vector<double>& values) {
        t.columns.push_back(name);
        std::string words = name == "monte_carlo" ? "slab Monte Carlo" : name;
        std::ranges::replace(words, '_', ' ');
        t.names.push_back(words);
        for (std::size_t i = 0; i < radii.size(); ++i) t.rows[i].push_back(values[i]);
    };
    for (const Column& c : columns) {
        put(c.name, cumulative ? c.within : c.value);
        if (!c.simulated) continue;
        put(c.name + "_error", cumulative ? c.within_error : c.value_error);
        t.errors[t.columns.size() - 1] = t.columns.size() - 2;
    }
    return t;
}

void print_text(const std::vector<Column>& columns, const std::vector<double>& radii,
                const std::string& title, bool cumulative) {
    // Of one profile there is room for both, and a few rows a decade are enough to read.
    constexpr std::size_t stride = 4;
    const bool both = columns.size() <= 2;
    const auto table = [&](bool within) {
        fmt::print("\n{}\n{:>10}", within ? "light that leaves within r" : "R(r), mm^-2", "r, mm");
        for (const Column& c : columns)
            fmt::print(" {:>21}{}", c.name, c.simulated ? fmt::format(" {:>9}", "+-") : "");
        fmt::print("\n");
        const auto row = [&](const std::string& head, const auto& value, const auto& error) {
            fmt::print("{:>10}", head);
            for (const Column& c : columns)
                fmt::print(" {:>21.6g}{}", value(c),
                           c.simulated ? fmt::format(" {:>9.2g}", error(c)) : "");
            fmt::print("\n");
        };
        for (std::size_t i = 0; i < radii.size(); i += stride)
            row(
                fmt::format("{:.4g}", radii[i]),
                [&](const Column& c) { return (within ? c.within : c.value)[i]; },
                [&](const Column& c) { return (within ? c.within_error : c.value_error)[i]; });
        row(
            "total", [](const Column& c) { return c.total; },
            [](const Column& c) { return c.total_error; });
    };
    fmt::print("{}\n", title);
    if (both || !cumulative) table(false);
    if (both || cumulative) table(true);
}

void print_json(const std::vector<Column>& columns, const std::vector<double>& radii,
                const std::vector<double>& rings, const ProfileMedium& m) {
    ordered_json r{{"medium",
                    {{"sigma_s_per_mm", m.sigma_s},
                     {"sigma_a_per_mm", m.sigma_a},
                     {"g", m.g},
                     {"eta", m.eta}}},
                   {"r_mm", radii}};
    if (!rings.empty()) r["ring_edges_mm"] = rings;
    for (const Column& c : columns) {
        ordered_json j{{"name", c.name}, {"R_per_mm2", c.value}, {"within", c.within}};
        if (c.simulated) {
            j["R_error_per_mm2"] = c.value_error;
            j["within_error"] = c.within_error;
            j["total_error"] = c.total_error;
        }
        j["total"] = c.total;
        r["profiles"].push_back(std::move(j));
    }
    fmt::print("{}\n", r.dump(2));
}

int run(const ProfileArguments& o) {
    check_table_output(o.output);
    if (o.json && !o.output.empty()) throw InputError("give either --json or -o");
    const ProfileMedium medium = profile_medium(o.medium);
    check(medium);
    const bool rings = o.photons > 0;
    const std::vector<double> edges = ring_edges(medium, o);
    std::vector<Column> columns;
    for (const auto& profile : chosen_profiles(medium, o))
        columns.push_back(evaluate(*profile, edges, rings));
    if (rings) columns.push_back(simulate(medium, edges, o));
    std::vector<double> radii;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
        radii.push_back(middle(edges[i], edges[i + 1]));
    const std::string title = medium_title(medium, o.medium);
    if (o.json)
        print_json(columns, radii, rings ? edges : std::vector<double>{}, medium);
    else if (o.output.empty())
        print_text(columns, radii, title, o.cumulative);
    else
        write_table(table_of(columns, radii, title, o.cumulative), o.output);
    return success;
}

}  // namespace

Action set_up_profile(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<ProfileArguments>();
    app.add_option("profile", o->profile, "a diffusion profile, or all; see 'nacre models'")
        ->required();
    add_medium_options(app, o->medium);
    app.add_option("--set", o->set, "options of the profile, name=value")
        ->allow_extra_args()
        ->expected(1, 64);
    add_number(app, "--rmax", o->rmax, {0, 1e9, true},
               "largest radius, mm (ten lengths of the exponential fall)");
    app.add_flag("--cumulative", o->cumulative, "what leaves within r instead of R(r)");
    add_whole(app, "--mc", o->photons, 64, std::uint64_t(most_whole),
              "photons of a slab Monte Carlo simulation beside it; all values are then means "
              "over rings around the radii");
    add_seed(app, o->seed, "of the simulation (0)");
    app.add_flag("--json", o->json, "for programs");
    app.add_flag("--quiet", o->quiet, "no progress, only warnings and errors");
    app.add_option("-o,--output", o->output, "table or picture: .csv, .svg, .png (default: print)");
    return [o] { return run(*o); };
}

}  // namespace nacre::cli
