// nacre measure: the virtual gonioreflectometer over microgeometry.
#include <CLI/CLI.hpp>

#include "apps/cli/interrupt.h"
#include "apps/cli/measure_input.h"
#include "apps/cli/number_option.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/verb.h"
#include "nacre/goniometer/instrument.h"
#include "nacre/goniometer/measurement_set.h"
#include "nacre/math/error.h"
#include "nacre/render/threads.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

struct MeasureArguments {
    MeasureInput input;
    MeasureOptions measure;
    std::vector<std::string> theta, phi;
    std::string bins, output, instrument;
    int threads = 0;
    bool full = false, resume = false, quiet = false;
};

std::vector<double> angles(const std::string& option, const std::vector<std::string>& texts,
                           NumberRange range, std::vector<double> otherwise) {
    if (texts.empty()) return otherwise;
    std::vector<double> r;
    for (const std::string& text : texts) {
        const auto x = number_in(text);
        if (!x || !(*x >= range.low && *x <= range.high) || (range.high_open && *x == range.high))
            throw InputError(fmt::format("{}: '{}' is not a number from {} to {}{}", option, text,
                                         range.low, range.high,
                                         range.high_open ? " (and less)" : ""));
        r.push_back(*x);
    }
    return r;
}

HemisphereBins bins_of(const std::string& text) {
    if (text.empty()) return {};
    const std::size_t by = std::min(text.find('x'), text.size());
    const std::int64_t polar = whole_in(text.substr(0, by)).value_or(0),
                       around = by < text.size() ? whole_in(text.substr(by + 1)).value_or(0) : 0;
    if (polar < 1 || around < 1 || polar > 1000 || around > 1000)
        throw InputError(fmt::format(
            "--bins: '{}' is not of the form POLARxAROUND, 18x36, each from 1 to 1000", text));
    return {int(polar), int(around)};
}

std::vector<DirectionCell> incidences_of(const MeasureArguments& o, const HemisphereBins& bins) {
    std::vector<DirectionCell> cells;
    if (o.full) {
        if (!o.theta.empty() || !o.phi.empty())
            throw InputError("--full takes light from all bins: leave out --theta and --phi");
        for (std::size_t i = 0; i < bins.size(); ++i) {
            DirectionCell cell = bins.cell(i);
            // A turned patch is the same from all around.
            if (o.measure.turned && cell.phi_low > 0.) continue;
            if (o.measure.turned) cell.phi_high = 0.;
            cells.push_back(cell);
        }
        return cells;
    }
    constexpr double degree = std::numbers::pi / 180.;
    for (double theta : angles("--theta", o.theta, {0., 90., false, true}, {0., 30., 60.}))
        for (double phi : angles("--phi", o.phi, {-360., 360.}, {0.}))
            cells.push_back(DirectionCell::at(theta * degree, phi * degree));
    return cells;
}

/// What determines the numbers, by name.
std::map<std::string, std::string> facts_of(const MeasureArguments& o, const MeasuredPatch& patch) {
    std::map<std::string, std::string> facts = patch.facts;
    facts["bins"] = fmt::format("{}x{}", o.measure.bins.polar, o.measure.bins.around);
    facts["orders"] = o.measure.orders > 0 ? std::to_string(o.measure.orders) : "all";
    facts["turned"] = o.measure.turned ? "yes" : "no";
    facts["seed"] = std::to_string(o.measure.seed);
    facts["light"] = o.full ? "all bins" : "directions";
    return facts;
}

std::string share(const IncidenceMeasurement& m,
                  MeasuredValue (IncidenceMeasurement::*of)(int) const, std::size_t lanes) {
    std::string text;
    double error = 0.;
    for (int k = 0; k < int(lanes); ++k) {
        text += fmt::format("{:.4f} ", (m.*of)(k).value);
        error = std::max(error, (m.*of)(k).error);
    }
    return fmt::format("{}+- {:.1g}", text, error);
}

