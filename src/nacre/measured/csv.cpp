// Tabulated BSDFs between commas, nacre's own: comments that begin with '#', a line of names
//   theta_i,phi_i,theta_o,phi_o,r,g,b
// (or one value, or wavelengths in nm, in place of r,g,b), then a pair of directions a line, in
// degrees, and the BSDF in sr^-1, without cosine. "nan" says that there is no measurement. theta_o
// above 90 degrees is light that goes through.
#include <numbers>

#include "nacre/measured/angle_table.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/rows.h"

namespace nacre {
namespace {

constexpr std::array<std::string_view, 4> angle_names{"theta_i", "phi_i", "theta_o", "phi_o"};

/// The first line that is no comment; false if there is none.
bool find_names(LineSplitter& lines, std::string_view& line, std::string* comments) {
    while (lines.next(line)) {
        std::string_view rest = line;
        if (line.starts_with('#')) {
            rest.remove_prefix(1);
            while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
            if (comments && !rest.empty())
                *comments += (comments->empty() ? "" : "; ") + std::string(rest);
        } else if (!take_word(rest).empty()) {
            return true;
        }
    }
    return false;
}

bool is_csv(const FileStart& start) {
    LineSplitter lines(start.head);
    std::string_view line;
    return find_names(lines, line, nullptr) && line.find("theta_i") != line.npos;
}

std::unique_ptr<Measured> read_csv(const MeasuredSource& source) {
    AngleTable table;
    table.info.format = "csv";
    table.info.parameterisation = "scattered directions theta_i, phi_i, theta_o, phi_o";
    table.names = angle_names;
    LineSplitter lines(source.bytes);
    std::string_view line;
    if (!find_names(lines, line, &table.info.description)) source.fail("holds no line of names");
    const std::vector<std::string_view> names = comma_words(line);
    for (std::size_t k = 0; k < 4; ++k)
        if (k >= names.size() || names[k] != angle_names[k])
            source.fail(
                lines.line(),
                fmt::format("column {} must be '{}', not '{}'; the names of a table are "
                            "theta_i,phi_i,theta_o,phi_o and then the values{}",
                            k + 1, angle_names[k], k < names.size() ? names[k] : "",
                            line.find(';') != line.npos ? ", with commas between them" : ""));
    table.kind = take_columns(source, lines.line(),
                              std::span<const std::string_view>(names).subspan(4), table.info);
    return read_angle_rows(source, lines, std::move(table));
}

WrittenMeasured write_csv(const Measured& data, const WriteOptions& options) {
    const MeasuredInfo& info = data.info();
    WrittenMeasured written;
    std::string& text = written.bytes;
    if (!info.description.empty()) text += "# " + one_line(info.description) + "\n";
    text += "theta_i,phi_i,theta_o,phi_o";
    if (!info.wavelengths.empty())
        for (const double nm : info.wavelengths) text += fmt::format(",{:.9g}", nm);
    else
        text += info.channels == 3 ? ",r,g,b" : ",value";
    text += '\n';
    for_each_row(data, options, [&](const MeasuredRow& row) {
        const AngleRow& a = row.angles;
        constexpr double degree = std::numbers::pi / 180.;
        text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}", a.theta_i / degree, a.phi_i / degree,
                            a.theta_o / degree, a.phi_o / degree);
        for (const double v : row.value) text += row.known ? fmt::format(",{:.9g}", v) : ",nan";
        text += '\n';
    });
    return written;
}

}  // namespace

const MeasuredFormat& csv_format() {
    static const MeasuredFormat format{
        .name = "csv",
        .title = "CSV",
        .ending = ".csv",
        .summary = "tables theta_i,phi_i,theta_o,phi_o,values in degrees and sr^-1",
        .memory = 24.,
        .recognise = is_csv,
        .read = read_csv,
        .keeps = {.wavelengths = true, .grey = true, .anisotropy = true, .transmission = true},
        .write = write_csv,
    };
    return format;
}

}  // namespace nacre
