#pragma once
// Where results go must not be where they come from.
#include <filesystem>
#include <vector>

namespace nacre::cli {

/// Throws InputError if `output` is one of the files that are read, by whatever name.
void refuse_input_as_output(const std::filesystem::path& output,
                            const std::vector<std::filesystem::path>& inputs);

/// `file`, or with a number before its extension if there is one of that name already:
/// a.partial.exr, a.partial-2.exr.
std::filesystem::path unused_name(const std::filesystem::path& file);

}  // namespace nacre::cli
