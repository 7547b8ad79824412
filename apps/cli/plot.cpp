#include "apps/cli/plot.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "nacre/math/error.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

std::string csv_of(const Table& table) {
    std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
    for (const auto& row : table.rows) text += fmt::format("{:.12g}\n", fmt::join(row, ","));
    return text;
}

/// A string of gnuplot's that nothing in it can end or start a command from.
std::string quoted(const std::string& text) {
    std::string r = "'";
    for (char c : text) r += c == '\'' ? std::string("''") : std::string(1, c);
    return r + "'";
}

const std::string& name_of(const Table& t, std::size_t column) {
    return t.names.size() == t.columns.size() ? t.names[column] : t.columns[column];
}

bool logarithmic(const Table& t) {
    return t.kind == PlotKind::semilog || t.kind == PlotKind::logarithmic;
}

/// The lower end of a logarithmic ordinate: what falls without end would press all else together.
double lowest_shown(const Table& t) {
    constexpr double decades = 1e-8;
    double largest = 0.;
    for (const auto& row : t.rows)
        for (std::size_t c = 1; c < row.size(); ++c)
            if (!t.errors.contains(c) && row[c] > largest) largest = row[c];
    return decades * largest;
}

// Two standard errors hold the truth 19 times of 20.
constexpr double band = 2.;

/// A column with standard errors as lines "x value low high". On a logarithmic ordinate neighbours
/// are taken together, by the weights of the rows, until their mean is told from 0, for which there
/// is no place: else the line would break there.
std::string band_data(const Table& t, std::size_t value, std::size_t error) {
    const double lowest = logarithmic(t) ? lowest_shown(t) : -INFINITY;
    std::string lines;
    double sum = 0., square = 0., weight = 0.;
    std::size_t first = 0;
    for (std::size_t i = 0; i < t.rows.size(); ++i) {
        const auto& row = t.rows[i];
        if (!std::isfinite(row[value])) continue;
        if (weight == 0.) first = i;
        const double w = t.weights.empty() ? 1. : t.weights[i];
        const double e = std::isfinite(row[error]) ? row[error] : 0.;
        sum += w * row[value], square += w * w * e * e, weight += w;
        const double mean = sum / weight, sigma = std::sqrt(square) / weight;
        const bool told = !logarithmic(t) || mean > band * sigma;
        if (!told && (i + 1 < t.rows.size() || !(mean > 0.))) continue;
        const double from = t.rows[first][0], to = row[0];
        lines +=
            fmt::format("{:.8g} {:.8g} {:.8g} {:.8g}\n",
                        t.kind == PlotKind::logarithmic ? std::sqrt(from * to) : 0.5 * (from + to),
                        mean, std::max(mean - band * sigma, lowest), mean + band * sigma);
        sum = square = weight = 0.;
    }
    return lines;
}

std::optional<std::size_t> error_of(const Table& t, std::size_t column) {
    for (const auto& [error, value] : t.errors)
        if (value == column) return error;
    return {};
}

/// Columns 2.. over column 1, those with standard errors as lines in bands.
std::string curves(const Table& t, const std::string& using_format) {
    std::vector<std::string> bands, lines;
    std::size_t style = 0;
    for (std::size_t c = 1; c < t.columns.size(); ++c) {
        if (t.errors.contains(c)) continue;
        ++style;
        // A simulation among formulas is black.
        const std::size_t line = t.errors.size() == 1 && error_of(t, c) ? 15 : style;
        const std::string title = quoted(name_of(t, c));
        if (error_of(t, c)) {
            bands.push_back(fmt::format(
                "$band{} using 1:3:4 with filledcurves fs transparent solid 0.22 noborder ls {} "
                "notitle",
                c, line));
            lines.push_back(fmt::format("$band{} using 1:2 with lines ls {} title {}", c, line,
                                        quoted(name_of(t, c) + ", ±2 standard errors")));
        } else {
            const bool points = std::ranges::find(t.points, c) != t.points.end();
            const std::string as = points               ? "points pt 7 ps 0.4 lc rgb '#1c1d1f'"
                                   : t.rows.size() == 1 ? fmt::format("points ls {} pt 7", line)
                                                        : fmt::format("lines ls {}", line);
            lines.push_back(fmt::format("$data using {} with {} title {}",
                                        fmt::format(fmt::runtime(using_format), c + 1), as, title));
        }
    }
    bands.insert(bands.end(), lines.begin(), lines.end());
    return fmt::format("plot {}\n", fmt::join(bands, ", "));
}

