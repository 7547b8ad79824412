#include "nacre/report/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "nacre/metrics/machine.h"
#include "nacre/report/advice.h"
#include "nacre/report/crops.h"
#include "nacre/report/report.h"
#include "nacre/techniques/missing_light.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

// A page of more pixels, all pictures together, would be larger than the 15 MB that mail takes:
// they are shrunk, at 3.1 bytes a pixel with the map of FLIP. The EXR files beside it have all.
constexpr double most_pixels = 4e6;

/// The longer side of the pictures on a page of so many of them.
int side_on_page(const Image& picture, std::size_t pictures) {
    const double pixels = double(picture.width) * picture.height * double(pictures);
    return std::max(1, int(std::max(picture.width, picture.height) *
                           std::min(1., std::sqrt(most_pixels / pixels))));
}

ordered_json technique_columns() {
    const auto hidden = [](ordered_json c) {  // only for the diagram
        c["hidden"] = true;
        return c;
    };
    return {
        number_column(
            "systematic", "systematic error", "%", 2, "low",
            "root mean square of the relative errors of blocks of 16 x 16 pixels, noise taken "
            "off: what stays wrong however long it runs"),
        number_column("bias", "brightness", "%", 2, "zero",
                      "mean over the object relative to the reference, minus 1"),
        number_column(
            "rms", "error of a frame", "%", 1, "low",
            "root of relMSE (epsilon 0.01) of one frame, pixel by pixel: what is wrong and noise"),
        number_column("noise", "noise of a frame", "%", 1, "low",
                      "the part of the frame's error that is noise, from how the repeats differ"),
        number_column(
            "flip", "HDR-FLIP", "", 3, "low",
            "how different one frame and the reference look when one flips between them, 0 to 1"),
        number_column("frame", "frame", "s", 2, "low",
                      "wall time of one frame, median of the repeats"),
        number_column("precompute", "before", "s", 2, "low",
                      "wall time of precomputation before the first frame, median of the repeats"),
        hidden(
            number_column("total", "first picture", "s", 2, "low", "precomputation and one frame")),
        hidden(
            number_column("cpu", "CPU", "s", 2, "low", "CPU time of precomputation and one frame")),
        number_column("reach", "time to the error chosen", "s", 2, "low",
                      "precomputation and as long a frame as the chosen error of a frame takes; a "
                      "dash: never, or noise leaves it open"),
        number_column("memory", "memory", "MB", 0, "low",
                      "the most that was held beyond the scene itself"),
        text_column("changes", "may change", "what may change before anything is computed anew")};
}

void add_numbers(ordered_json& row, const Measurement& m, const Verdict& v) {
    const double frame = m.median_of(&Timing::frame), before = m.median_of(&Timing::precompute);
    ordered_json& values = row["values"];
    values["systematic"] = 100 * v.systematic.value;
    values["bias"] = 100 * v.bias.value;
    values["rms"] = 100 * v.frame;
    values["noise"] = 100 * v.noise;
    values["flip"] = v.flip;
    values["frame"] = frame;
    values["precompute"] = before;
    values["total"] = frame + before;
    values["cpu"] = m.median_of(&Timing::frame_cpu) + m.median_of(&Timing::precompute_cpu);
    values["memory"] = m.memory_mb;
    row["errors"] = {{"systematic", 100 * v.systematic.sigma}, {"bias", 100 * v.bias.sigma}};
    const auto [least, most] = std::ranges::minmax(m.timings, {}, &Timing::frame);
    row["ranges"] = {{"frame", {least.frame, most.frame}}};
    // The frame's error if it had more or fewer samples: noise falls as one over the time.
    ordered_json curve = ordered_json::array();
    for (double t = frame / 16; t < 300 * frame; t *= std::sqrt(2.))
        curve.push_back(
            {before + t, 100 * std::hypot(v.pixel_systematic, v.noise * std::sqrt(frame / t))});
    row["curve"] = curve;
}

