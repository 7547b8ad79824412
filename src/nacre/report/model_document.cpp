#include "nacre/report/model_document.h"

#include <nlohmann/json.hpp>

#include "nacre/report/report.h"

namespace nacre {
namespace {

using Json = nlohmann::ordered_json;

/// Six digits are enough for people, and keep the page small.
double brief(double x) { return std::isfinite(x) ? std::stod(fmt::format("{:.6g}", x)) : x; }

Json model_columns() {
    return {
        number_column(
            "error", "error", "%", 2, "low",
            "root mean square of the differences of f cos(theta_i), over that of the target: 100 "
            "is the error of black (Ngan et al. 2005)"),
        number_column(
            "log_error", "log error", "%", 2, "low",
            "the same of log(1 + f cos(theta_i)), in which a sharp highlight does not decide "
            "alone (Low et al. 2012, E2)"),
        number_column(
            "albedo_difference", "albedo difference", "%", 2, "low",
            "root mean square of the differences of the directional albedo, up to 80 degrees, "
            "in percent of a white surface"),
        number_column(
            "largest_albedo", "largest albedo", "", 3, "none",
            "of the fitted model, over the angles of the diagram and the three bands; above 1 "
            "energy appears from nowhere"),
        text_column("parameters", "fitted parameters", "colours are red,green,blue"),
        number_column("fit", "fit", "s", 2, "low", "time of the fit, all starts"),
        number_column(
            "nanoseconds", "evaluation", "ns", 2, "low",
            "time of one value at one wavelength, in packs of single precision on one thread"),
        text_column("reciprocal", "reciprocal", "with these options, as the model's page says"),
        text_column("conserves", "conserves energy",
                    "for all parameters that these options allow, as the model's page says"),
    };
}

Json row(const ComparedModel& m) {
    const ModelDescription& d = *m.description;
    Json about =
        Json::array({Json::array({"Paper", fmt::format("{} {}, {}", d.authors, d.year, d.paper)})});
    const std::size_t blank = m.id.find(' ');
    Json r{{"id", m.id},
           {"name", d.name},
           {"setting", blank == m.id.npos ? "" : m.id.substr(blank + 1)},
           {"title", d.title}};
    switch (m.status) {
        case ComparedModel::Status::missing:
            r["status"] = "missing";
            break;
        case ComparedModel::Status::failed:
            r["status"] = "failed";
            r["why"] = m.why;
            break;
        case ComparedModel::Status::ok: {
            const ModelFit& fit = *m.fit;
            r["status"] = "ok";
            r["values"] = {{"error", brief(100. * fit.errors.cosine_relative)},
                           {"log_error", brief(100. * fit.errors.log_relative)},
                           {"albedo_difference", brief(100. * m.albedo_difference)},
                           {"largest_albedo", brief(m.largest_albedo)},
                           {"parameters", fit.text},
                           {"fit", brief(fit.seconds)},
                           {"nanoseconds", brief(1e3 * m.seconds_per_million)},
                           {"reciprocal", m.reciprocal ? "yes" : "no"},
                           {"conserves", m.energy == Energy::conserves ? "yes" : "no"}};
            r["picture"] = m.id;
            r["command"] = fmt::format("nacre eval {} --set {} --lobe", d.name, fit.text);
            const auto add = [&](const char* what, const std::string& text) {
                if (!text.empty()) about.push_back(Json::array({what, text}));
            };
            add("Error",
                fmt::format("{:.4g} sr^-1, log {:.4g}", fit.errors.cosine, fit.errors.log));
            add("At the end of the range", fmt::format("{}", fmt::join(fit.at_limit, ", ")));
            add("Beyond a bound", fit.beyond);
            add("Fit", fmt::format("{} iterations{}", fit.iterations,
                                   fit.converged ? "" : ", which did not come to an end"));
            break;
        }
    }
    r["about"] = about;
    return r;
}

Json axis(const char* title, const char* unit) {
    return {{"title", title}, {"unit", unit}, {"log", false}};
}

/// One line a model, that of the target first.
template <class Points>
Json series(const ModelComparison& c, Points&& points) {
    Json all = Json::array();
    all.push_back({{"name", c.target}, {"reference", true}, {"points", points(c.reference)}});
    for (const ComparedModel& m : c.models)
        if (m.status == ComparedModel::Status::ok)
            all.push_back({{"name", m.id}, {"reference", false}, {"points", points(m.portrait)}});
    return all;
}

Json albedo_chart(const ModelComparison& c) {
    return {{"id", "albedo"},
            {"title", "Directional albedo"},
            {"text",
             "Share of the light from that angle that is scattered or mirrored, mean of the three "
             "bands."},
            {"kind", "lines"},
            {"x", axis("angle of incidence", "degrees")},
            {"y", axis("albedo", "")},
            {"series", series(c, [](const BrdfPortrait& p) {
                 Json points = Json::array();
                 for (int i = 0; i < BrdfPortrait::albedo_count; ++i)
                     points.push_back(
                         Json::array({BrdfPortrait::albedo_angle(i), brief(p.mean_albedo(i))}));
                 return points;
             })}};
}

Json lobe_chart(const ModelComparison& c, std::size_t k) {
    const double angle = BrdfPortrait::incidences[k];
    return {{"id", fmt::format("lobes_{:g}", angle)},
            {"title", fmt::format("Lobes, light at {:g} degrees", angle)},
            {"text",
             "Values in the plane of incidence, mean of the three bands, mirror direction on the "
             "right; the radius is the cube root of f in sr^-1, so that highlight and matt part "
             "are both seen."},
            {"kind", "polar"},
            {"x", axis("angle of the viewer", "degrees")},
            {"y", axis("cube root of f", "sr^-1/3")},
            {"series", series(c, [&](const BrdfPortrait& p) {
                 Json points = Json::array();
                 for (int i = 0; i < BrdfPortrait::lobe_count; ++i) {
                     const Vec3d& f = p.lobes[k][i];
                     points.push_back(Json::array(
                         {BrdfPortrait::lobe_angle(i), brief(std::cbrt((f.x + f.y + f.z) / 3.))}));
                 }
                 return points;
             })}};
}

Json slice_chart(const ModelComparison& c) {
    Json pictures = Json::array({"slice reference"}), captions = Json::array({c.target});
    for (const ComparedModel& m : c.models)
        if (m.status == ComparedModel::Status::ok) {
            pictures.push_back("slice " + m.id);
            captions.push_back(m.id);
        }
    return {{"id", "slices"},
            {"title", "Burley's slice"},
            {"text",
             "pi f over the angle of the half vector to the normal (to the right, 0 to 90 degrees) "
             "and that of the light to the half vector (upwards), at phi_d = 90 degrees: highlight "
             "on the left, grazing reflection at the top, backward reflection at the bottom."},
            {"kind", "image"},
            {"pictures", pictures},
            {"captions", captions}};
}

Json notes(const ModelComparison& c) {
    Json notes = Json::array();
    notes.push_back(
        {{"title", "How the models are fitted"},
         {"text",
          fmt::format(
              "Each model's colours and shape are those with the least {} (nonlinear least squares "
              "with exact derivatives, from several starts, within the range of each parameter); "
              "options, and what the row's settings give, stay. Sums such as kd + ks may exceed 1 "
              "where that comes closer; the row then says so.\n\nThe directions are a grid over "
              "half-angle coordinates, dense about the highlight, weighted by the solid angles "
              "that they stand for; angles of more than 80 degrees to the normal are left out, "
              "where measurements are unreliable and models diverge.",
              c.metric == FitMetric::log ? "log error" : "error")}});
    notes.push_back({{"title", "What the pictures show"},
                     {"text",
                      "A sphere in a light from the upper left, 45 degrees off the view, and a dim "
                      "one from everywhere; values of the BRDF, nothing is traced. A white matt "
                      "surface that faces the light is 1.1."}});
    return notes;
}

}  // namespace

std::vector<std::string> advise(const ModelComparison& c) {
    const auto error = [&](const ComparedModel& m) {
        return c.metric == FitMetric::log ? m.fit->errors.log_relative
                                          : m.fit->errors.cosine_relative;
    };
    const char* what = c.metric == FitMetric::log ? "log error" : "error";
    std::vector<const ComparedModel*> fitted;
    std::size_t failed = 0, missing = 0;
    for (const ComparedModel& m : c.models) {
        failed += m.status == ComparedModel::Status::failed;
        missing += m.status == ComparedModel::Status::missing;
        if (m.status == ComparedModel::Status::ok) fitted.push_back(&m);
    }
    std::vector<std::string> sentences;
    if (fitted.empty()) {
        sentences.push_back("No model was fitted, so none is recommended.");
    } else {
        std::ranges::stable_sort(fitted, {}, [&](const ComparedModel* m) { return error(*m); });
        const ComparedModel& best = *fitted.front();
        std::string s = fmt::format("Nearest to {} is {}: {} {:.3g} %", c.target, best.id, what,
                                    100 * error(best));
        std::vector<std::string> ties;
        for (const ComparedModel* m : fitted)
            if (m != &best && (error(*m) <= 1.01 * error(best) || error(*m) < 1e-6))
                ties.push_back(m->id);
        if (!ties.empty()) s += fmt::format("; as near, within 1 %: {}", fmt::join(ties, ", "));
        if (fitted.size() > 1 + ties.size()) {
            const ComparedModel& next = *fitted[1 + ties.size()];
            s += fmt::format("; next is {} ({:.3g} %)", next.id, 100 * error(next));
        }
        sentences.push_back(s + ".");
        if (best.energy != Energy::conserves)
            sentences.push_back(
                fmt::format("{} does not conserve energy for all parameters.", best.id));
    }
    if (failed) sentences.push_back(fmt::format("{} could not be fitted.", failed));
    if (missing)
        sentences.push_back(
            fmt::format("{} of {} were not fitted: the finished comparison may say otherwise.",
                        missing, c.models.size()));
    return sentences;
}

nlohmann::ordered_json describe(const ModelComparison& c) {
    Json rows = Json::array(), warnings = Json::array();
    // Spheres and slices of the same bits: the options of the two do not tell them apart here.
    const auto same = [&](const ComparedModel& a, const ComparedModel& b) {
        for (const char* kind : {"", "slice "}) {
            const auto p = c.pictures.find(kind + a.id), q = c.pictures.find(kind + b.id);
            if (p == c.pictures.end() || q == c.pictures.end() || p->second.data != q->second.data)
                return false;
        }
        return true;
    };
    for (const ComparedModel& m : c.models) {
        rows.push_back(row(m));
        for (const ComparedModel& earlier : c.models) {
            if (&earlier == &m) break;
            if (same(earlier, m)) {
                rows.back()["same_as"] = earlier.id;
                break;
            }
        }
    }
    if (!c.complete) warnings.push_back("The comparison was stopped; some models are missing.");
    Json charts = Json::array({albedo_chart(c)});
    for (std::size_t k = 0; k < BrdfPortrait::incidences.size(); ++k)
        charts.push_back(lobe_chart(c, k));
    charts.push_back(slice_chart(c));
    Json facts = Json::array();
    facts.push_back(Json::array({"Target", c.target}));
    facts.push_back(Json::array(
        {"Fitted by", c.metric == FitMetric::log ? "log error" : "error of f cos(theta_i)"}));
    facts.push_back(Json::array(
        {"Pairs of directions",
         c.missing_directions == 0
             ? fmt::format("{}", c.directions)
             : fmt::format("{}, {} more without a value", c.directions, c.missing_directions)}));
    return {{"format", 1},
            {"kind", "models"},
            {"title", fmt::format("{} as {} models", c.target, c.models.size())},
            {"facts", facts},
            {"command", ""},
            {"warnings", warnings},
            {"verdict", {{"sentences", advise(c)}}},
            {"notes", notes(c)},
            {"columns", model_columns()},
            {"rows", rows},
            {"reference", {{"title", c.target}, {"picture", "reference"}}},
            {"plot",
             {{"x", {"nanoseconds", "fit"}}, {"y", {"log_error", "error", "albedo_difference"}}}},
            {"exposure", {{"start", 0.}}},
            {"charts", charts}};
}

}  // namespace nacre
