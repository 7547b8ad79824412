// nacre data convert: measured files and models in another format, and what that costs.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/data_verbs.h"
#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "nacre/math/error.h"
#include "nacre/measured/convert.h"
#include "nacre/measured/views.h"
#include "nacre/text/split_words.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct DataConvertArguments {
    std::string input, output, to, wavelengths;
    ConvertOptions options;
    double step = 0.;
    bool json = false;
};

/// By --to, or by the ending of the file.
const MeasuredFormat& output_format(const DataConvertArguments& o) {
    if (!o.to.empty()) {
        const MeasuredFormat& format = measured_formats().find(o.to);
        if (format.write) return format;
        throw InputError(fmt::format("--to {}: {} cannot be written; known are {}", o.to,
                                     format.title, fmt::join(writable_formats(), ", ")));
    }
    std::string endings;
    for (const MeasuredFormat* format : measured_formats()) {
        if (!format->write) continue;
        if (fs::path(o.output).extension() == format->ending) return *format;
        endings += (endings.empty() ? "" : ", ") + std::string(format->ending);
    }
    throw InputError(
        fmt::format("{}: the ending says no format that can be written ({}); say --to {}", o.output,
                    endings, fmt::join(writable_formats(), ", ")));
}

/// "400,500,600", "400..700/10" in steps of 10.
std::vector<double> parse_wavelengths(const std::string& text) {
    const auto wrong = [&] {
        return InputError(fmt::format(
            "--wavelengths '{}': write 400,500,600, or 400..700/10 for steps of 10 nm", text));
    };
    std::vector<double> nm;
    const std::size_t dots = text.find("..");
    if (dots == text.npos) {
        for (const std::string_view word : split_words(text, ",")) {
            const auto value = number_in(word);
            if (!value) throw wrong();
            nm.push_back(*value);
        }
        return nm;
    }
    const std::size_t slash = std::min(text.find('/', dots), text.size());
    const auto first = number_in(text.substr(0, dots)),
               last = number_in(text.substr(dots + 2, slash - dots - 2)),
               step = slash < text.size() ? number_in(text.substr(slash + 1)) : std::nullopt;
    if (!first || !last || !step || !(*step > 0.) || !(*last >= *first) ||
        (*last - *first) / *step >= max_measured_channels)
        throw wrong();
    for (int i = 0; *first + i * *step <= *last + 1e-9; ++i) nm.push_back(*first + i * *step);
    return nm;
}

struct ConversionInput {
    std::shared_ptr<const Measured> data;
    double mirrored = 0.;  ///< the largest share of light that a model mirrors without blur
};

ConversionInput open_input(const DataConvertArguments& o) {
    const std::shared_ptr<const Target> target = make_target(o.input);
    const auto* file = dynamic_cast<const MeasuredTarget*>(target.get());
    const bool model = dynamic_cast<const ModelTarget*>(target.get()) != nullptr;
    if (!o.wavelengths.empty() && !model)
        throw InputError(fmt::format("--wavelengths is for models; {} has {}", o.input,
                                     file && file->data().info().wavelengths.size() > 1
                                         ? "wavelengths of its own"
                                         : "no wavelengths"));
    if (file) return {std::shared_ptr<const Measured>(target, &file->data()), 0.};
    double mirrored = 0.;
    for (const double cosine : {1., 0.8, 0.6, 0.4, 0.2}) {
        const Vec3d m = target->mirror({std::sqrt(1. - cosine * cosine), 0., cosine});
        mirrored = std::max({mirrored, m.x, m.y, m.z});
    }
    if (o.wavelengths.empty()) return {view_of(target), mirrored};
    const ModelSpec spec = parse_model_spec(o.input);
    return {
        view_of(make_model(spec.name, spec.settings), o.input, parse_wavelengths(o.wavelengths)),
        mirrored};
}

ordered_json errors_as_json(const std::vector<ResamplingError>& errors) {
    ordered_json list = ordered_json::array();
    for (const ResamplingError& e : errors)
        list.push_back({{"where", e.where},
                        {"pairs", e.pairs},
                        {"mean", e.mean},
                        {"percentile95", e.percentile95},
                        {"unknown", e.unknown},
                        {"added", e.added}});
    return list;
}