void print(const MeasurementSet& set, const Wavelengths& wavelengths) {
    const std::size_t lanes = set.lanes.size();
    const int width = int(7 * lanes + 10);
    fmt::print("shares of the light: {}\n", fmt::join(set.lanes, ", "));
    fmt::print("{:>7} {:>7} {:>11} {:>8}  {:<{}}{:<{}}{}\n", "theta", "phi", "rays", "noise",
               "reflected", width, "transmitted", width, "blocked");
    for (const IncidenceMeasurement& m : set.incidences) {
        if (m.rays == 0) continue;
        constexpr double degree = std::numbers::pi / 180.;
        fmt::print("{:>7.2f} {:>7.2f} {:>11} {:>7.2f}%  {:<{}}{:<{}}{}\n",
                   m.incidence.theta() / degree, m.incidence.phi() / degree, m.rays,
                   100. * m.noise(wavelengths), share(m, &IncidenceMeasurement::reflected, lanes),
                   width, share(m, &IncidenceMeasurement::transmitted, lanes), width,
                   share(m, &IncidenceMeasurement::blocked, lanes));
        if (m.lost(0).value > 1e-4)
            fmt::print("        {:.2g} of the light was given up: these numbers are too low\n",
                       m.lost(0).value);
    }
}

/// Of a table the errors are a second one: a.csv, a.error.csv.
fs::path error_file(const fs::path& table) {
    return fs::path(table).replace_extension(".error.csv");
}

void save(const MeasurementSet& set, const fs::path& file) {
    if (file.extension() != ".csv") return write_whole_file(file, json_of(set));
    write_whole_file(file, csv_of(set));
    write_whole_file(error_file(file), csv_of(set, true));
}

/// a.csv or a.json and foo: a.foo.csv.
fs::path instrument_file(const fs::path& output, const Instrument& instrument) {
    return fs::path(output).replace_extension("." + instrument.name + ".csv");
}

void print(const Instrument& instrument, const MeasurementSet& set,
           const std::vector<InstrumentReading>& readings) {
    fmt::print("\nas the instrument {} reads it, in shares of the light that leaves the surface:\n",
               instrument.name);
    fmt::print("{:>7} {:>7} {:>13} {:>18} {:>16}\n", "theta", "phi", "out of reach",
               "changed by blur", "changed by noise");
    constexpr double degree = std::numbers::pi / 180.;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const DirectionCell& c = set.incidences[i].incidence;
        fmt::print("{:>7.2f} {:>7.2f} ", c.theta() / degree, c.phi() / degree);
        if (readings[i].reached)
            fmt::print("{:>12.2f}% {:>17.2f}% {:>15.2f}%\n", 100. * readings[i].outside,
                       100. * readings[i].blur, 100. * readings[i].noise);
        else
            fmt::print("no light from there: all of it\n");
    }
    const HemisphereBins bins = set.incidences.front().bins;
    const double step = std::max(90. / bins.polar, 360. / bins.around);
    if (instrument.source + instrument.detector < 0.5 * step)
        fmt::print(
            "bins of {:.3g} degrees are wider than its cones: blur within them is not seen\n",
            step);
}

