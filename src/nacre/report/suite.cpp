#include "nacre/report/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "nacre/report/advice.h"
#include "nacre/report/printed_numbers.h"
#include "nacre/report/report.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

constexpr int thumbnail_side = 96;

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

double root_mean_square(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v * v;
    return values.empty() ? 0 : std::sqrt(sum / double(values.size()));
}

/// The cells of one technique over all cases.
std::vector<const SuiteCell*> of_technique(const std::vector<SuiteResult>& results,
                                           const std::string& id) {
    std::vector<const SuiteCell*> cells;
    for (const SuiteResult& r : results)
        for (const SuiteCell& c : r.cells)
            if (c.id == id) cells.push_back(&c);
    return cells;
}

std::vector<double> values(const std::vector<const SuiteCell*>& cells, double SuiteCell::*what) {
    std::vector<double> list;
    for (const SuiteCell* c : cells)
        if (c->why.empty()) list.push_back(c->*what);
    return list;
}

ordered_json matrix(const std::vector<SuiteResult>& results) {
    ordered_json m{{"title", "Every case, every technique"},
                   {"label_titles", {"object", "albedo", "matter", "light"}}};
    const auto measure = [](const char* key, const char* title, const char* unit, int digits) {
        return ordered_json{{"key", key}, {"title", title}, {"unit", unit}, {"digits", digits}};
    };
    m["measures"] = {measure("systematic", "systematic error", "%", 1),
                     measure("bias", "brightness", "%", 1), measure("flip", "HDR-FLIP", "", 3),
                     measure("frame", "frame time", "s", 2),
                     measure("precompute", "precomputation", "s", 2)};
    m["cases"] = ordered_json::array();
    for (const SuiteResult& r : results) {
        ordered_json cells = ordered_json::object();
        for (const SuiteCell& c : r.cells) {
            if (!c.why.empty()) {
                cells[c.id] = {{"why", c.why}};
                continue;
            }
            cells[c.id] = {{"systematic", 100 * c.systematic},
                           {"bias", 100 * c.bias},
                           {"flip", c.flip},
                           {"frame", c.frame},
                           {"precompute", c.precompute},
                           {"errors", {{"systematic", 100 * c.sigma}}}};
        }
        m["cases"].push_back({{"id", r.which.id()},
                              {"labels", r.which.labels()},
                              {"picture", r.which.id()},
                              {"cells", cells}});
    }
    m["techniques"] = ordered_json::array();
    if (!results.empty())
        for (const SuiteCell& c : results.front().cells)
            m["techniques"].push_back({{"id", c.id}, {"title", c.title}});
    return m;
}

/// The systematic errors, those that may be noise as 0.
std::vector<double> certain_errors(const std::vector<const SuiteCell*>& cells) {
    std::vector<double> list;
    for (const SuiteCell* c : cells)
        if (c->why.empty()) list.push_back(c->systematic < 2 * c->sigma ? 0 : c->systematic);
    return list;
}

/// One row a technique, over all cases that it could do.
ordered_json summary_rows(const std::vector<SuiteResult>& results) {
    ordered_json rows = ordered_json::array();
    if (results.empty()) return rows;
    for (const SuiteCell& first : results.front().cells) {
        const auto cells = of_technique(results, first.id);
        const auto errors = certain_errors(cells);
        const std::string name = first.id.substr(0, first.id.find(' '));
        ordered_json row{
            {"id", first.id},
            {"name", name},
            {"setting", name.size() < first.id.size() ? first.id.substr(name.size() + 1) : ""},
            {"title", first.title}};
        if (!first.same_as.empty() && std::ranges::all_of(cells, [&](const SuiteCell* c) {
                return !c->why.empty() || c->same_as == first.same_as;
            }))
            row["same_as"] = first.same_as;
        row["status"] = errors.empty() ? "failed" : "ok";
        if (errors.empty()) row["why"] = first.why;
        row["values"]["cases"] = errors.size();
        if (!errors.empty()) {
            row["values"]["systematic"] = 100 * median(errors);
            row["values"]["rms"] = 100 * root_mean_square(errors);
            row["values"]["worst"] = 100 * *std::ranges::max_element(errors);
            row["values"]["flip"] = median(values(cells, &SuiteCell::flip));
            row["values"]["frame"] = median(values(cells, &SuiteCell::frame));
            row["values"]["precompute"] = median(values(cells, &SuiteCell::precompute));
            row["values"]["memory"] = median(values(cells, &SuiteCell::memory_mb));
        }
        row["values"]["changes"] = first.may_change;
        rows.push_back(row);
    }
    return rows;
}

