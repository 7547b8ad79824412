#include "nacre/layers/mcml_io.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "nacre/math/error.h"
#include "nacre/text/lines.h"
#include "nacre/text/number.h"
#include "nacre/text/whole_file.h"

namespace nacre {

namespace {

constexpr double mm_per_cm = 10.;
constexpr double endless_cm = 1e6, written_endless_cm = 1e8;

/// The lines of a file that hold anything but a comment, as words.
class Lines {
  public:
    Lines(std::string_view text, const std::string& name) : lines_(text), name_(name) {
        if (is_utf16(text))
            throw InputError(fmt::format(
                "{}: is text in UTF-16, which is not read; save it as UTF-8 or ASCII", name));
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}:{}: {}", name_, lines_.line(), what));
    }

    /// Whether there is another one, which then is the current.
    bool next() {
        for (std::string_view line; lines_.next(line);) {
            words_.clear();
            line = without_comment(line);
            for (auto word = take_word(line); !word.empty(); word = take_word(line))
                words_.push_back(word);
            if (!words_.empty()) return true;
        }
        return false;
    }

    /// The next one, which holds `count` words: `what`.
    const std::vector<std::string_view>& expect(std::size_t count, std::string_view what) {
        if (!next()) fail(fmt::format("the file ends where {} should follow", what));
        if (words_.size() != count)
            fail(fmt::format("{} should be {} {}, not {}", what, count,
                             count == 1 ? "word" : "words", words_.size()));
        return words_;
    }

    double number(std::size_t word, std::string_view what) const {
        const std::string_view w = words_[word];
        const auto value = parse_number(w);
        if (!value || !std::isfinite(*value))
            fail(fmt::format("{} is '{}', which is not a number", what, w));
        return *value;
    }
    double number(std::size_t word, std::string_view what, double least) const {
        const double value = number(word, what);
        if (value < least) fail(fmt::format("{} = {:g} must be at least {:g}", what, value, least));
        return value;
    }
    double positive(std::size_t word, std::string_view what) const {
        const double value = number(word, what);
        if (value <= 0.) fail(fmt::format("{} = {:g} must be positive", what, value));
        return value;
    }
    std::uint64_t count(std::size_t word, std::string_view what, std::uint64_t most) const {
        const std::string_view w = words_[word];
        const auto value = parse_integer(w);
        if (!value || *value < 1 || static_cast<std::uint64_t>(*value) > most)
            fail(fmt::format("{} is '{}'; it must be a whole number from 1 to {}", what, w, most));
        return static_cast<std::uint64_t>(*value);
    }

