// nacre slab: reflectance and transmittance of a stack of layers, by every method side by side.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/number_option.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/slab_input.h"
#include "apps/cli/slab_mcml.h"
#include "apps/cli/slab_profiles.h"
#include "apps/cli/verb.h"
#include "nacre/math/error.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

struct SlabArguments {
    std::string file, skin, output;
    std::vector<std::string> layers, methods;
    std::optional<double> eta_above, eta_below, angle, nm, step, rmax;
    std::uint64_t photons = 1'000'000, seed = 0;
    int bins = 0;
    bool diffuse = false, spectrum = false, radial = false, angular = false, lobe = false;
    bool json = false, quiet = false;
};

/// A method's answer, or why it has none.
struct Row {
    const SlabMethod* method;
    SlabAnswer answer;
    std::string refusal;
};

/// The numbers of a row that tables show, by their names.
std::vector<std::pair<const char*, double>> numbers_of(const SlabAnswer& a) {
    std::vector<std::pair<const char*, double>> r{{"reflectance", a.totals.reflectance},
                                                  {"transmittance", a.totals.transmittance},
                                                  {"absorptance", a.totals.absorptance},
                                                  {"specular", a.totals.specular},
                                                  {"unscattered", a.totals.unscattered}};
    const double none = std::nan("");
    r.emplace_back("reflectance_error", a.error ? a.error->reflectance : none);
    r.emplace_back("transmittance_error", a.error ? a.error->transmittance : none);
    r.emplace_back("absorptance_error", a.error ? a.error->absorptance : none);
    return r;
}

std::vector<Row> solve(const SlabTask& task, const std::vector<const SlabMethod*>& methods) {
    std::vector<Row> rows;
    for (const SlabMethod* m : methods) {
        try {
            rows.push_back({m, m->solve(task), ""});
        } catch (const InputError& error) {
            // One method may pass; when it is the only one that is asked for, that is an error.
            if (methods.size() == 1) throw;
            rows.push_back({m, {}, error.what()});
        }
    }
    return rows;
}

std::string csv_of(const std::vector<Row>& rows) {
    std::string text = "method";
    for (const auto& [name, value] : numbers_of({})) text += fmt::format(",{}", name);
    text += "\n";
    for (const Row& r : rows) {
        if (!r.refusal.empty()) continue;
        text += r.method->name;
        // What a method does not tell is an empty cell.
        for (const auto& [name, value] : numbers_of(r.answer))
            text += std::isnan(value) ? "," : fmt::format(",{:.12g}", value);
        text += "\n";
    }
    return text;
}

void print_totals(const std::vector<Row>& rows, bool json) {
    if (json) {
        ordered_json all;
        for (const Row& r : rows) {
            ordered_json& j = all[std::string(r.method->name)];
            if (!r.refusal.empty()) {
                j["refused"] = r.refusal;
                continue;
            }
            for (const auto& [name, value] : numbers_of(r.answer))
                if (!std::isnan(value)) j[name] = value;
        }
        fmt::print("{}\n", all.dump(2));
        return;
    }
    fmt::print("{:<20}{:>20}{:>20}{:>20}{:>11}{:>13}\n", "method", "R", "T", "A", "specular",
               "unscattered");
    for (const Row& r : rows) {
        if (!r.refusal.empty()) {
            fmt::print("{:<20} {}\n", r.method->title, r.refusal);
            continue;
        }
        const LayerTotals& t = r.answer.totals;
        const auto cell = [&](double value, double LayerTotals::*which) {
            return r.answer.error ? fmt::format("{:.6f} +- {:.1g}", value, (*r.answer.error).*which)
                                  : fmt::format("{:.6f}", value);
        };
        fmt::print("{:<20}{:>20}{:>20}{:>20}{:>11.6f}{:>13}\n", r.method->title,
                   cell(t.reflectance, &LayerTotals::reflectance),
                   cell(t.transmittance, &LayerTotals::transmittance),
                   cell(t.absorptance, &LayerTotals::absorptance), t.specular,
                   std::isnan(t.unscattered) ? "-" : fmt::format("{:.6f}", t.unscattered));
    }
}

void write_or_print(const Table& table, const SlabArguments& o) {
    if (!o.json) return write_table(table, o.output);
    ordered_json r;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        for (const auto& row : table.rows) r[table.columns[c]].push_back(row[c]);
    fmt::print("{}\n", r.dump(2));
}

/// Light and, unless it is skin's, the stack.
SlabTask task_of(const SlabArguments& o) {
    SlabTask task;
    if (o.diffuse && o.angle) throw InputError("give either --angle or --diffuse");
    const double angle = o.angle.value_or(0.);
    task.diffuse = o.diffuse;
    task.cosine = std::cos(angle * std::numbers::pi / 180.);
    task.photons = o.photons;
    task.seed = o.seed;
    for (const std::string& text : o.layers)
        task.stack.layers.push_back(parse_layer(text, task.stack.layers.size() + 1));
    return task;
}

