#pragma once
// Files that are read whole, files that appear whole or not at all, and the folders that they go
// into.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace nacre {

/// All bytes of a file, whatever they are. Nothing if it cannot be opened, is a folder or breaks off;
/// errno then says why.
std::optional<std::string> read_whole_file(const std::filesystem::path& file);

/// Writes beside the file, then renames: nobody sees half of it, and what was there before stays if
/// this fails. Throws RunError "FILE: cannot be written: why".
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

/// Throws InputError unless a file can be written there: its folder exists and may be written to,
/// and it is no folder itself. Better known before long work than after.
void check_output_file(const std::filesystem::path& file);

/// Makes the folder and those above it unless they are there, so that long work does not find out
/// at its end that its results have no place. Throws InputError "FOLDER: cannot be made: why" or
/// "FOLDER: cannot be written to: why".
void make_output_folder(const std::filesystem::path& folder);

}  // namespace nacre
