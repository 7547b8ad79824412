#pragma once
// Files named in a scene are looked for in its search path.
#include <filesystem>
#include <string>
#include <vector>

namespace nacre {

enum class FindWhat { file, file_or_folder };

/// The first existing `folder/name`; absolute names are taken as they are. Throws InputError
/// "PREFIX: cannot find 'name'; searched in: a, b" with `where` as prefix.
std::filesystem::path find_file(const std::string& name,
                                const std::vector<std::filesystem::path>& folders,
                                const std::string& where, FindWhat what = FindWhat::file);

/// A file is itself; of a folder its files, by name.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& path);

}  // namespace nacre
