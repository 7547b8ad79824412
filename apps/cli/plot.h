#pragma once
// Tables of numbers as CSV, and as pictures by gnuplot.
#include <filesystem>
#include <string>
#include <vector>

namespace nacre::cli {

enum class PlotKind {
    curves,  ///< columns 2.. over column 1
    polar,   ///< columns 2.. as radius over the angle (degrees from the normal) in column 1
    image,   ///< column 3 as colour (logarithmic) over columns 1 and 2
};

struct Table {
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
    PlotKind kind = PlotKind::curves;
    std::string y_label;
};

/// Writes the table to a .csv, or to a .svg or .png by gnuplot, with the .csv beside it; every file
/// appears whole or not at all. Throws InputError for another extension, RunError if a file cannot
/// be written or gnuplot is absent or fails. An empty path prints the CSV.
void write_table(const Table& table, const std::filesystem::path& path);
/// A small picture alone, .svg, as pages show it. Throws RunError as write_table does.
void draw_table(const Table& table, const std::filesystem::path& path);
/// Writes a text file, whole or not at all. Throws RunError.
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace nacre::cli
