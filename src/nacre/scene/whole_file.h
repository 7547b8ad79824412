#pragma once
// Files that appear whole or not at all, and the folders that they go into.
#include <filesystem>
#include <string_view>

namespace nacre {

/// Writes beside the file, then renames: nobody sees half of it, and what was there before stays if
/// this fails. Throws RunError "FILE: cannot be written: why".
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

/// Makes the folder and those above it unless they are there, so that long work does not find out
/// at its end that its results have no place. Throws InputError "FOLDER: cannot be made: why" or
/// "FOLDER: cannot be written to: why".
void make_output_folder(const std::filesystem::path& folder);

}  // namespace nacre