ordered_json about(const TechniqueDescription& t, const Measurement& m) {
    ordered_json list = ordered_json::array();
    const auto add = [&](const char* name, std::string_view text) {
        if (!text.empty()) list.push_back({name, std::string(text)});
    };
    add("Technique", t.how);
    add("Paper", fmt::format("{} {}: {}", t.authors, t.year, t.paper));
    add("Precomputes", t.precomputes.empty() ? "nothing" : t.precomputes);
    add("May change", t.keeps.text());
    if (m.samples) add("Samples a pixel", fmt::to_string(m.samples));
    if (!m.timings.empty()) {
        std::string times;
        for (const Timing& timing : m.timings)
            times += fmt::format("{}{:.3f} + {:.3f} s", times.empty() ? "" : ", ",
                                 timing.precompute, timing.frame);
        add("Times (before + frame)", times);
        add("CPU time", fmt::format("{:.3f} s", m.median_of(&Timing::precompute_cpu) +
                                                    m.median_of(&Timing::frame_cpu)));
    }
    for (const Statistic& s : m.statistics)
        list.push_back(
            {s.name, fmt::format("{:g}{}{}", s.value, s.unit.empty() ? "" : " ", s.unit)});
    if (m.invalid_samples) add("Invalid samples", fmt::to_string(m.invalid_samples));
    if (m.reused) add("Measured", "before, by the same program; the pictures were kept");
    return list;
}

ordered_json about_peer(const Measurement& m) {
    ordered_json list = ordered_json::array();
    const auto add = [&](const char* name, const std::string& text) {
        if (!text.empty()) list.push_back({name, text});
    };
    add("Version", m.program);
    add("What was run", m.command);
    add("Samples a pixel", fmt::to_string(m.samples));
    add("Before the frame", "start-up, loading and writing");
    for (const std::string& note : m.notes) add("Replaced", note);
    if (m.reused) add("Measured", "before; the pictures were kept");
    return list;
}

const char* status_of(const Measurement& m) {
    switch (m.status) {
        case Measurement::Status::done:
            return "ok";
        case Measurement::Status::failed:
            return "failed";
        case Measurement::Status::missing:
            break;
    }
    return "missing";
}

ordered_json describe_peer_row(const ExperimentRow& row) {
    const Measurement& m = row.measurement;
    ordered_json r{{"id", m.id},
                   {"name", std::string(row.peer->name)},
                   {"setting", fmt::format("{} spp", m.samples)},
                   {"title", std::string(row.peer->title)},
                   {"peer", true},
                   {"status", status_of(m)}};
    if (!m.why.empty()) r["why"] = m.why;
    if (row.verdict) {
        add_numbers(r, m, *row.verdict);
        r["values"].erase("cpu");  // not known
        r["picture"] = m.id;
        r["flip"] = m.id;
    }
    r["about"] = about_peer(m);
    return r;
}

ordered_json describe_row(const ExperimentRow& row, const ReportOrigin& origin, std::uint64_t seed,
                          bool several_samples) {
    const Measurement& m = row.measurement;
    if (row.peer) return describe_peer_row(row);
    const TechniqueDescription& technique = techniques().find(row.setting.choice.technique);
    std::string setting = row.setting.options();
    if (several_samples)
        setting += fmt::format("{}{} spp", setting.empty() ? "" : " ", row.setting.samples);
    ordered_json r{{"id", m.id},
                   {"name", std::string(technique.name)},
                   {"setting", setting},
                   {"title", std::string(technique.title)},
                   {"status", status_of(m)}};
    if (!m.why.empty()) r["why"] = m.why;
    if (row.verdict) {
        add_numbers(r, m, *row.verdict);
        r["picture"] = m.id;
        r["flip"] = m.id;
    }
    r["values"]["changes"] = technique.keeps.text();
    r["command"] =
        fmt::format("nacre render {} {} --seed {} -o picture.exr", origin.scene_arguments,
                    row.setting.arguments(), frame_seed(seed, 0));
    r["about"] = about(technique, m);
    return r;
}