ordered_json summary_columns() {
    return {number_column("cases", "cases", "", 0, "none", "that have numbers"),
            number_column("systematic", "systematic error", "%", 1, "low", "median over the cases"),
            number_column("rms", "RMS of it", "%", 1, "low",
                          "root mean square over the cases: the bad ones decide"),
            number_column("worst", "worst case", "%", 1, "low",
                          "the largest systematic error of a case"),
            number_column("flip", "HDR-FLIP", "", 3, "low", "median over the cases"),
            number_column("frame", "frame", "s", 2, "low", "median over the cases"),
            number_column("precompute", "before", "s", 2, "low",
                          "precomputation, median over the cases"),
            number_column("memory", "memory", "MB", 0, "low", "median over the cases"),
            text_column("changes", "may change", "before anything is computed anew")};
}

ordered_json printed() {
    ordered_json rows = ordered_json::array();
    for (const PrintedNumber& n : printed_numbers())
        rows.push_back({std::string(n.technique), std::string(n.object),
                        std::string(n.precomputation), std::string(n.speed),
                        std::string(n.hardware), std::string(n.may_change)});
    return {
        {"title", "What the papers printed"},
        {"text",
         "The authors' own numbers, on their objects and machines. They tell what was thought "
         "fast in which year; they cannot be compared with what was measured above."},
        {"columns", {"Technique", "Object", "Precomputation", "Speed", "Hardware", "May change"}},
        {"rows", rows}};
}

}  // namespace

SuiteResult summarise(const SuiteCase& which, const Experiment& e) {
    SuiteResult r;
    r.which = which;
    r.picture = shrunk(e.reference.picture, thumbnail_side);
    r.reference_error = e.reference.error;
    r.reference_cpu_seconds = e.reference.cpu_seconds;
    const auto same = identical_rows(e.rows);
    const auto id_of = [](const TechniqueSetting& s) {
        // All have the same number of samples, which stands above.
        const std::string options = s.options();
        return s.choice.technique + (options.empty() ? "" : " " + options);
    };
    for (std::size_t i = 0; i < e.rows.size(); ++i) {
        const ExperimentRow& row = e.rows[i];
        if (row.peer) continue;
        const TechniqueDescription& technique = techniques().find(row.setting.choice.technique);
        SuiteCell cell{.id = id_of(row.setting),
                       .title = std::string(technique.title),
                       .why = row.measurement.why,
                       .may_change = technique.keeps.text()};
        if (row.verdict) {
            cell.systematic = row.verdict->systematic.value;
            cell.sigma = row.verdict->systematic.sigma;
            cell.bias = row.verdict->bias.value;
            cell.flip = row.verdict->flip;
            cell.frame = row.measurement.median_of(&Timing::frame);
            cell.precompute = row.measurement.median_of(&Timing::precompute);
            cell.memory_mb = row.measurement.memory_mb;
        } else if (cell.why.empty()) {
            cell.why = "not run";
        }
        if (same[i]) cell.same_as = id_of(e.rows[*same[i]].setting);
        r.cells.push_back(std::move(cell));
    }
    return r;
}

