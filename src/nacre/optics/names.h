#pragma once
// Names that people type: compared without regard to case, spaces, dashes and underscores.
#include <span>
#include <string>
#include <string_view>

namespace nacre {

/// Lower case, with spaces, dashes and underscores removed.
std::string plain_name(std::string_view name);

/// The position of `name` in `known`, compared by `plain_name`, or -1.
int find_name(std::string_view name, std::span<const std::string_view> known);

/// The sentence to refuse an unknown name with: unknown <what> "<name>", the nearest known name if
/// it is near (Levenshtein distance at most a third of its length), and the list of all.
std::string unknown_name(std::string_view what, std::string_view name,
                         std::span<const std::string_view> known);

}  // namespace nacre