void refuse_contradictions(const SlabArguments& o, const CLI::App& app) {
    const bool skin = app.count("--skin") > 0;
    if (int(!o.file.empty()) + int(skin) + int(!o.layers.empty()) != 1)
        throw InputError(
            "an empty stack: give --layer for each layer, or --skin, or an .mci file; see 'nacre "
            "help slab'");
    if (o.spectrum + o.radial + o.angular + o.lobe > 1)
        throw InputError("give one of --spectrum, --radial, --angular and --lobe");
    const auto belongs = [&](const char* option, bool given, const char* other) {
        if (app.count(option) && !given)
            throw InputError(fmt::format("{} belongs to {}", option, other));
    };
    belongs("--spectrum", skin, "--skin: given layers have no wavelength");
    belongs("--lambda", skin && !o.spectrum, "--skin, and --spectrum goes over all");
    belongs("--step", o.spectrum, "--spectrum");
    belongs("--rmax", o.radial, "--radial");
    belongs("--bins", o.radial || o.angular, "--radial and --angular");
    if ((o.radial || o.angular || o.lobe) && o.diffuse)
        throw InputError("--radial, --angular and --lobe need a beam: leave out --diffuse");
    belongs("--method", !o.lobe, "totals: --lobe is light scattered once, by hk");
    if (o.json && !o.output.empty()) throw InputError("give either --json or -o");
    if (o.file.empty()) return;
    for (const char* option : {"--angle", "--diffuse", "--eta-above", "--eta-below", "--radial",
                               "--angular", "--lobe", "--method", "--json"})
        if (app.count(option))
            throw InputError(
                fmt::format("{}: the file says all of a run; {} is for layers", o.file, option));
}

int run(const SlabArguments& o, const CLI::App& app) {
    refuse_contradictions(o, app);
    if (!o.file.empty())
        return run_mcml({o.file, o.output,
                         app.count("--photons") ? std::optional(o.photons) : std::nullopt, o.seed,
                         o.quiet});
    const std::vector<const SlabMethod*> methods = find_slab_methods(o.methods);
    const bool table = o.spectrum || o.radial || o.angular || o.lobe;
    check_table_output(o.output);
    if (!table && !o.output.empty() && std::filesystem::path(o.output).extension() != ".csv")
        throw InputError("a picture needs one of --spectrum, --radial, --angular and --lobe");
    SlabTask task = task_of(o);
    const PhotonProgress progress(o.quiet, "--photons");
    task.work = &progress.work();
    if (app.count("--skin")) {
        const SkinParameters skin = parse_skin(o.skin);
        if (o.spectrum) {
            task.stack.eta_above = o.eta_above.value_or(0.);
            task.stack.eta_below = o.eta_below.value_or(0.);
            write_or_print(spectrum_table(skin, task, methods, 400., 700., o.step.value_or(10.)),
                           o);
            return success;
        }
        task.stack = skin_stack(skin, o.nm.value_or(550.));
    }
    if (o.eta_above) task.stack.eta_above = *o.eta_above;
    if (o.eta_below) task.stack.eta_below = *o.eta_below;
    check(task.stack);
    const int bins = o.bins ? o.bins : o.radial ? 50 : 30;
    if (o.radial)
        write_or_print(radial_table(task, o.rmax.value_or(0.), bins), o);
    else if (o.lobe)
        write_or_print(lobe_table(task.stack, o.angle ? std::vector<double>{*o.angle}
                                                      : std::vector<double>{10., 40., 65.}),
                       o);
    else if (o.angular)
        write_or_print(angular_table(task, methods, bins), o);
    else if (const std::vector<Row> rows = solve(task, methods); o.output.empty())
        print_totals(rows, o.json);
    else
        write_whole_file(o.output, csv_of(rows));
    return success;
}

}  // namespace

Action set_up_slab(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<SlabArguments>();
    app.add_option("file", o->file, "input of MCML (.mci): its runs are simulated");
    app.add_option("--layer", o->layers,
                   "from the top: \"sigma_s=10 sigma_a=0.1 g=0.8 thickness=1 eta=1.4\", mm; or "
                   "albedo and tau; thickness=inf in the last")
        ->allow_extra_args(false);
    app.add_option("--skin", o->skin,
                   "layers of skin: \"melanin=0.03 blood=0.012 oxygenation=0.75\", also "
                   "haemoglobin, optics, eumelanin")
        ->expected(0, 1);
    add_number(app, "--lambda", o->nm, any_number, "wavelength of skin, nm (550)");
    add_number(app, "--eta-above", o->eta_above, any_number,
               "index of refraction above the layers (1)");
    add_number(app, "--eta-below", o->eta_below, any_number,
               "and below (1; that of fat under skin)");
    add_number(app, "--angle", o->angle, {0, 90, false, true}, "of incidence, degrees (0)");
    app.add_flag("--diffuse", o->diffuse, "diffuse light instead of a beam");
    app.add_option("--method", o->methods,
                   "km (Kubelka-Munk), hk (Hanrahan-Krueger, single scattering), ad "
                   "(adding-doubling), mc (Monte Carlo), with commas between, or all")
        ->delimiter(',');
    add_whole(app, "--photons", o->photons, 64, std::uint64_t(most_whole),
              "of Monte Carlo (1000000; in an .mci file: its own)");
    add_seed(app, o->seed, "of Monte Carlo (0)");
    app.add_flag("--spectrum", o->spectrum, "reflectance of skin from 400 to 700 nm");
    add_number(app, "--step", o->step, {1, 300}, "of the spectrum, nm (10)");
    app.add_flag("--radial", o->radial, "power that leaves over the radius, by Monte Carlo");
    add_number(app, "--rmax", o->rmax, {0, 1e9, true}, "of it, mm (ten transport mean free paths)");
    app.add_flag("--angular", o->angular, "power that leaves over the angle of exit");
    app.add_flag("--lobe", o->lobe,
                 "light scattered once in the plane of incidence (10, 40 and 65 degrees, or "
                 "--angle)");
    add_whole(app, "--bins", o->bins, 1, 10000, "of radius (50) or angle (30)");
    app.add_flag("--json", o->json, "for programs");
    app.add_flag("--quiet", o->quiet, "no progress, only warnings and errors");
    app.add_option("-o,--output", o->output,
                   "table or picture: .csv, .svg, .png; of an .mci file its .mco or .csv, or the "
                   "folder for several (default: print; beside the .mci)");
    return [o, &app] { return run(*o, app); };
}

}  // namespace nacre::cli
