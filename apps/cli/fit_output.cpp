#include "apps/cli/fit_output.h"

#include <nlohmann/json.hpp>
#include <numbers>

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

bool in_all_bands(const ModelTerm& term) { return term.weight == Vec3d{1., 1., 1.}; }

std::string band_of(const ModelTerm& term) {
    return term.weight.x > 0. ? "red" : term.weight.y > 0. ? "green" : "blue";
}

const Parameter& parameter_of(const ModelTerm& term, const std::string& name) {
    const ModelDescription& model = term.model.description();
    return model
        .parameters[std::size_t(find_parameters(model.name, model.parameters, name).front())];
}

std::string value_text(const SettingValue& value) {
    const std::string text = settings_text({{"x", value}});
    return text.substr(2);
}

std::string term_xml(const ModelTerm& term, const std::string& indent) {
    std::string xml = fmt::format("{}<bsdf type=\"{}\">\n", indent, term.model.description().name);
    for (const Setting& s : term.settings) {
        const ParameterKind kind = parameter_of(term, s.name).kind;
        const char* tag = std::holds_alternative<Vec3f>(s.value) ? "rgb"
                          : kind == ParameterKind::choice        ? "string"
                          : kind == ParameterKind::integer       ? "integer"
                                                                 : "float";
        xml += fmt::format("{}    <{} name=\"{}\" value=\"{}\"/>\n", indent, tag, s.name,
                           value_text(s.value));
    }
    return xml + indent + "</bsdf>\n";
}

/// Two dashes would end a comment.
std::string in_comment(std::string text) {
    for (std::size_t i; (i = text.find("--")) != text.npos;) text.replace(i, 2, "- -");
    return text;
}

}  // namespace

std::vector<std::string> term_lines(const FittedModel& m) {
    const std::vector<ModelTerm>& terms = m.fit->sum.terms();
    std::vector<std::string> lines;
    std::size_t lobe = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
        std::string what;
        lobe = i > 0 && terms[i].weight == terms[i - 1].weight ? lobe + 1 : 1;
        if (!in_all_bands(terms[i])) what = band_of(terms[i]) + ": ";
        const bool several =
            (i + 1 < terms.size() && terms[i + 1].weight == terms[i].weight) || lobe > 1;
        if (several) what += fmt::format("lobe {}: ", lobe);
        lines.push_back(what + settings_text(terms[i].settings));
    }
    return lines;
}

std::string scene_snippet(const FittedModel& m, const std::string& target) {
    const std::vector<ModelTerm>& terms = m.fit->sum.terms();
    std::string xml = fmt::format("<!-- {} fitted to {}", in_comment(m.id), in_comment(target));
    if (!m.fit->beyond.empty())
        xml += fmt::format("; {}. Scenes refuse it where a model exceeds its own bound",
                           in_comment(m.fit->beyond));
    xml += " -->\n";
    if (terms.size() == 1) return xml + term_xml(terms.front(), "");
    xml += "<bsdf type=\"sumbsdf\">\n";
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (!in_all_bands(terms[i]))
            xml += fmt::format("    <rgb name=\"weight{}\" value=\"{:g} {:g} {:g}\"/>\n", i + 1,
                               terms[i].weight.x, terms[i].weight.y, terms[i].weight.z);
    }
    for (const ModelTerm& t : terms) xml += term_xml(t, "    ");
    return xml + "</bsdf>\n";
}

ordered_json to_json(const FittedModel& m) {
    ordered_json r{{"model", m.spec.name}, {"given", settings_text(m.spec.settings)}};
    if (!m.fit) {
        r["why"] = m.why;
        return r;
    }
    const SumFit& fit = *m.fit;
    for (const ModelTerm& t : fit.sum.terms()) {
        ordered_json parameters = ordered_json::object();
        for (const Setting& s : t.settings) {
            if (const auto* rgb = std::get_if<Vec3f>(&s.value))
                // Six digits, as they were rounded to, not those of single precision.
                parameters[s.name] = ordered_json::parse("[" + value_text(*rgb) + "]");
            else if (const auto* number = std::get_if<double>(&s.value))
                parameters[s.name] = *number;
            else
                parameters[s.name] = value_text(s.value);
        }
        r["terms"].push_back({{"settings", settings_text(t.settings)},
                              {"parameters", parameters},
                              {"weight", {t.weight.x, t.weight.y, t.weight.z}}});
    }
    const auto errors = [](const FitErrors& e) {
        return ordered_json{{"cosine", e.cosine_relative},     {"log", e.log_relative},
                            {"cuberoot", e.cuberoot_relative}, {"cosine_absolute", e.cosine},
                            {"log_absolute", e.log},           {"cuberoot_absolute", e.cuberoot}};
    };
    r["errors"]["fit"] = errors(fit.errors);
    if (m.held_out) r["errors"]["held_out"] = errors(*m.held_out);
    r["numbers"] = fit.numbers;
    r["iterations"] = fit.iterations;
    r["converged"] = fit.converged;
    r["at_limit"] = fit.at_limit;
    r["beyond"] = fit.beyond;
    r["seconds"] = fit.seconds;
    return r;
}

Table lobe_plot(const Target& target, const std::vector<const FittedModel*>& models,
                double degrees) {
    Table t{fmt::format("{}, light from {:g} degrees", target.name(), degrees),
            {"theta_o_deg", "target"},
            {},
            PlotKind::semilog,
            "BRDF / sr⁻¹, mean of red, green and blue"};
    t.x_label = "angle of the viewer in the plane of incidence / degrees; light at negative ones";
    t.names = {"", target.name()};
    t.points = {1};
    for (const FittedModel* m : models) {
        t.columns.push_back(m->spec.name);
        t.names.push_back(m->id);
    }
    const auto direction = [](double angle) {
        const double a = angle * std::numbers::pi / 180.;
        return Vec3d{std::sin(a), 0., std::cos(a)};
    };
    const auto mean = [](const std::optional<Vec3d>& f) {
        return f ? (f->x + f->y + f->z) / 3. : std::nan("");
    };
    const Vec3d wi = direction(-degrees);
    for (double out = -89.; out <= 89.; out += 0.5) {
        std::vector<double> row{out, mean(target.value(wi, direction(out)))};
        for (const FittedModel* m : models)
            row.push_back(mean(m->fit->sum.value(wi, direction(out))));
        t.rows.push_back(std::move(row));
    }
    return t;
}

}  // namespace nacre::cli
