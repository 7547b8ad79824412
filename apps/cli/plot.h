#pragma once
// Tables of numbers as CSV, and as pictures by gnuplot.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nacre::cli {

enum class PlotKind {
    curves,       ///< columns 2.. over column 1
    semilog,      ///< the same with a logarithmic ordinate of at most eight decades
    logarithmic,  ///< the same with both axes logarithmic
    polar,        ///< columns 2.. as radius over the angle (degrees from the normal) in column 1
    image,        ///< column 3 as colour (logarithmic) over columns 1 and 2
};

struct Table {
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
    PlotKind kind = PlotKind::curves;
    std::string y_label;
    /// Columns that hold standard errors, with the column they belong to (both from 0): drawn as
    /// bands of two standard errors about its line, not as curves of their own.
    std::map<std::size_t, std::size_t> errors = {};
    std::string x_label = {};              ///< else the name of the first column
    std::vector<std::string> names = {};   ///< of the columns in pictures, else as in the CSV
    std::vector<std::size_t> points = {};  ///< columns that are drawn as points: what was measured
    /// Of rows (areas of rings), by which pictures take noisy neighbours together; empty: all 1.
    std::vector<double> weights = {};
};

/// Throws InputError unless a table can be written there: before it is computed. Empty means print.
void check_table_output(const std::filesystem::path& path);

/// Writes the table to a .csv, or to a .svg or .png by gnuplot, with the table
/// beside it as NAME.svg.csv or NAME.png.csv; every file
/// appears whole or not at all. Throws as check_table_output, and RunError if a file cannot
/// be written or gnuplot is absent or fails. An empty path prints the CSV.
void write_table(const Table& table, const std::filesystem::path& path);
/// A small picture alone, .svg, as pages show it. Throws RunError as write_table does.
void draw_table(const Table& table, const std::filesystem::path& path);

}  // namespace nacre::cli