  private:
    LineSplitter lines_;
    const std::string& name_;
    std::vector<std::string_view> words_;
};

Layer parse_layer(Lines& lines, std::uint64_t i, bool last) {
    const auto name = [&](const char* what) { return fmt::format("{} of layer {}", what, i); };
    lines.expect(5, fmt::format("layer {} (n mua mus g d)", i));
    Layer l;
    l.eta = lines.positive(0, name("n"));
    l.sigma_a = lines.number(1, name("mua"), 0.) / mm_per_cm;
    l.sigma_s = lines.number(2, name("mus"), 0.) / mm_per_cm;
    l.g = lines.number(3, name("g"));
    if (!(l.g > -1. && l.g < 1.))
        lines.fail(fmt::format("{} = {:g} must be between -1 and 1", name("g"), l.g));
    const double d = lines.positive(4, name("d"));
    l.thickness = last && d >= endless_cm ? std::numeric_limits<double>::infinity() : d * mm_per_cm;
    return l;
}

McmlRun parse_run(Lines& lines) {
    McmlRun run;
    const auto& file = lines.expect(2, "output file and format");
    run.output = file[0];
    if (file[1] != "A" && file[1] != "B" && file[1] != "a" && file[1] != "b")
        lines.fail(fmt::format("the format is '{}'; it must be A or B", file[1]));
    run.binary = file[1] == "B" || file[1] == "b";
    lines.expect(1, "the number of photons");
    run.photons = lines.count(0, "the number of photons", std::uint64_t(1) << 53);
    lines.expect(2, "dz and dr");
    run.bins.depth_width = lines.positive(0, "dz") * mm_per_cm;
    run.bins.radius_width = lines.positive(1, "dr") * mm_per_cm;
    lines.expect(3, "the numbers of dz, dr and da");
    run.bins.depth = int(lines.count(0, "the number of dz", 10000));
    run.bins.radius = int(lines.count(1, "the number of dr", 10000));
    run.bins.angle = int(lines.count(2, "the number of da", 10000));
    run.bins.pairs = true;
    lines.expect(1, "the number of layers");
    const std::uint64_t layers = lines.count(0, "the number of layers", 10000);
    lines.expect(1, "n above");
    run.stack.eta_above = lines.positive(0, "n above");
    for (std::uint64_t i = 1; i <= layers; ++i)
        run.stack.layers.push_back(parse_layer(lines, i, i == layers));
    lines.expect(1, "n below");
    run.stack.eta_below = lines.positive(0, "n below");
    return run;
}

/// The lines of a run that input and output files share.
std::string run_text(const McmlRun& run) {
    const SlabBins& b = run.bins;
    std::string s = fmt::format(
        "{}\t{}\t# output file, format\n{}\t# photons\n{}\t{}\t# dz, dr [cm]\n"
        "{}\t{}\t{}\t# numbers of dz, dr, da\n\n{}\t# layers\n#n\tmua\tmus\tg\td\n"
        "{}\t# n above\n",
        run.output, run.binary ? 'B' : 'A', run.photons, b.depth_width / mm_per_cm,
        b.radius_width / mm_per_cm, b.depth, b.radius, b.angle, run.stack.layers.size(),
        run.stack.eta_above);
    for (const Layer& l : run.stack.layers)
        s += fmt::format("{}\t{}\t{}\t{}\t{}\n", l.eta, l.sigma_a * mm_per_cm,
                         l.sigma_s * mm_per_cm, l.g,
                         std::isinf(l.thickness) ? written_endless_cm : l.thickness / mm_per_cm);
    return s + fmt::format("{}\t# n below\n", run.stack.eta_below);
}

/// One category of an output file, `per_line` numbers a line; nothing if it was not computed.
std::string category(const char* heading, const std::vector<Estimate>& values, double scale,
                     int per_line) {
    if (values.empty()) return "";
    std::string s = fmt::format("\n{}\n", heading);
    int column = 0;
    for (const Estimate& e : values) {
        s += fmt::format("{:12.4E}", e.mean * scale);
        s += ++column % per_line == 0 ? "\n" : " ";
    }
    if (s.back() != '\n') s.back() = '\n';
    return s;
}

}  // namespace

SlabMonteCarloOptions McmlRun::options(std::uint64_t seed) const {
    SlabMonteCarloOptions o;
    o.photons = photons;
    o.seed = seed;
    o.bins = bins;
    o.roulette_weight = 1e-4;
    o.roulette_gain = 10.;
    return o;
}

std::vector<McmlRun> parse_mci(std::string_view text, const std::string& name) {
    Lines lines(text, name);
    const auto& version = lines.expect(1, "the version of the file format");
    if (version[0] != "1.0")
        lines.fail(fmt::format("the file's version is '{}'; only 1.0 can be read", version[0]));
    lines.expect(1, "the number of runs");
    const std::uint64_t count = lines.count(0, "the number of runs", 100000);
    std::vector<McmlRun> runs;
    for (std::uint64_t i = 0; i < count; ++i) runs.push_back(parse_run(lines));
    if (lines.next())
        lines.fail(fmt::format("nothing should follow the {} run{} that the file announces", count,
                               count == 1 ? "" : "s"));
    return runs;
}

std::vector<McmlRun> read_mci(const std::filesystem::path& file) {
    const auto text = read_whole_file(file);
    if (!text) throw InputError(fmt::format("{}: cannot be read", file.string()));
    return parse_mci(*text, file.string());
}

std::string mci_text(const std::vector<McmlRun>& runs) {
    std::string s = fmt::format("1.0\t# file version\n{}\t# runs\n", runs.size());
    for (const McmlRun& r : runs) s += fmt::format("\n{}", run_text(r));
    return s;
}

