// nacre factor: a BRDF as a sum of products of textures, and how many of them are enough.
#include <CLI/CLI.hpp>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "apps/cli/plot.h"
#include "apps/cli/verb.h"
#include "nacre/math/error.h"
#include "nacre/measured/factor/factorise.h"
#include "nacre/measured/factor/spheres.h"
#include "nacre/measured/factor/textures.h"
#include "nacre/text/names.h"
#include "nacre/text/split_words.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct FactorArguments {
    std::vector<std::string> targets;
    std::string terms = "1..8", parameters = "io", spheres;
    int side = 32;
    bool logarithmic = false, nonnegative = false, normalised = false, weighted = false;
    bool json = false;
    fs::path output;
};

/// "8", "1..8", "1,2,4,8", "1..4,8".
std::vector<int> parse_terms(const std::string& option, const std::string& text) {
    const auto wrong = [&]() {
        return InputError(fmt::format(
            "{} '{}' is no list of numbers of terms; write 8, 1..8 or 1,2,4,8", option, text));
    };
    const auto number = [&](std::string_view word) {
        const auto n = whole_in(word);
        if (!n || *n < 1 || *n > FactorGrid::most_side * FactorGrid::most_side) throw wrong();
        return int(*n);
    };
    std::set<int> r;
    for (const std::string_view word : split_words(text, ",")) {
        const std::size_t dots = word.find("..");
        const int first = number(word.substr(0, dots));
        const int last = dots == word.npos ? first : number(word.substr(dots + 2));
        if (last < first) throw wrong();
        for (int j = first; j <= last; ++j) r.insert(j);
    }
    if (r.empty()) throw wrong();
    return {r.begin(), r.end()};
}

FactorParameters parse_parameters(const std::string& text) {
    const std::string word = plain_name(text);
    if (word == "io" || word == "inout") return FactorParameters::in_out;
    if (word == "half" || word == "halfdifference") return FactorParameters::half_difference;
    throw InputError("--param: " + unknown_name("parameterisation", text, {"io", "half"}));
}

FactorOptions factor_options(const FactorArguments& o) {
    if (o.nonnegative && o.normalised)
        throw InputError("give either --nonnegative or --normalised");
    FactorOptions r;
    r.grid = {parse_parameters(o.parameters), o.side};
    r.method = o.nonnegative  ? FactorMethod::nonnegative
               : o.normalised ? FactorMethod::normalised
                              : FactorMethod::svd;
    r.logarithmic = o.logarithmic;
    r.weighted = o.weighted;
    r.terms = parse_terms("-J", o.terms);
    return r;
}

/// Which numbers of terms get a sphere: as asked for, else 1, 2, 4 and 8 of those that there are,
/// else the first four of them.
std::vector<std::size_t> sphere_terms(const FactorArguments& o, const std::vector<int>& terms) {
    std::vector<std::size_t> r;
    const auto position = [&](int j) {
        return std::size_t(std::ranges::find(terms, j) - terms.begin());
    };
    if (!o.spheres.empty()) {
        for (int j : parse_terms("--spheres", o.spheres)) {
            if (position(j) == terms.size())
                throw InputError(fmt::format("--spheres {}: it is not among -J {}", j, o.terms));
            r.push_back(position(j));
        }
        return r;
    }
    for (int j : {1, 2, 4, 8})
        if (position(j) < terms.size()) r.push_back(position(j));
    for (std::size_t i = 0; r.empty() && i < std::min<std::size_t>(terms.size(), 4); ++i)
        r.push_back(i);
    return r;
}

std::string method_text(const FactorOptions& o, const Factorisation& f) {
    std::string text = o.method == FactorMethod::nonnegative  ? "non-negative factors"
                       : o.method == FactorMethod::normalised ? "normalised decomposition"
                       : f.below + f.missing == 0             ? "singular value decomposition"
                                                              : "least squares";
    if (o.logarithmic) text += " of logarithms";
    if (o.weighted) text += ", weighted";
    return text;
}

/// What is mirrored without blur has no place in textures.
double mirrored_share(const Target& target) {
    double most = 0.;
    for (const Vec3d& w : {Vec3d{0., 0., 1.}, Vec3d{0.866, 0., 0.5}}) {
        const Vec3d m = target.mirror(w);
        most = std::max({most, m.x, m.y, m.z});
    }
    return most;
}

void print_table(const Target& target, const FactorOptions& o, const Factorisation& f) {
    fmt::print("{}: {} x {} pairs of directions ({}), {} band{}, {}\n", target.name(),
               o.grid.count(), o.grid.count(), name_of(o.grid.parameters), f.channels,
               f.channels == 1 ? "" : "s", method_text(o, f));
    const auto share = [&](std::size_t n) { return 100. * double(n) / double(f.pairs); };
    if (f.below) fmt::print("  {:.1f} % of them below the horizon\n", share(f.below));
    if (f.missing) fmt::print("  {:.1f} % of them without a value\n", share(f.missing));
    if (const double m = mirrored_share(target); m > 1e-4)
        fmt::print(
            "  what it mirrors without blur, up to {:.2g} of the light, is no part of this\n", m);
    fmt::print("  sampled in {:.2f} s, factored in {:.2f} s\n\n", f.seconds_sampling,
               f.seconds_factoring);
    fmt::print("{:>6} {:>11} {:>11} {:>11} {:>11} {:>11}\n", "J", "matrix", "largest", "weighted",
               "rendered", "in log");
    for (const FactorErrors& e : f.errors)
        fmt::print("{:>6} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g}\n", e.terms, e.matrix,
                   e.largest, e.weighted, e.rendered, e.rendered_log);
    fmt::print("\n");
}

