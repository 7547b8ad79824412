#pragma once
// Lists as people write them.
#include <algorithm>
#include <string_view>
#include <vector>

namespace nacre {

/// The words between separators; empty ones are left out. They refer to `text`.
inline std::vector<std::string_view> split_words(std::string_view text,
                                                 std::string_view separators = ", \t\r\n") {
    std::vector<std::string_view> words;
    for (std::size_t i = text.find_first_not_of(separators); i != text.npos;
         i = text.find_first_not_of(separators, i)) {
        const std::size_t end = std::min(text.find_first_of(separators, i), text.size());
        words.push_back(text.substr(i, end - i));
        i = end;
    }
    return words;
}

}  // namespace nacre
