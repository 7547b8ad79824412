#include "nacre/measured/angle_table.h"

#include <numbers>

#include "nacre/measured/angle_grid.h"
#include "nacre/measured/number_text.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// Keeps off the horizon itself, where no light falls in or is seen.
double off_horizon(double theta) {
    return std::abs(theta - 0.5 * pi) < 1e-9 ? 0.5 * pi - 1e-9 : theta;
}

class RowReader {
  public:
    RowReader(const MeasuredSource& source, const AngleTable& table)
        : source_(source), table_(table) {}

    AngleRow angles(std::size_t line, std::span<const double> numbers) const {
        return {off_horizon(theta(line, 0, numbers, 0.5 * pi)), phi(line, 1, numbers),
                off_horizon(theta(line, 2, numbers, pi)), phi(line, 3, numbers)};
    }

  private:
    double theta(std::size_t line, int k, std::span<const double> numbers, double limit) const {
        const double value = numbers[table_.column[k]];
        if (!table_.degrees) return checked_theta(source_, line, table_.names[k], value, limit);
        const double most = limit * 180. / pi;
        if (!(value >= -1e-6 && value <= most + 1e-6))
            source_.fail(line, fmt::format("{} = {:g} lies outside 0 to {:g} degrees",
                                           table_.names[k], value, most));
        return std::clamp(value, 0., most) * pi / 180.;
    }
    double phi(std::size_t line, int k, std::span<const double> numbers) const {
        const double value = numbers[table_.column[k]];
        if (!table_.degrees) return checked_phi(source_, line, table_.names[k], value);
        if (!(std::abs(value) <= 720.))
            source_.fail(line,
                         fmt::format("{} = {:g} lies outside two turns", table_.names[k], value));
        return value * pi / 180.;
    }

    const MeasuredSource& source_;
    const AngleTable& table_;
};

}  // namespace

std::unique_ptr<Measured> read_angle_rows(const MeasuredSource& source, LineSplitter& lines,
                                          AngleTable table) {
    const std::size_t n = std::size_t(table.info.channels), columns = table.first_value + n;
    const RowReader reader(source, table);
    std::vector<AngleRow> rows;
    std::vector<double> values, numbers;
    std::string_view line;
    while (lines.next(line)) {
        std::string_view blank = line;
        if (line.starts_with('#') || take_word(blank).empty()) continue;
        numbers.clear();
        take_numbers(source, lines.line(), line, true, numbers);
        if (numbers.size() != columns)
            source.fail(lines.line(), fmt::format("has {} columns, but the header names {}",
                                                  numbers.size(), columns));
        rows.push_back(reader.angles(lines.line(), numbers));
        const std::span<double> value(numbers.data() + table.first_value, n);
        to_channels(table.kind, value);
        values.insert(values.end(), value.begin(), value.end());
    }
    if (table.announced && *table.announced != rows.size())
        source.fail(fmt::format(
            "holds {} samples, but its header announces {}{}", rows.size(), *table.announced,
            rows.size() < *table.announced ? "; it is incomplete: fetch it again" : ""));
    // At the normal an azimuth says nothing.
    std::optional<double> azimuth;
    table.info.isotropic = true;
    for (const AngleRow& r : rows) {
        if (r.theta_i == 0.) continue;
        if (azimuth && std::abs(r.phi_i - *azimuth) > 1e-6) table.info.isotropic = false;
        azimuth = r.phi_i;
    }
    if (table.info.isotropic)
        table.info.notes.emplace_back("taken as isotropic: all light comes from one azimuth");
    table.info.scale =
        table.kind == ColumnKind::xyz ? "XYZ, as linear red, green and blue" : "none: sr^-1";
    if (auto grid = GridMeasured::make(rows, values, table.info)) return grid;
    ScatteredBuilder builder(std::move(table.info));
    for (std::size_t i = 0; i < rows.size(); ++i)
        builder.add(polar_direction(rows[i].theta_i, rows[i].phi_i),
                    polar_direction(rows[i].theta_o, rows[i].phi_o),
                    std::span<const double>(values.data() + i * n, n));
    return builder.build(source, 0.2);
}

}  // namespace nacre