struct Extent {
    double left = 0., right = 0., bottom = 0., top = 0.;
};

/// Of lobes, with the origin and a margin.
Extent lobes_extent(const Table& t) {
    Extent e;
    for (const auto& row : t.rows)
        for (std::size_t c = 1; c < row.size(); ++c) {
            if (!std::isfinite(row[c])) continue;
            const double angle = row[0] * std::numbers::pi / 180.;
            const double x = row[c] * std::sin(angle), y = row[c] * std::cos(angle);
            e.left = std::min(e.left, x), e.right = std::max(e.right, x);
            e.bottom = std::min(e.bottom, y), e.top = std::max(e.top, y);
        }
    const double margin = 0.04 * std::max({e.right - e.left, e.top - e.bottom, 1e-30});
    e.left -= margin, e.right += margin, e.top += margin;
    if (e.bottom < 0.) e.bottom -= margin;
    return e;
}

struct Canvas {
    double width = 1., height = 0.75;  ///< of the whole picture, in units of its usual width
};

/// For lobes as wide and high as they are; no side is less than half of the other.
Canvas canvas_of(const Table& t) {
    if (t.kind == PlotKind::image) return {1., 0.9};
    if (t.kind != PlotKind::polar) return {1.25, 0.75};  // the legend beside it
    const Extent e = lobes_extent(t);
    const double slope = (e.top - e.bottom) / (e.right - e.left);
    // Axes, title and legend take what is beside 0.86 of the width and 0.26 of it in height.
    return slope < 1. ? Canvas{1., std::max(0.5, 0.86 * slope + 0.26)}
                      : Canvas{std::max(0.6, 0.86 / slope + 0.14), 1.12};
}

/// 1, 2 or 5 times a power of ten, five to twelve of which are `length`.
double step_of(double length) {
    const double power = std::pow(10., std::floor(std::log10(length / 5.)));
    const double rest = length / 5. / power;
    return (rest >= 5. ? 5. : rest >= 2. ? 2. : 1.) * power;
}

/// Colours of the report's diagrams (page/report.css), which differ in lightness too.
std::string style() {
    constexpr const char* colours[] = {"#0b64a8", "#cc5200", "#007d5c", "#b0478c",
                                       "#8f6a00", "#2f93cc", "#5a5a5a"};
    std::string s;
    for (int i = 0; i < 14; ++i)
        s += fmt::format("set style line {} lc rgb '{}' lw 2 dt {}\n", i + 1, colours[i % 7],
                         i < 7 ? 1 : 2);
    return s +
           "set style line 15 lc rgb '#1c1d1f' lw 2 dt 1\n"
           "set encoding utf8\nset minussign\n"
           "set border 3 lc rgb '#5c6065'\nset tics nomirror textcolor rgb '#5c6065'\n"
           "set grid lc rgb '#dedfdc' lt 1 lw 0.7\n"
           "set title textcolor rgb '#1c1d1f'\n";
}

