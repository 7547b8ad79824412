#include "apps/cli/plot.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>

#include "nacre/math/error.h"
#include "nacre/scene/whole_file.h"

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

/// Columns 2.. over column 1, those of standard errors as bars of the column they belong to.
std::string curves(const Table& t, const std::string& using_format) {
    std::vector<std::string> parts;
    for (std::size_t c = 1; c < t.columns.size(); ++c) {
        if (const auto error = t.errors.find(c); error != t.errors.end())
            parts.push_back(
                fmt::format("$data using 1:{}:{} with yerrorbars lw 1 pt 0 lc rgb 'black' notitle",
                            error->second + 1, c + 1));
        else
            parts.push_back(fmt::format("$data using {} with lines lw 2 title \"{}\"",
                                        fmt::format(fmt::runtime(using_format), c + 1),
                                        t.columns[c]));
    }
    return fmt::format("plot {}\n", fmt::join(parts, ", "));
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

/// Numbers in the form of gnuplot; an image's rows are kept apart by the first column.
std::string gnuplot_script(const Table& t, const fs::path& output, const std::string& set_up) {
    std::string s = set_up + "\n";
    s += fmt::format("set output {}\nset title {} noenhanced\n", quoted(output.string()),
                     quoted(t.title));
    s += "$data << END\n";
    for (const auto& row : t.rows) s += fmt::format("{:.8g}\n", fmt::join(row, " "));
    s += "END\nset key noenhanced\n";
    switch (t.kind) {
        case PlotKind::curves:
        case PlotKind::semilog:
        case PlotKind::logarithmic:
            if (t.kind != PlotKind::curves) {
                s += fmt::format("set logscale {}\nset format y \"10^{{%T}}\"\n",
                                 t.kind == PlotKind::semilog ? "y" : "xy");
                s += fmt::format("set yrange [{:.3g}<*:]\nset key bottom left\n", lowest_shown(t));
            }
            s += fmt::format("set xlabel \"{}\" noenhanced\nset ylabel \"{}\" noenhanced\n",
                             t.columns[0], t.y_label);
            s += curves(t, "1:{}");
            break;
        case PlotKind::polar:
            s += fmt::format(
                "set size ratio -1\nset zeroaxis\n{}set key outside bottom center "
                "horizontal\nset xlabel \"{}\" noenhanced\n",
                // Lobes of reflection alone fill half of the picture.
                !t.rows.empty() && t.rows.front()[0] < -90. ? "" : "set yrange [0:*]\n", t.y_label);
            s += curves(t, "(${0}*sin($1*pi/180)):(${0}*cos($1*pi/180))");
            break;
        case PlotKind::image:
            s += fmt::format(
                "set xlabel \"{}\" noenhanced\nset ylabel \"{}\" noenhanced\n"
                "set cblabel \"{}\" noenhanced\nset size square\nset logscale cb\n"
                "set palette gray\nset autoscale fix\n"
                "plot $data using 1:2:($3 > 0 ? $3 : 1/0) with image notitle\n",
                t.columns[0], t.columns[1], t.y_label);
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
    draw(table, path,
         extension == ".svg"
             ? "set grid\nset terminal svg size 720,540 dynamic background rgb 'white'"
             : "set grid\nset terminal pngcairo size 1080,810 fontscale 1.4");
}

void draw_table(const Table& table, const fs::path& path) {
    // The scale is that of the vertical axis; every further mark would only make the file larger.
    draw(table, path,
         "set border 2\nunset xtics\nset ytics nomirror\n"
         "set terminal svg size 420,320 dynamic background rgb 'white'");
}

}  // namespace nacre::cli