void print_conversion(const DataConvertArguments& o, const MeasuredFormat& format,
                      const Converted& c) {
    fmt::print("{}: {}, {:.1f} MB\n", o.output, format.title, double(c.bytes.size()) * 1e-6);
    for (const std::string& lost : c.lost) fmt::print("lost: {}\n", lost);
    fmt::print("\n{:26} {:>7} {:>10} {:>16}\n", "error of resampling", "pairs", "mean",
               "95th percentile");
    for (const ResamplingError& e : c.errors) {
        fmt::print("{:26} {:>7} {:>8.2g} % {:>14.2g} %\n", e.where, e.pairs, 100. * e.mean,
                   100. * e.percentile95);
        if (e.unknown) fmt::print("  {} more pairs are known to the source alone\n", e.unknown);
        if (e.added) fmt::print("  {} more pairs are known to the file alone\n", e.added);
    }
}

/// Options that the format has no use for would be left out silently.
void check_options(const CLI::App& app, const MeasuredFormat& format) {
    const bool rgl = format.name == "rgl", text = format.name == "csv" || format.name == "alta";
    for (const char* option : {"--resolution", "--incidences", "--azimuths"})
        if (!rgl && app.count(option))
            throw InputError(
                fmt::format("{} is for RGL; {} has no use for it", option, format.title));
    if (!text && app.count("--step"))
        throw InputError(
            fmt::format("--step is for text formats; {} has no use for it", format.title));
}

int run_data_convert(const CLI::App& app, const DataConvertArguments& o) {
    if (o.output.empty()) throw InputError("say where to: -o FILE");
    const MeasuredFormat& format = output_format(o);
    check_options(app, format);
    refuse_input_as_output(o.output, {o.input});
    check_output_file(o.output);
    const ConversionInput input = open_input(o);
    ConvertOptions options = o.options;
    if (o.step > 0.) {
        options.write.step = o.step;
        options.write.samples = false;
    }
    Converted c = convert(input.data, format, options);
    if (input.mirrored > 1e-4)
        c.lost.push_back(fmt::format(
            "what the model mirrors without blur, up to {:.2g} of the light", input.mirrored));
    write_whole_file(o.output, c.bytes);
    if (o.json)
        fmt::print("{}\n", ordered_json{{"input", o.input},
                                        {"output", o.output},
                                        {"format", format.name},
                                        {"bytes", c.bytes.size()},
                                        {"channels", c.data->info().channels},
                                        {"wavelengths", c.data->info().wavelengths},
                                        {"isotropic", c.data->info().isotropic},
                                        {"lost", c.lost},
                                        {"errors", errors_as_json(c.errors)}}
                               .dump(2));
    else
        print_conversion(o, format, c);
    return success;
}

}  // namespace

Subverb set_up_data_convert(CLI::App& app) {
    auto o = std::make_shared<DataConvertArguments>();
    CLI::App* sub = app.add_subcommand("convert", "write data or a model in another format");
    sub->add_option("input", o->input,
                    "a measured file of any format, a folder of factors, or a model with settings, "
                    "'ggx alpha=0.2'")
        ->required();
    sub->add_option("-o,--output", o->output, "the file: .bsdf (RGL), .binary (MERL), .alta, .csv");
    sub->add_option("--to", o->to, "format, if the ending does not say it: rgl, merl, alta, csv");
    WriteOptions& w = o->options.write;
    add_whole(*sub, "--resolution", w.resolution, 4, 1024,
              "RGL: nodes along a side of the warped square (32)");
    add_whole(*sub, "--incidences", w.incidences, 8, 512, "RGL: angles of incidence (24)");
    add_whole(*sub, "--azimuths", w.azimuths, 4, 512,
              "RGL: azimuths of incidence around the circle, of anisotropic surfaces (24)");
    add_number(*sub, "--step", o->step, {1, 15},
               "text formats: degrees between directions, in place of the data's own samples (5 if "
               "they have none, or more than 100,000)");
    sub->add_option("--wavelengths", o->wavelengths,
                    "of a model, nm: 400,500,600, or 400..700/10; otherwise red, green and blue");
    sub->add_flag("--rgb", o->options.colour, "red, green and blue in place of wavelengths");
    sub->add_flag("--isotropic", o->options.turned_around,
                  "the mean over turns about the normal of what is anisotropic");
    sub->add_flag("--json", o->json, "for programs");
    return {sub, [o, sub] { return run_data_convert(*sub, *o); }};
}

}  // namespace nacre::cli