/// What the page computes the time to any error from, in percent and seconds.
ordered_json describe(const ErrorLaw& law) {
    return {{"before", law.precompute},       {"frame", law.frame},
            {"least_frame", law.least_frame}, {"noise", 100 * law.noise},
            {"floor", 100 * law.floor},       {"sigma", 100 * law.sigma}};
}

ordered_json verdict(const Experiment& e, const std::string& reference) {
    return {{"sentences", advise(e, reference)},
            {"error", 100 * first_error},
            {"text",
             "Error of a frame, pixel by pixel. Times are extrapolated: noise falls as one over "
             "the square root of the time, and the systematic error stays. A technique counts as "
             "within an error only if its systematic error and two standard errors are. Techniques "
             "that differ by less than 10 % or the spread of the repeats are not told apart."}};
}

ordered_json facts(const Experiment& e, const Scene& scene, const ExperimentOptions& o,
                   const ReportOrigin& origin) {
    ordered_json list = ordered_json::array();
    const Image& picture = e.reference.picture;
    list.push_back(
        {"Scene", fmt::format("{}, {} x {} pixels, {}", origin.scene, picture.width, picture.height,
                              scene.mode == ColorMode::spectral ? "spectral" : "RGB bands")});
    list.push_back(
        {"Reference",
         fmt::format("{}, {} samples a pixel, noise {:.2g} % (RMS of blocks of {} x {} "
                     "pixels), {:.0f} CPU s",
                     techniques().find(o.reference.technique.technique).title, e.reference.samples,
                     100 * e.reference.error, o.block, o.block, e.reference.cpu_seconds)});
    list.push_back({"Counted", e.object_only
                                   ? fmt::format("the {} pixels that show translucent objects",
                                                 e.mask.count(picture.width, picture.height))
                                   : "the whole picture: nothing in it is translucent"});
    list.push_back({"Repeats", fmt::format("{} of each, seed {}", o.repeats, o.seed)});
    for (auto& fact : common_facts(origin.version, o.threads)) list.push_back(fact);
    return list;
}

ordered_json notes() {
    return {
        {{"title", "How to read the errors"},
         {"text",
          "Two things make a picture differ from the reference: what the technique gets wrong, "
          "which "
          "stays however long it runs, and noise, which more samples take away.\n\nThe systematic "
          "error and the brightness are of the first kind: each technique was rendered several "
          "times "
          "with different random numbers, and from how the repeats differ follows how much of the "
          "difference is noise; that is taken off, as is the noise of the reference. Behind the "
          "sign "
          "± stands one standard error; a systematic error below about two of them may be none.\n\n"
          "The error of a frame is what one sees for the time of one frame, pixel by pixel. The "
          "thin "
          "lines in the diagram tell how it falls with time if samples are added: noise as one "
          "over "
          "the square root of the time, down to the systematic error of pixels."}},
        {{"title", "How to read the times"},
         {"text",
          "Wall time on all threads. What is computed before the first frame (points, irradiance, "
          "tables) stands apart: it is paid again only when something changes that the technique "
          "does not allow to change. Memory is what the process held at most beyond the scene."}}};
}

}  // namespace

ordered_json common_facts(const std::string& version, int threads) {
    const Machine machine = this_machine();
    ordered_json list = ordered_json::array();
    list.push_back({"Machine", fmt::format("{}, {} of {} threads, {:.0f} GB, {}", machine.processor,
                                           threads > 0 ? threads : machine.threads, machine.threads,
                                           machine.memory_gb, machine.system)});
    list.push_back({"Program", "nacre " + version});
    list.push_back({"Date", utc_now()});
    return list;
}

