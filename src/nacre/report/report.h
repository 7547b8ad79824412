#pragma once
// The report of a comparison: one page that needs nothing but itself, and the same numbers as JSON.
//
// A report is a document (docs/report.md lists its keys): facts, columns, rows, charts, pictures.
// Whoever compares something makes one; the page (compare/page) shows what is there.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "nacre/image/image.h"

namespace nacre {

/// A picture for the page: {"width", "height", "encoding": "rgbe", "data"}. Colours with one
/// exponent for the three (Ward 1991, Real Pixels), as four planes, deflated, in base64. Within
/// 0.4 % of the largest of the three channels; what is negative or not a number is 0.
nlohmann::ordered_json rgbe_picture(const Image& image);
/// Values in [0, 1] of the first channel in bytes: {"encoding": "u8"}.
nlohmann::ordered_json byte_map(const Image& image);
/// Box-filtered so that neither side is above `side` pixels; as it is if it fits.
Image shrunk(const Image& image, int side);

/// A column of the table: of numbers, of which the lowest, those nearest to zero or none are best
/// ("low", "zero", "none"), or of words.
nlohmann::ordered_json number_column(const char* key, const char* title, const char* unit,
                                     int digits, const char* better, const char* help);
nlohmann::ordered_json text_column(const char* key, const char* title, const char* help);

/// Writes index.html and report.json (without the pictures) into the folder, which is made if need
/// be; each appears whole or not at all. Throws as write_whole_file and make_output_folder.
void write_report(const nlohmann::ordered_json& document, const std::filesystem::path& folder);

/// "2026-11-25 15:00 UTC".
std::string utc_now();

}  // namespace nacre
