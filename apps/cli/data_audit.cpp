// nacre data audit: whether a measured file can be trusted.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/coverage_picture.h"
#include "apps/cli/data_verbs.h"
#include "apps/cli/measured_page.h"
#include "apps/cli/output_file.h"
#include "apps/cli/plain_json.h"
#include "apps/cli/plot.h"
#include "nacre/measured/audit.h"
#include "nacre/measured/audit_verdict.h"
#include "nacre/measured/cuts.h"
#include "nacre/measured/open_measured.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct DataAuditArguments {
    std::string file;
    fs::path output;
    bool json = false;
};

/// Six digits are more than any measurement has.
double rounded(double v) { return std::stod(fmt::format("{:.6g}", v)); }
ordered_json rounded(const Vec3d& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

/// `all` is for programs.
ordered_json pairs_as_json(const std::vector<AuditedPair>& pairs, const char* other, bool all) {
    ordered_json list = ordered_json::array();
    for (const AuditedPair& p : pairs) {
        const std::string where = place_in_words(p);
        if (all)
            list.push_back({{"where", where},
                            {"wi", rounded(p.wi)},
                            {"wo", rounded(p.wo)},
                            {"value", rounded(p.value)},
                            {other, rounded(p.other)}});
        else
            list.push_back(fmt::format("{:.3g}, {} {:.3g}, at {}", p.value, other, p.other, where));
    }
    return list;
}

ordered_json albedo_as_json(const AuditAlbedo& a) {
    return {{"theta_i", a.theta},
            {"from", a.front ? "front" : "back"},
            {"reflected", rounded(a.reflected)},
            {"transmitted", rounded(a.transmitted)},
            {"largest", rounded(a.largest)},
            {"known_reflected", rounded(a.known_reflected)},
            {"known_transmitted", rounded(a.known_transmitted)}};
}

/// `all` is for programs; people get every third incidence.
ordered_json findings(const Measured& data, const Audit& a, bool all) {
    const AuditReciprocity& r = a.reciprocity;
    ordered_json json;
    json["range"] = {{"unit", "sr^-1, means over the channels"},
                     {"smallest", rounded(a.range.smallest)},
                     {"median", rounded(a.range.median)},
                     {"mean", rounded(a.range.mean)},
                     {"percentile99", rounded(a.range.percentile99)},
                     {"largest", rounded(a.range.largest)},
                     {"most_negative", rounded(a.range.most_negative)}};
    if (data.info().reflection_front) json["known_within_80_degrees"] = rounded(a.known);
    json["reciprocity"] = {{"pairs", r.pairs},
                           {"mean", rounded(r.mean)},
                           {"median", rounded(r.median)},
                           {"percentile95", rounded(r.percentile95)},
                           {"largest", rounded(r.largest)},
                           {"apart", r.apart},
                           {"worst", pairs_as_json(r.worst, "exchanged", all)}};
    json["outliers"] = {{"looked_at", a.outliers.looked_at},
                        {"count", a.outliers.count},
                        {"worst", pairs_as_json(a.outliers.worst, "neighbours", all)}};
    ordered_json albedo = ordered_json::array();
    if (all)
        for (const AuditAlbedo& x : a.albedo) albedo.push_back(albedo_as_json(x));
    else
        for (const AuditAlbedo& x : a.albedo) {
            if (int(x.theta) % 15 != 0) continue;
            std::string line = fmt::format("{:2g} degrees{}: {:.3g}, {:.3g}, {:.3g} back", x.theta,
                                           x.front ? "" : " from behind", x.reflected.x,
                                           x.reflected.y, x.reflected.z);
            if (x.known_transmitted > 0.)
                line += fmt::format(", {:.3g}, {:.3g}, {:.3g} through", x.transmitted.x,
                                    x.transmitted.y, x.transmitted.z);
            line += fmt::format("; {:.0f} % of the exits known",
                                100. * std::max(x.known_reflected, x.known_transmitted));
            albedo.push_back(line);
        }
    json["albedo"] = albedo;
    json["trusted"] = a.trusted;
    json["doubtful"] = a.doubtful;
    return json;
}

Table albedo_plot(const Measured& data, const Audit& a, const std::string& title) {
    const MeasuredInfo& info = data.info();
    Table t{title, {"theta_i_deg"}, {}, PlotKind::curves, "albedo of the exits that are known"};
    t.x_label = "angle of incidence / degrees";
    t.names = {""};
    struct Curve {
        bool front, through;
        int band;
    };
    std::vector<Curve> curves;
    const bool grey = info.channels == 1;
    constexpr const char* bands[] = {"red", "green", "blue"};
    for (const auto& [there, front, through, name] :
         {std::tuple{info.reflection_front, true, false, "reflected"},
          std::tuple{info.transmission_front, true, true, "through"},
          std::tuple{info.reflection_back, false, false, "reflected behind"},
          std::tuple{info.transmission_back, false, true, "through from behind"}}) {
        for (int c = 0; there && c < (grey ? 1 : 3); ++c) {
            curves.push_back({front, through, c});
            t.names.push_back(grey ? name : fmt::format("{}, {}", name, bands[c]));
            t.columns.push_back(t.names.back());
            std::replace(t.columns.back().begin(), t.columns.back().end(), ',', ' ');
        }
    }
    for (int theta = 0; theta <= 85; theta += 5) {
        std::vector<double> row{double(theta)};
        for (const Curve& c : curves) {
            double v = std::nan("");
            for (const AuditAlbedo& x : a.albedo)
                if (x.front == c.front && x.theta == theta &&
                    (c.through ? x.known_transmitted : x.known_reflected) > 0.)
                    v = (c.through ? x.transmitted : x.reflected)[c.band];
            row.push_back(v);
        }
        t.rows.push_back(std::move(row));
    }
    return t;
}

/// Means over the channels in the plane of incidence, light from the left, at exits within 80 degrees
/// of the normal: of what is stored with the cosine, those beyond would dwarf all others.
Table lobes_plot(const Measured& data, const std::string& title) {
    const MeasuredInfo& info = data.info();
    Table t{title,
            {"theta_o_deg"},
            {},
            PlotKind::polar,
            "BSDF / sr⁻¹, as distance from the origin; light from the left"};
    t.names = {""};
    const bool front = info.reflection_front || info.transmission_front;
    constexpr int incidences[] = {0, 30, 60};
    for (const int theta : incidences) {
        t.columns.push_back(fmt::format("theta_i={}", theta));
        t.names.push_back(fmt::format("incidence {}°", theta));
    }
    constexpr double degree = std::numbers::pi / 180.;
    const double end = info.transmission_front || !front ? 179.75 : 89.75;
    std::vector<double> out(std::size_t(info.channels));
    for (double angle = -end; angle <= end; angle += 0.5) {
        std::vector<double> row{angle};
        for (const int theta : incidences) {
            Vec3d wi = in_plane(-theta * degree);
            if (!front) wi.z = -wi.z;
            double sum = std::nan("");
            const bool grazing = std::abs(std::abs(angle) - 90.) < 10.;
            if (!grazing && data.eval(wi, in_plane(angle * degree), out)) {
                sum = 0.;
                for (const double v : out) sum += std::max(v, 0.) / double(out.size());
            }
            row.push_back(sum);
        }
        t.rows.push_back(std::move(row));
    }
    return t;
}

int run_data_audit(const DataAuditArguments& o) {
    const std::unique_ptr<Measured> data = open_measured(o.file);
    if (!o.output.empty()) {
        refuse_input_as_output(o.output, {o.file});
        make_output_folder(o.output);
    }
    const Audit found = audit(*data);
    const std::string title = fs::path(o.file).filename().string();
    ordered_json json = describe_measured(o.file, *data);
    json.update(findings(*data, found, o.json));
    if (!o.output.empty()) {
        write_whole_file(o.output / "coverage.svg", coverage_picture(*data, title));
        write_table(albedo_plot(*data, found, title), o.output / "albedo.svg");
        write_table(lobes_plot(*data, title), o.output / "lobes.svg");
        ordered_json whole = describe_measured(o.file, *data);
        whole.update(findings(*data, found, true));
        write_whole_file(o.output / "audit.json",
                         whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
    }
    print_found(json, o.json);
    return success;
}

}  // namespace

Subverb set_up_data_audit(CLI::App& app) {
    auto o = std::make_shared<DataAuditArguments>();
    CLI::App* sub = app.add_subcommand(
        "audit", "say whether data can be trusted: reciprocity, albedo, gaps, outliers");
    sub->add_option("file", o->file, "a measured file of any format")->required();
    sub->add_option("-o,--output", o->output,
                    "folder for coverage.svg, albedo.svg, lobes.svg and audit.json");
    sub->add_flag("--json", o->json, "for programs");
    return {sub, [o] { return run_data_audit(*o); }};
}

}  // namespace nacre::cli