std::string mco_text(const McmlRun& run, const SlabMonteCarloResult& r) {
    std::string s = "A1\t# version of the file format\n\nInParm\t# input; lengths in cm\n";
    s += run_text(run);
    const LayerTotals& t = r.totals;
    s += fmt::format(
        "\nRAT #Reflectance, absorption, transmission.\n"
        "{:<14.6G}\t#Specular reflectance [-]\n{:<14.6G}\t#Diffuse reflectance [-]\n"
        "{:<14.6G}\t#Absorbed fraction [-]\n{:<14.6G}\t#Transmittance [-]\n",
        t.specular, t.reflectance - t.specular, t.absorptance, t.transmittance);
    constexpr double c = mm_per_cm;
    s += category("A_l #Absorption by layer. [-]", r.absorbed, 1., 1);
    s += category("A_z #A[0], [1],..A[nz-1]. [1/cm]", r.absorbed_depth, c, 1);
    s += category("Rd_r #Rd[0], [1],..Rd[nr-1]. [1/cm2]", r.reflected_radius, c * c, 1);
    s += category("Rd_a #Rd[0], [1],..Rd[na-1]. [sr-1]", r.reflected_angle, 1., 1);
    s += category("Tt_r #Tt[0], [1],..Tt[nr-1]. [1/cm2]", r.transmitted_radius, c * c, 1);
    s += category("Tt_a #Tt[0], [1],..Tt[na-1]. [sr-1]", r.transmitted_angle, 1., 1);
    s += category("# A[r][z]. [1/cm3]\nA_rz", r.absorbed_radius_depth, c * c * c, 5);
    s += category("# Rd[r][angle]. [1/(cm2sr)].\nRd_ra", r.reflected_radius_angle, c * c, 5);
    s += category("# Tt[r][angle]. [1/(cm2sr)].\nTt_ra", r.transmitted_radius_angle, c * c, 5);
    return s;
}

std::string slab_csv(const SlabBins& b, const SlabMonteCarloResult& r) {
    std::string s = "quantity,unit,layer,radius,depth,angle,mean,standard_error\n";
    const auto put = [&](const char* name, const char* unit, const std::string& where, Estimate e) {
        s += fmt::format("{},{},{},{:.9g},{:.3g}\n", name, unit, where, e.mean, e.error);
    };
    const LayerTotals &t = r.totals, &d = r.error;
    put("reflectance", "1", ",,,", {t.reflectance, d.reflectance});
    put("specular", "1", ",,,", {t.specular, d.specular});
    put("transmittance", "1", ",,,", {t.transmittance, d.transmittance});
    put("unscattered", "1", ",,,", {t.unscattered, d.unscattered});
    put("absorptance", "1", ",,,", {t.absorptance, d.absorptance});
    for (std::size_t i = 0; i < r.absorbed.size(); ++i)
        put("absorbed", "1", fmt::format("{},,,", i + 1), r.absorbed[i]);
    const auto middle = [](std::size_t i, double width) {
        return fmt::format("{:.9g}", (double(i) + 0.5) * width);
    };
    const auto radius = [&](std::size_t i) { return middle(i, b.radius_width); };
    const auto depth = [&](std::size_t i) { return middle(i, b.depth_width); };
    const auto angle = [&](std::size_t i) { return middle(i, 90. / b.angle); };
    const auto all = [&](const char* name, const char* unit, const std::vector<Estimate>& values,
                         const auto& where) {
        for (std::size_t i = 0; i < values.size(); ++i) put(name, unit, where(i), values[i]);
    };
    const auto angles = std::size_t(b.angle), depths = std::size_t(b.depth);
    const auto at_radius = [&](std::size_t i) { return fmt::format(",{},,", radius(i)); };
    const auto at_angle = [&](std::size_t i) { return fmt::format(",,,{}", angle(i)); };
    const auto at_depth = [&](std::size_t i) { return fmt::format(",,{},", depth(i)); };
    const auto at_both = [&](std::size_t i) {
        return fmt::format(",{},,{}", radius(i / angles), angle(i % angles));
    };
    const auto at_place = [&](std::size_t i) {
        return fmt::format(",{},{},", radius(i / depths), depth(i % depths));
    };
    all("reflected", "mm^-2", r.reflected_radius, at_radius);
    all("transmitted", "mm^-2", r.transmitted_radius, at_radius);
    all("reflected", "sr^-1", r.reflected_angle, at_angle);
    all("transmitted", "sr^-1", r.transmitted_angle, at_angle);
    all("absorbed", "mm^-1", r.absorbed_depth, at_depth);
    all("absorbed", "mm^-3", r.absorbed_radius_depth, at_place);
    all("reflected", "mm^-2 sr^-1", r.reflected_radius_angle, at_both);
    all("transmitted", "mm^-2 sr^-1", r.transmitted_radius_angle, at_both);
    return s;
}

}  // namespace nacre