/// Numbers in the form of gnuplot; an image's rows are kept apart by the first column.
std::string gnuplot_script(const Table& t, const fs::path& output, const std::string& set_up) {
    std::string s = style() + set_up + "\n";
    s += fmt::format("set output {}\nset title {} noenhanced\n", quoted(output.string()),
                     quoted(t.title));
    s += "$data << END\n";
    for (const auto& row : t.rows) s += fmt::format("{:.8g}\n", fmt::join(row, " "));
    s += "END\n";
    for (const auto& [error, value] : t.errors)
        s += fmt::format("$band{} << END\n{}END\n", value, band_data(t, value, error));
    s += t.kind == PlotKind::polar ? "set key noenhanced outside bottom center horizontal\n"
                                   : "set key noenhanced outside right top vertical Left reverse\n"
                                     "set autoscale xfix\n";
    const std::string x_label = quoted(t.x_label.empty() ? t.columns[0] : t.x_label);
    const std::string y_label = quoted(t.y_label);
    switch (t.kind) {
        case PlotKind::curves:
        case PlotKind::semilog:
        case PlotKind::logarithmic:
            if (t.kind != PlotKind::curves) {
                s += fmt::format("set logscale {}\nset format y \"10^{{%T}}\"\n",
                                 t.kind == PlotKind::semilog ? "y" : "xy");
                s += fmt::format("set yrange [{:.3g}<*:]\n", lowest_shown(t));
            }
            s += fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced\n", x_label,
                             y_label);
            if (t.rows.size() == 1)  // of one point gnuplot takes no range
                s += fmt::format("set xrange [{:.6g}:{:.6g}]\n", 0.5 * t.rows[0][0],
                                 1.5 * t.rows[0][0] + (t.rows[0][0] == 0. ? 1. : 0.));
            s += curves(t, "1:{}");
            break;
        case PlotKind::polar: {
            const Extent e = lobes_extent(t);
            // The same steps along both axes: a flat plot would crowd steps of its own.
            s += fmt::format("set xtics nomirror {0:.6g}\nset ytics nomirror {0:.6g}\n",
                             step_of(std::max(e.right - e.left, e.top - e.bottom)));
            s += fmt::format(
                "set size ratio -1\nset zeroaxis lt 1 lc rgb '#5c6065'\n"
                "set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n"
                "set xlabel {} noenhanced offset 0,0.4\n",
                e.left, e.right, e.bottom, e.top, y_label);
            s += curves(t, "(${0}*sin($1*pi/180)):(${0}*cos($1*pi/180))");
            break;
        }
        case PlotKind::image:
            s += fmt::format(
                "set xlabel {} noenhanced\nset ylabel {} noenhanced\n"
                "set cblabel {} noenhanced\nset size square\nset logscale cb\n"
                "set palette gray\nset autoscale fix\n"
                "plot $data using 1:2:($3 > 0 ? $3 : 1/0) with image notitle\n",
                x_label, quoted(name_of(t, 1)), y_label);
            break;
    }
    return s;
}

void run_gnuplot(const std::string& script) {
    // What gnuplot has to say goes to the user's terminal with the exit status.
    std::FILE* pipe = popen("gnuplot", "w");
    if (!pipe) throw RunError("cannot start gnuplot");
    std::fwrite(script.data(), 1, script.size(), pipe);
    if (pclose(pipe) != 0)
        throw RunError(
            "gnuplot failed or is not there (Debian: gnuplot-nox); a .csv needs no gnuplot");
}

/// The picture, whole or not at all.
void draw(const Table& table, const fs::path& path, const std::string& set_up) {
    const fs::path beside = path.string() + fmt::format(".{}.part", getpid());
    try {
        run_gnuplot(gnuplot_script(table, beside, set_up));
    } catch (...) {
        std::error_code ignored;
        fs::remove(beside, ignored);
        throw;
    }
    fs::rename(beside, path);
}

}  // namespace

void check_table_output(const fs::path& path) {
    const std::string extension = path.extension().string();
    if (!path.empty() && extension != ".csv" && extension != ".svg" && extension != ".png")
        throw InputError(
            fmt::format("cannot write '{}': a table becomes .csv, .svg or .png", path.string()));
    if (!path.empty()) check_output_file(path);
}

void write_table(const Table& table, const fs::path& path) {
    if (path.empty()) {
        fmt::print("{}", csv_of(table));
        return;
    }
    check_table_output(path);
    const std::string extension = path.extension().string();
    // Beside a picture under a name that nobody gives to anything else: x.csv may be the user's.
    write_whole_file(extension == ".csv" ? path : fs::path(path.string() + ".csv"), csv_of(table));
    if (extension == ".csv") return;
    const Canvas canvas = canvas_of(table);
    draw(table, path,
         extension == ".svg"
             ? fmt::format("set terminal svg size {:.0f},{:.0f} dynamic font 'Noto Sans,Arial,"
                           "sans-serif,13' background rgb 'white'",
                           720 * canvas.width, 720 * canvas.height)
             : fmt::format("set terminal pngcairo size {:.0f},{:.0f} font 'Noto Sans,13' linewidth "
                           "1.4 background rgb 'white'",
                           1080 * canvas.width, 1080 * canvas.height));
}

void draw_table(const Table& table, const fs::path& path) {
    // The scale is that of the vertical axis; every further mark would only make the file larger.
    draw(table, path,
         "set border 2\nunset xtics\nset ytics nomirror\nunset grid\n"
         "set terminal svg size 420,320 dynamic background rgb 'white'");
}

}  // namespace nacre::cli
