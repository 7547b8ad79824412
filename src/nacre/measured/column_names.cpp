#include "nacre/measured/column_names.h"

#include "nacre/spectrum/color.h"
#include "nacre/text/names.h"
#include "nacre/text/number.h"

namespace nacre {
namespace {

/// nm by "400", "400nm", "400.5 nm".
std::optional<double> wavelength(std::string_view name) {
    if (name.ends_with("nm")) name.remove_suffix(2);
    while (name.ends_with(' ')) name.remove_suffix(1);
    const auto value = parse_number(name);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

bool are(std::span<const std::string_view> names, std::initializer_list<std::string_view> wanted) {
    return std::equal(names.begin(), names.end(), wanted.begin(), wanted.end(),
                      [](std::string_view a, std::string_view b) { return plain_name(a) == b; });
}

}  // namespace

ColumnKind take_columns(const MeasuredSource& source, std::size_t line,
                        std::span<const std::string_view> names, MeasuredInfo& info) {
    if (names.empty()) source.fail(line, "names no column of values after the angles");
    if (names.size() > std::size_t(max_measured_channels))
        source.fail(line, fmt::format("names {} columns of values; at most {} can be read",
                                      names.size(), max_measured_channels));
    info.channels = int(names.size());
    if (are(names, {"r", "g", "b"})) return ColumnKind::rgb;
    if (are(names, {"x", "y", "z"})) return ColumnKind::xyz;
    for (const std::string_view name : names)
        if (const auto nm = wavelength(name)) info.wavelengths.push_back(*nm);
    if (info.wavelengths.size() == names.size()) {
        for (std::size_t i = 0; i < names.size(); ++i)
            if (!(info.wavelengths[i] > (i ? info.wavelengths[i - 1] : 0.)))
                source.fail(line, fmt::format("wavelengths must be positive and ascend, but {} {}",
                                              names[i],
                                              i ? "follows " + std::string(names[i - 1])
                                                : std::string("is the first")));
        return ColumnKind::wavelengths;
    }
    if (names.size() == 1 && info.wavelengths.empty()) return ColumnKind::grey;
    std::string list;
    for (const std::string_view name : names.first(std::min<std::size_t>(names.size(), 6)))
        list += (list.empty() ? "" : ", ") + std::string(name.substr(0, 24));
    source.fail(line, fmt::format("columns of values '{}{}' are not known; write r,g,b or x,y,z or "
                                  "wavelengths in nm or one column of any name",
                                  list, names.size() > 6 ? ", ..." : ""));
}

void to_channels(ColumnKind kind, std::span<double> values) {
    if (kind != ColumnKind::xyz) return;
    const Vec3d rgb(xyz_to_rgb(Vec3f(float(values[0]), float(values[1]), float(values[2]))));
    for (int c = 0; c < 3; ++c) values[c] = rgb[c];
}

}  // namespace nacre
