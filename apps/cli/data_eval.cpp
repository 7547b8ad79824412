// nacre data eval: what a measured file says at pairs of directions.
#include <CLI/CLI.hpp>

#include "apps/cli/data_verbs.h"
#include "apps/cli/direction.h"
#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "apps/cli/streams.h"
#include "nacre/math/error.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/open_measured.h"
#include "nacre/measured/surface.h"
#include "nacre/text/lines.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

struct DataEvalArguments {
    std::string file, wi, wo, pairs, output;
    bool rendered = false;
};

struct DirectionsAsked {
    Vec3d wi, wo;
};

/// Six numbers a line; a first line that begins with a letter is a header.
std::vector<DirectionsAsked> read_pairs(const std::string& path) {
    const auto text = read_whole_file(path);
    if (!text) throw InputError(fmt::format("{}: cannot be read; check the name", path));
    std::vector<DirectionsAsked> pairs;
    LineSplitter lines(*text);
    for (std::string_view line; lines.next(line);) {
        std::string_view rest = without_comment(line);
        while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
        if (rest.empty() || (lines.line() == 1 && rest.starts_with("wi_x"))) continue;
        std::vector<double> v;
        for (const std::string_view word : comma_words(rest))
            v.push_back(number_in(word).value_or(std::nan("")));
        const bool good = v.size() == 6;
        const Vec3d wi = good ? Vec3d{v[0], v[1], v[2]} : Vec3d{},
                    wo = good ? Vec3d{v[3], v[4], v[5]} : Vec3d{};
        if (!(length(wi) > 0.) || !(length(wo) > 0.))
            throw InputError(
                fmt::format("{}, line {}: two directions are expected, "
                            "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z; got '{}'",
                            path, lines.line(), rest.substr(0, 60)));
        pairs.push_back({normalize(wi), normalize(wo)});
    }
    return pairs;
}

std::string header(const MeasuredInfo& info, bool rendered) {
    std::string text;
    if (info.wavelengths.size() >= 2)
        for (const double nm : info.wavelengths)
            text += fmt::format("{}{:g}", text.empty() ? "" : ",", nm);
    else
        text = info.channels == 3 ? "r,g,b" : "value";
    return text + (rendered ? ",pdf\n" : "\n");
}

int run_data_eval(const DataEvalArguments& o) {
    if (o.pairs.empty() ? o.wi.empty() || o.wo.empty() : !o.wi.empty() || !o.wo.empty())
        throw InputError("say where: --wi and --wo, or --pairs FILE");
    if (!o.output.empty()) {
        refuse_input_as_output(o.output, {o.file, o.pairs});
        check_output_file(o.output);
    }
    const std::vector<DirectionsAsked> pairs =
        o.pairs.empty() ? std::vector<DirectionsAsked>{{parse_direction(o.wi, "--wi"),
                                                        parse_direction(o.wo, "--wo")}}
                        : read_pairs(o.pairs);
    std::unique_ptr<Measured> data = open_measured(o.file);
    std::string text = header(data->info(), o.rendered);
    const std::size_t n = std::size_t(data->info().channels);
    const auto add = [&](auto value) {
        text += fmt::format("{}{:.9g}", text.back() == '\n' ? "" : ",", value);
    };
    if (o.rendered) {
        const MeasuredSurface surface(std::move(data));
        std::vector<float> values(n);
        for (const auto& [wi, wo] : pairs) {
            surface.eval(Vec3f(wi), Vec3f(wo), values);
            for (const float v : values) add(v);
            add(surface.pdf(Vec3f(wi), Vec3f(wo)));
            text += '\n';
        }
    } else {
        std::vector<double> values(n);
        for (const auto& [wi, wo] : pairs) {
            if (!data->eval(wi, wo, values)) std::fill(values.begin(), values.end(), std::nan(""));
            for (const double v : values) add(v);
            text += '\n';
        }
    }
    if (o.output.empty())
        fmt::print("{}", text);
    else
        write_whole_file(o.output, text);
    return success;
}

}  // namespace

Subverb set_up_data_eval(CLI::App& app) {
    auto o = std::make_shared<DataEvalArguments>();
    CLI::App* sub = app.add_subcommand("eval", "what the data say at pairs of directions, as CSV");
    sub->add_option("file", o->file, "a measured file of any format")->required();
    sub->add_option("--wi", o->wi, "to the light, x,y,z: 0,0,1 is the normal");
    sub->add_option("--wo", o->wo, "to the viewer, x,y,z");
    sub->add_option("--pairs", o->pairs,
                    "many: a CSV file of wi_x,wi_y,wi_z,wo_x,wo_y,wo_z a line");
    sub->add_flag(
        "--rendered", o->rendered,
        "as <bsdf type=\"measured\"> has it: times the cosine to the light, never below 0, held "
        "beyond the largest measured angles, and the density of its sampling; otherwise sr^-1, "
        "nan where nothing was measured");
    sub->add_option("-o,--output", o->output, "file; otherwise the terminal");
    return {sub, [o] { return run_data_eval(*o); }};
}

}  // namespace nacre::cli