ordered_json describe(const Experiment& e, const Scene& scene, const ExperimentOptions& o,
                      const ReportOrigin& origin) {
    ordered_json d{{"format", 1}, {"kind", "techniques"}, {"title", origin.title}};
    d["facts"] = facts(e, scene, o, origin);
    d["command"] = origin.command;
    d["warnings"] = ordered_json::array();
    for (const std::string& w : scene.warnings) d["warnings"].push_back(w);
    for (const std::string& w : missing_in_simulation(scene)) d["warnings"].push_back(w);
    if (!e.complete)
        d["warnings"].push_back(
            "The comparison was interrupted: rows without numbers were not run. The same command "
            "goes on where it stopped.");
    d["verdict"] = verdict(e, o.reference.technique.technique);
    d["notes"] = notes();
    for (const ExperimentRow& row : e.rows)
        if (row.peer && !row.measurement.notes.empty())
            d["notes"].push_back(
                {{"title", fmt::format("What was replaced for {}", row.peer->title)},
                 {"text", fmt::format("{}", fmt::join(row.measurement.notes, "\n\n"))}});
    d["columns"] = technique_columns();

    const bool several = std::ranges::any_of(e.rows, [&](const ExperimentRow& r) {
        return !r.peer && r.setting.samples != e.rows.front().setting.samples;
    });
    const auto done =
        std::ranges::count_if(e.rows, [](const ExperimentRow& r) { return r.verdict.has_value(); });
    const int side = side_on_page(e.reference.picture, std::size_t(done) + 1);
    std::vector<const Image*> pictures;
    d["rows"] = ordered_json::array();
    const auto same = identical_rows(e.rows);
    d["pictures"] = {{"reference", rgbe_picture(shrunk(e.reference.picture, side))}};
    d["maps"] = ordered_json::object();
    for (std::size_t i = 0; i < e.rows.size(); ++i) {
        const ExperimentRow& row = e.rows[i];
        ordered_json described = describe_row(row, origin, o.seed, several);
        if (const auto law = error_law(row, o.reference.technique.technique)) {
            described["law"] = describe(*law);
            const TimeToReach t = time_to_reach(*law, first_error);
            if (t.reach == Reach::certain) described["values"]["reach"] = t.seconds;
        }
        if (same[i]) described["same_as"] = e.rows[*same[i]].measurement.id;
        d["rows"].push_back(described);
        if (row.measurement.invalid_samples)
            d["warnings"].push_back(fmt::format("{}: {} invalid samples", row.measurement.id,
                                                row.measurement.invalid_samples));
        if (!row.verdict) continue;
        pictures.push_back(&row.measurement.mean);
        d["pictures"][row.measurement.id] = rgbe_picture(shrunk(row.measurement.frame, side));
        d["maps"][row.measurement.id] = byte_map(shrunk(row.verdict->flip_map, side));
    }
    d["reference"] = {
        {"title", std::string(techniques().find(o.reference.technique.technique).title)},
        {"picture", "reference"},
        {"about", ordered_json::array({ordered_json::array(
                      {"Samples a pixel", fmt::to_string(e.reference.samples)})})}};
    d["plot"] = {{"x", {"total", "frame", "cpu"}}, {"y", {"rms", "systematic", "flip"}}};
    const Image& reference = e.reference.picture;
    const double scale = std::min(1., double(side) / std::max(reference.width, reference.height));
    d["crops"] = ordered_json::array();
    for (const Crop& c : telling_crops(pictures, reference, e.mask, 4)) {
        const int window = std::max(1, int(c.side * scale));
        d["crops"].push_back({{"title", fmt::format("{}, {}", c.x, c.y)},
                              {"x", int(c.x * scale)},
                              {"y", int(c.y * scale)},
                              {"width", window},
                              {"height", window}});
    }
    d["exposure"] = {{"start", 0.}};
    d["charts"] = ordered_json::array();
    if (ordered_json chart = profile_chart(scene, e.rows); !chart.is_null())
        d["charts"].push_back(chart);
    return d;
}

}  // namespace nacre