std::vector<std::string> advise(const std::vector<SuiteResult>& results,
                                const std::string& reference) {
    struct Summary {
        std::string name;
        double error, seconds;
    };
    std::vector<Summary> all;
    std::size_t partial = 0;
    if (!results.empty())
        for (const SuiteCell& first : results.front().cells) {
            const std::string name = first.id.substr(0, first.id.find(' '));
            if (name == reference || !first.same_as.empty()) continue;
            const auto cells = of_technique(results, first.id);
            const auto errors = certain_errors(cells);
            if (errors.size() < results.size()) {  // only over the easier cases, perhaps
                ++partial;
                continue;
            }
            all.push_back(
                {name_with_setting(
                     name, name.size() < first.id.size() ? first.id.substr(name.size() + 1) : ""),
                 median(errors),
                 median(values(cells, &SuiteCell::frame)) +
                     median(values(cells, &SuiteCell::precompute))});
        }
    const std::string over =
        fmt::format("Over {} {}", results.size(), results.size() == 1 ? "case" : "cases");
    std::vector<std::string> sentences;
    const auto words = [](const Summary& s) {
        return fmt::format(
            "{}: {}, first picture after {}", s.name,
            s.error > 0 ? fmt::format("{:.2g} %", 100 * s.error) : "no error told from noise",
            time_in_words(s.seconds));
    };
    if (all.empty()) {
        sentences.push_back(over + " no technique beside the reference has numbers in every case.");
    } else {
        std::ranges::sort(all, {}, [](const Summary& s) { return std::pair(s.error, s.seconds); });
        sentences.push_back(
            fmt::format("{} the least median systematic error has {}.", over, words(all.front())));
        for (const double error : {0.1, 0.05}) {
            const Summary* fastest = nullptr;
            for (const Summary& s : all)
                if (s.error < error && (!fastest || s.seconds < fastest->seconds)) fastest = &s;
            if (fastest && fastest != &all.front())
                sentences.push_back(
                    fmt::format("Below {:g} % the fastest is {}.", 100 * error, words(*fastest)));
            else if (!fastest)
                sentences.push_back(fmt::format("Below {:g} % stays none.", 100 * error));
        }
    }
    if (partial)
        sentences.push_back(fmt::format("{} without numbers in some cases {} not counted.", partial,
                                        partial == 1 ? "is" : "are"));
    return sentences;
}

ordered_json describe_suite(const std::vector<SuiteResult>& results, int cases, int width,
                            int height, const ExperimentOptions& o, const ReportOrigin& origin) {
    ordered_json d{{"format", 1}, {"kind", "suite"}, {"title", origin.title}};
    double cpu = 0, worst = 0;
    for (const SuiteResult& r : results) {
        cpu += r.reference_cpu_seconds;
        worst = std::max(worst, r.reference_error);
    }
    d["facts"] = ordered_json::array();
    const auto fact = [&](const char* name, const std::string& text) {
        d["facts"].push_back(ordered_json::array({name, text}));
    };
    fact("Cases", fmt::format("{} of {}, {} x {} pixels, {} samples a pixel", results.size(), cases,
                              width, height, o.settings.empty() ? 0 : o.settings.front().samples));
    fact("References", fmt::format("complete simulation, noise at most {:.2g} % (RMS of blocks of "
                                   "{} x {} pixels), {:.0f} CPU s in all",
                                   100 * worst, o.block, o.block, cpu));
    fact("Repeats", fmt::format("{} of each, seed {}", o.repeats, o.seed));
    for (auto& common : common_facts(origin.version, o.threads)) d["facts"].push_back(common);
    d["command"] = origin.command;
    d["warnings"] = ordered_json::array();
    if (int(results.size()) < cases)
        d["warnings"].push_back(
            "The suite was interrupted: cases without numbers were not run. The same command goes "
            "on where it stopped.");
    d["verdict"] = {{"sentences", advise(results, o.reference.technique.technique)},
                    {"text",
                     "Medians over the cases, complete simulation left out; errors that may be "
                     "noise count as 0."}};
    d["notes"] = {
        {{"title", "The cases"},
         {"text",
          "Five objects in a sphere of 60 mm: a ball of 50 mm (thick), a waved sheet of 2 mm "
          "(thin), a bowl (concave), the built-in bust (curved) and a slab of 9 mm (flat). High "
          "albedo is the measured marble; low albedo has reduced albedos of 0.91, 0.80 and 0.67. "
          "One lamp in front, at the side or behind, in dim surroundings.\n\nVeined matter is a "
          "quarter as dense, changes its density by 1:10 and has no refracting boundary. Only "
          "complete simulation takes it as it is; the other techniques "
          "are given matter of its mean density, and the error is that of doing so."}},
        {{"title", "How to read the errors"},
         {"text",
          "Systematic error: root mean square of the relative errors of blocks of pixels on the "
          "object, the noise of the picture and of the reference taken off. A value below two of "
          "its standard errors may be noise: it is grey, and 0 in summaries."}}};
    d["columns"] = summary_columns();
    d["rows"] = summary_rows(results);
    d["plot"] = {{"x", {"frame", "precompute"}}, {"y", {"systematic", "rms", "worst", "flip"}}};
    d["matrix"] = matrix(results);
    d["printed"] = printed();
    d["pictures"] = ordered_json::object();
    for (const SuiteResult& r : results) d["pictures"][r.which.id()] = rgbe_picture(r.picture);
    return d;
}

}  // namespace nacre
