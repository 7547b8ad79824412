// Text files in the keywords of ASTM E1392, Standard Practice for Angle Resolved Optical Scatter
// Measurements (1990 and later), as gonioreflectometers write them: lines "KEYWORD value", the last
// of which is VARS with the names of the columns, then a sample a line between commas. Angles are in
// radians, as Cornell's files have them, unless the header speaks of degrees; the BSDF is in sr^-1,
// without cosine.
#include "nacre/measured/angle_table.h"
#include "nacre/measured/number_text.h"
#include "nacre/text/number.h"

namespace nacre {
namespace {

bool is_keyword(std::string_view word) {
    if (word.size() < 2) return false;
    for (const char c : word)
        if (!((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_')) return false;
    return true;
}

bool is_astm(const FileStart& start) {
    LineSplitter lines(start.head);
    std::string_view line;
    bool first = true;
    while (lines.next(line)) {
        std::string_view rest = line;
        const std::string_view key = take_word(rest);
        if (key.empty()) continue;
        if (key == "VARS" || key == "NUM_POINTS") return true;
        if (first && line.find("1392") != line.npos && line.find("ASTM") != line.npos) return true;
        if (first && !is_keyword(key)) return false;
        first = false;
    }
    return false;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::unique_ptr<Measured> read_astm(const MeasuredSource& source) {
    AngleTable table;
    table.info.format = "astm";
    table.info.parameterisation = "scattered directions theta_i, phi_i, theta_s, phi_s";
    table.names = {"theta_i", "phi_i", "theta_s", "phi_s"};
    table.degrees = false;
    LineSplitter lines(source.bytes);
    std::string_view line, vars;
    while (lines.next(line)) {
        std::string_view rest = line;
        const std::string_view key = take_word(rest);
        rest = trimmed(rest);
        if (rest.find("degrees") != rest.npos || rest.find("DEGREES") != rest.npos)
            table.degrees = true;
        if (key == "VARS") {
            vars = rest;
            break;
        }
        if (key == "NUM_POINTS") {
            const auto count = parse_integer(rest);
            if (!count || *count < 0)
                source.fail(lines.line(),
                            fmt::format("NUM_POINTS must be a whole number, not '{}'", rest));
            table.announced = std::size_t(*count);
        } else if (key == "MATERIAL" || key == "SAMPLE" || key == "TITLE" || key == "REM" ||
                   key == "COMMENT" || key == "SAMPLE_ID") {
            if (!rest.empty())
                table.info.description +=
                    (table.info.description.empty() ? "" : "; ") + std::string(rest);
        }
    }
    if (vars.empty())
        source.fail("has no line VARS, which names the columns; it is incomplete: fetch it again");
    const std::vector<std::string_view> names = comma_words(vars);
    std::vector<std::string_view> values;
    std::array<bool, 4> found{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto at = std::find(table.names.begin(), table.names.end(), names[i]);
        if (at == table.names.end()) {
            values.push_back(names[i]);
            continue;
        }
        if (!values.empty())
            source.fail(lines.line(), fmt::format("VARS names {} after the values; angles come "
                                                  "first",
                                                  names[i]));
        found[std::size_t(at - table.names.begin())] = true;
        table.column[std::size_t(at - table.names.begin())] = i;
    }
    for (std::size_t k = 0; k < 4; ++k)
        if (!found[k])
            source.fail(lines.line(), fmt::format("VARS does not name {}; it must name theta_i, "
                                                  "phi_i, theta_s and phi_s",
                                                  table.names[k]));
    table.first_value = names.size() - values.size();
    if (table.first_value != 4) source.fail(lines.line(), "VARS names an angle twice");
    table.kind = take_columns(source, lines.line(), values, table.info);
    return read_angle_rows(source, lines, std::move(table));
}

}  // namespace

const MeasuredFormat& astm_format() {
    static const MeasuredFormat format{
        .name = "astm",
        .title = "ASTM E1392",
        .ending = ".astm",
        .summary = "text of keywords and samples between commas, as gonioreflectometers write it",
        .memory = 24.,
        .recognise = is_astm,
        .read = read_astm,
    };
    return format;
}

}  // namespace nacre