int run(MeasureArguments& o) {
    std::optional<Instrument> instrument;
    if (!o.instrument.empty()) instrument = make_instrument(o.instrument);
    o.measure.bins = bins_of(o.bins);
    const fs::path output = o.output;
    if (!o.output.empty()) {
        if (output.extension() != ".csv" && output.extension() != ".json")
            throw InputError(fmt::format("-o '{}': a measurement is a .csv or a .json", o.output));
        check_output_file(output);
        if (output.extension() == ".csv") check_output_file(error_file(output));
        if (instrument) check_output_file(instrument_file(output, *instrument));
    }
    if (o.resume && output.extension() != ".json")
        throw InputError("--resume needs -o FILE.json, the measurement that goes on");
    const std::vector<DirectionCell> incidences = incidences_of(o, o.measure.bins);
    const double gigabytes = double(incidences.size()) * double(o.measure.bins.size()) * 2. *
                             sizeof(IncidenceMeasurement::Sums) / 1e9;
    if (gigabytes > 8.)
        throw InputError(fmt::format(
            "{} incidences of {}x{} bins take {:.0f} GB: fewer bins, --turned, or parts of them",
            incidences.size(), o.measure.bins.polar, o.measure.bins.around, gigabytes));
    const MeasuredPatch patch = load_patch(o.input);
    o.measure.wavelengths = patch.wavelengths;
    MeasurementSet set{facts_of(o, patch), patch.lanes, {}, false};
    for (const DirectionCell& c : incidences) set.incidences.emplace_back(c, o.measure.bins);
    if (instrument) check_azimuths(*instrument, set);
    if (o.resume && fs::exists(output)) {
        MeasurementSet before = read_measurement(output);
        check_facts(before.facts, set.facts, o.output);
        for (IncidenceMeasurement& m : set.incidences)
            for (IncidenceMeasurement& b : before.incidences)
                if (b.rays > 0 && m.incidence == b.incidence) m = b;
    }
    const std::atomic<bool>& stop = interrupt_flag();
    const auto go = [&] {
        MeasureProgress now;
        StatusLine line(
            o.quiet,
            [&](bool) {
                return fmt::format("light {} of {}: {} rays, noise {:.2f} %", now.incidence + 1,
                                   now.incidences, now.rays, 100. * now.noise);
            },
            1.);
        const Work work(&stop, Work::Clock::time_point::max(), {});
        for (std::size_t i = 0; i < set.incidences.size() && !stop; ++i) {
            line.update([&] { now = {i, set.incidences.size(), set.incidences[i].rays, 0.}; });
            measure(patch.patch, o.measure, set.incidences[i], work, [&](const MeasureProgress& p) {
                line.update([&] { now = {i, set.incidences.size(), p.rays, p.noise}; });
            });
        }
    };
    with_threads(o.threads, go);
    set.complete = !stop;
    if (!output.empty()) save(set, output);
    if (!o.quiet || output.empty()) print(set, patch.wavelengths);
    if (instrument) {
        const std::vector<InstrumentReading> readings = read_instrument(*instrument, set);
        if (!output.empty())
            write_whole_file(instrument_file(output, *instrument),
                             csv_of(set, o.instrument, readings));
        if (!o.quiet || output.empty()) print(*instrument, set, readings);
    }
    return stop ? interrupted : success;
}

}  // namespace

Action set_up_measure(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<MeasureArguments>();
    add_measure_input(app, o->input);
    app.add_option("--theta", o->theta, "angles of incidence, degrees, with commas (0,30,60)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--phi", o->phi, "azimuths of incidence, degrees, with commas (0)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_flag("--full", o->full, "light from every bin in turn: the whole BRDF");
    app.add_option("--bins", o->bins, "of exit, polar angle by azimuth (18x36)");
    add_whole(app, "--orders", o->measure.orders, 1, 1000,
              "reflections that count: 1 is single scattering (all)");
    app.add_flag("--turned", o->measure.turned,
                 "turn the patch at random for each ray: an isotropic surface");
    add_share(app, "--noise", o->measure.noise,
              "stop when a bin's standard error, in the mean over the light, is at most this (2%)");
    add_whole(app, "--rays", o->measure.most_rays, 4096, std::uint64_t(1) << 50,
              "most of an incidence (268435456)");
    add_seed(app, o->measure.seed, "of the random numbers (0)");
    add_threads(app, o->threads);
    app.add_option("--instrument", o->instrument,
                   "also what a real one reports: cornell, foo or ward, with parameters \"foo "
                   "detector=2\"; with -o as FILE.foo.csv");
    app.add_flag("--resume", o->resume, "go on with the measurement of -o");
    app.add_flag("--quiet", o->quiet, "no progress, only warnings and errors");
    app.add_option("-o,--output", o->output, "FILE.csv, with FILE.error.csv, or FILE.json");
    return [o] { return run(*o); };
}

}  // namespace nacre::cli