ordered_json to_json(const Target& target, const FactorOptions& o, const Factorisation& f) {
    ordered_json r{
        {"name", target.name()},
        {"parameters", name_of(o.grid.parameters)},
        {"side", o.grid.side},
        {"method", method_text(o, f)},
        {"bands", f.channels},
        {"pairs", f.pairs},
        {"below_horizon", f.below},
        {"missing", f.missing},
        {"mirrored", mirrored_share(target)},
        {"seconds", {{"sampling", f.seconds_sampling}, {"factoring", f.seconds_factoring}}}};
    for (int c = 0; c < f.channels; ++c)
        if (!f.sigma[c].empty()) r["singular_values"].push_back(f.sigma[c]);
    for (const FactorErrors& e : f.errors)
        r["errors"].push_back({{"J", e.terms},
                               {"matrix", e.matrix},
                               {"largest", e.largest},
                               {"weighted", e.weighted},
                               {"rendered", e.rendered},
                               {"rendered_log", e.rendered_log}});
    return r;
}

Table error_table(const Target& target, const Factorisation& f) {
    Table t{target.name(),
            {"J", "matrix", "largest", "weighted", "rendered", "rendered_log"},
            {},
            PlotKind::semilog,
            "error, as a part of the BRDF's own size"};
    t.x_label = "terms J";
    t.names = {"",
               "of the matrix",
               "largest",
               "weighted by cosines",
               "between the texels",
               "the same, log"};
    double largest = 0.;
    for (const FactorErrors& e : f.errors) {
        t.rows.push_back(
            {double(e.terms), e.matrix, e.largest, e.weighted, e.rendered, e.rendered_log});
        largest = std::max({largest, e.matrix, e.largest, e.weighted, e.rendered});
    }
    if (largest == 0.) t.kind = PlotKind::curves;
    return t;
}

/// A folder's name from what was asked for: "he_torrance n=0.2" becomes he_torrance.
std::string folder_name(const std::string& target) {
    std::error_code none;
    std::string name = fs::exists(target, none) ? fs::path(target).filename().string()
                                                : target.substr(0, target.find(' '));
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
    return name;
}

int run(const FactorArguments& o) {
    const FactorOptions options = factor_options(o);
    const std::vector<std::size_t> spheres = sphere_terms(o, options.terms);
    if (o.output.empty() && !o.spheres.empty()) throw InputError("--spheres needs -o");
    std::vector<std::unique_ptr<Target>> targets;
    std::vector<fs::path> folders;
    for (const std::string& text : o.targets) {
        if (std::error_code none; text.find('=') < text.find(' ') && !fs::exists(text, none))
            throw InputError(
                fmt::format("'{}' stands alone: write a model and its settings between quotes, "
                            "'ward alpha=0.2'",
                            text));
        targets.push_back(make_target(text));
        if (o.output.empty()) continue;
        fs::path folder = o.output;
        if (o.targets.size() > 1) {
            folder /= folder_name(text);
            for (int i = 2; std::ranges::find(folders, folder) != folders.end(); ++i)
                folder = o.output / fmt::format("{}-{}", folder_name(text), i);
        }
        refuse_input_as_output(folder, {o.targets.begin(), o.targets.end()});
        folders.push_back(folder);
    }
    for (const fs::path& folder : folders) make_output_folder(folder);
    std::vector<Factorisation> results;
    std::vector<SphereGroup> groups;
    ordered_json documents = ordered_json::array();
    for (std::size_t i = 0; i < targets.size(); ++i) {
        results.push_back(factorise(*targets[i], options));
        if (o.json)
            documents.push_back(to_json(*targets[i], options, results.back()));
        else
            print_table(*targets[i], options, results.back());
        if (o.output.empty()) continue;
        write_factors(results.back().brdfs.back(), folders[i]);
        write_table(error_table(*targets[i], results.back()), folders[i] / "errors.svg");
    }
    if (o.json) fmt::print("{}\n", documents.dump(2));
    if (o.output.empty()) return success;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        groups.push_back({targets[i].get(), {}});
        for (std::size_t s : spheres) groups.back().approximations.push_back(&results[i].brdfs[s]);
    }
    write_image(draw_spheres(groups), o.output / "spheres.png");
    return success;
}

}  // namespace

Action set_up_factor(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<FactorArguments>();
    app.add_option("brdf", o->targets,
                   "a measured BRDF, a folder of factors, or a model with settings, 'ggx "
                   "alpha=0.2'; several are drawn beside one another")
        ->required();
    app.add_option("-J,--terms", o->terms, "numbers of terms: 8, 1..8 or 1,2,4,8")
        ->capture_default_str();
    add_whole(app, "-R,--side", o->side, FactorGrid::least_side, FactorGrid::most_side,
              "texels of a texture's side (32): the matrix has R^2 rows and columns");
    app.add_option("--param", o->parameters,
                   "what the factors depend on: io, light and viewer; half, the half vector and "
                   "the difference vector")
        ->capture_default_str();
    app.add_flag("--log", o->logarithmic, "factor the logarithm");
    app.add_flag("--nonnegative", o->nonnegative, "no factor below 0");
    app.add_flag("--normalised", o->normalised,
                 "one term from the means of rows and columns (Kautz and McCool 1999)");
    app.add_flag("--weighted", o->weighted,
                 "texels count by their solid angle and cosine, instead of all alike");
    app.add_option("--spheres", o->spheres, "which of -J get a sphere (1,2,4,8)");
    app.add_option("-o,--output", o->output,
                   "folder for the textures of the largest J (g01.exr, h01.exr, ...), errors.svg, "
                   "and spheres.png: the original above, sums of factors below");
    app.add_flag("--json", o->json, "for programs");
    return [o] { return run(*o); };
}

}  // namespace nacre::cli
