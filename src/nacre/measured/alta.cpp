// Text files of ALTA (L. Belcour et al., the ALTA library, alta.gforge.inria.fr): lines "#KEY value"
// that name the coordinates and the unit, then a sample a line: coordinates, values, and perhaps
// bounds of the values. Angles in radians; ALTA's light is wi, its view wo.
#include <numbers>

#include "nacre/measured/alta_coordinates.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/rows.h"
#include "nacre/measured/scattered.h"
#include "nacre/spectrum/color.h"
#include "nacre/text/lines.h"
#include "nacre/text/number.h"

namespace nacre {
namespace {

enum class Unit { brdf, brdf_cosine, rgb, xyz, unknown };

struct Header {
    std::int64_t in = 0, out = 0;  ///< numbers of coordinates and values
    std::int64_t bounds = 0;       ///< #VS: bounds a value: none, one, two
    std::size_t dim_line = 0;
    std::string coordinates, unit;
    std::string description;
};

std::int64_t whole(const MeasuredSource& source, std::size_t line, std::string_view key,
                   std::string_view word, std::int64_t low, std::int64_t high) {
    const auto value = parse_integer(word);
    if (!value || *value < low || *value > high)
        source.fail(line, fmt::format("#{} must be a whole number from {} to {}, not '{}'", key,
                                      low, high, word));
    return *value;
}

/// "#KEY value"; what else begins with '#' is a comment.
void take_header(const MeasuredSource& source, std::size_t line, std::string_view text, Header& h) {
    std::string_view rest = text.substr(1);
    const bool comment = rest.empty() || is_blank(rest.front());
    const std::string_view key = take_word(rest);
    if (comment) return;
    std::string_view words = rest;
    const std::string_view value = take_word(words);
    if (key == "DIM") {
        h.dim_line = line;
        h.in = whole(source, line, key, value, 1, 6);
        h.out = whole(source, line, key, take_word(words), 1, max_measured_channels);
    } else if (key == "VS") {
        h.bounds = whole(source, line, key, value, 0, 2);
    } else if (key == "PARAM_IN") {
        h.coordinates = value;
    } else if (key == "PARAM_OUT") {
        h.unit = value;
    } else if (key == "FORMAT" && value == "binary") {
        source.fail(line, "binary files of ALTA are not read; save it as text");
    } else if (key == "SAMPLE" || key == "ORIGIN") {
        while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
        if (rest.size() > 1 && rest.front() == '"' && rest.back() == '"')
            rest = rest.substr(1, rest.size() - 2);
        h.description += (h.description.empty() ? "" : "; ") + std::string(rest);
    }
}

Unit unit_of(const MeasuredSource& source, const Header& h) {
    if (h.unit.empty() || h.unit == "UNKNOWN_OUTPUT") {
        if (h.out == 1 || h.out == 3) return Unit::unknown;
        source.fail(h.dim_line, fmt::format("{} values without #PARAM_OUT: it is not known what "
                                            "they are",
                                            h.out));
    }
    struct Known {
        std::string_view name;
        Unit unit;
        std::int64_t values;
    };
    for (const Known& k : {Known{"INV_STERADIAN", Unit::brdf, 1},
                           {"INV_STERADIAN_COSINE_FACTOR", Unit::brdf_cosine, 1},
                           {"RGB_COLOR", Unit::rgb, 3},
                           {"XYZ_COLOR", Unit::xyz, 3}}) {
        if (h.unit != k.name) continue;
        // Files of colours in sr^-1 are common.
        if (h.out == k.values || (k.values == 1 && h.out == 3)) return k.unit;
        source.fail(h.dim_line,
                    fmt::format("#PARAM_OUT {} does not go with {} values", h.unit, h.out));
    }
    source.fail(
        fmt::format("#PARAM_OUT '{}' cannot be read; known are INV_STERADIAN, "
                    "INV_STERADIAN_COSINE_FACTOR, RGB_COLOR and XYZ_COLOR",
                    h.unit));
}

std::unique_ptr<Measured> read_alta(const MeasuredSource& source) {
    Header h;
    LineSplitter lines(source.bytes);
    std::string_view line;
    std::vector<double> numbers;
    std::unique_ptr<ScatteredBuilder> builder;
    const AltaCoordinates* coordinates = nullptr;
    Unit unit = Unit::unknown;
    std::size_t at_horizon = 0;

    const auto finish_header = [&] {
        if (h.dim_line == 0)
            source.fail("has no line '#DIM', which says how many coordinates and values there are");
        if (h.coordinates.empty())
            source.fail("has no line '#PARAM_IN', which says what its coordinates are");
        coordinates = &find_alta_coordinates(source, h.coordinates);
        if (coordinates->count != h.in)
            source.fail(h.dim_line, fmt::format("#PARAM_IN {} has {} coordinates, but #DIM says {}",
                                                h.coordinates, coordinates->count, h.in));
        unit = unit_of(source, h);
        MeasuredInfo info;
        info.format = "alta";
        info.description = h.description;
        info.parameterisation = fmt::format("{}: {}", coordinates->name, coordinates->words);
        info.isotropic = coordinates->isotropic;
        info.channels = int(h.out);
        info.cosine = unit == Unit::brdf_cosine;
        info.scale = unit == Unit::xyz ? "XYZ, as linear red, green and blue" : "none: sr^-1";
        if (coordinates->count == 1)
            info.notes.push_back("a slice: it says nothing away from " +
                                 std::string(coordinates->words));
        if (unit == Unit::unknown)
            info.notes.emplace_back(
                "does not say what its values are (#PARAM_OUT): taken as sr^-1 without cosine");
        builder = std::make_unique<ScatteredBuilder>(std::move(info));
    };

    while (lines.next(line)) {
        if (line.starts_with('#')) {
            if (!builder) take_header(source, lines.line(), line, h);
            continue;
        }
        numbers.clear();
        take_numbers(source, lines.line(), line, false, numbers);
        if (numbers.empty()) continue;
        if (!builder) finish_header();
        const std::size_t want = std::size_t(h.in + h.out);
        const std::size_t one = want + std::size_t(h.bounds),
                          all = want + std::size_t(h.bounds * h.out);
        if (numbers.size() != one && numbers.size() != all)
            source.fail(lines.line(),
                        fmt::format("has {} numbers, but a sample has {} coordinates, {} values{}",
                                    numbers.size(), h.in, h.out,
                                    h.bounds ? fmt::format(" and {} bounds", h.bounds) : ""));
        const DirectionPair pair =
            coordinates->directions(source, lines.line(), std::span<const double>(numbers));
        std::span<double> value(numbers.data() + h.in, std::size_t(h.out));
        bool known = pair.wi.z > 0. && pair.wo.z > 0.;
        if (unit == Unit::brdf_cosine) {
            // f cos of 0 or of noise says nothing of f at the horizon.
            const bool horizon = std::abs(pair.wo.z) < 1e-4;
            at_horizon += horizon;
            known = known && !horizon;
            for (double& v : value) v /= pair.wo.z;
        } else if (unit == Unit::xyz) {
            const Vec3d rgb(xyz_to_rgb(Vec3f(float(value[0]), float(value[1]), float(value[2]))));
            for (int c = 0; c < 3; ++c) value[c] = rgb[c];
        }
        builder->add(pair.wi, pair.wo, value, known);
    }
    if (!builder) {
        finish_header();
    } else if (at_horizon > 0) {
        builder->info().notes.push_back(fmt::format(
            "{} samples at the horizon are missing: f cannot be had from f cos there", at_horizon));
    }
    // Slices say nothing beside themselves; grids of incidences lie up to 30 degrees apart.
    return builder->build(source, coordinates->count < 3 ? 0.02 : 0.15);
}

bool is_alta(const FileStart& start) {
    LineSplitter lines(start.head);
    std::string_view line;
    while (lines.next(line)) {
        if (line.starts_with("#DIM ") || line.starts_with("#DIM\t") ||
            line.starts_with("#PARAM_IN") || line.starts_with("#PARAM_OUT"))
            return true;
        if (!line.starts_with('#') && !line.empty()) return false;
    }
    return false;
}

/// Samples without a measurement are left out: scattered samples need no place for them.
WrittenMeasured write_alta(const Measured& data, const WriteOptions& options) {
    const MeasuredInfo& info = data.info();
    WrittenMeasured written;
    std::string& text = written.bytes;
    text = fmt::format("#DIM {} {}\n#PARAM_IN {}\n#PARAM_OUT {}\n", info.isotropic ? 3 : 4,
                       info.channels,
                       info.isotropic ? "ISOTROPIC_TV_TL_DPHI" : "SPHERICAL_TL_PL_TV_PV",
                       info.channels == 3 ? "RGB_COLOR" : "INV_STERADIAN");
    if (!info.description.empty()) text += "#SAMPLE " + one_line(info.description) + "\n";
    std::size_t unknown = 0;
    for_each_row(data, options, [&](const MeasuredRow& row) {
        const AngleRow& a = row.angles;
        if (a.theta_o > 0.5 * std::numbers::pi) return;
        unknown += !row.known;
        if (!row.known) return;
        text += info.isotropic
                    ? fmt::format("{:.9g} {:.9g} {:.9g}", a.theta_o, a.theta_i, a.phi_i - a.phi_o)
                    : fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}", a.theta_i, a.phi_i, a.theta_o,
                                  a.phi_o);
        for (const double v : row.value) text += fmt::format(" {:.9g}", v);
        text += '\n';
    });
    if (unknown > 0)
        written.lost.push_back(
            fmt::format("the places of {} samples without a measurement", unknown));
    return written;
}

}  // namespace

const MeasuredFormat& alta_format() {
    static const MeasuredFormat format{
        .name = "alta",
        .title = "ALTA",
        .ending = ".alta",
        .summary = "text of the ALTA library: scattered samples and slices in many coordinates",
        .memory = 40.,
        .recognise = is_alta,
        .read = read_alta,
        .keeps = {.grey = true, .anisotropy = true},
        .write = write_alta,
    };
    return format;
}

}  // namespace nacre
