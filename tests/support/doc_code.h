#pragma once
// Code in the documentation that is code of the tree: a block of C++ whose first line is a comment
// with a file's name stands in that file, line by line, as it is written.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "nacre/text/whole_file.h"

namespace nacre::test {

struct DocCode {
    std::string file, code;
};

/// The blocks of a page that name a file, by a path from the root of the sources.
inline std::vector<DocCode> code_of(const std::string& page) {
    const std::string text = read_whole_file(fmt::format("{}/{}", NACRE_SOURCE_DIR, page)).value();
    const std::string open = "```cpp\n// ", close = "```";
    std::vector<DocCode> blocks;
    for (std::size_t at = text.find(open); at != text.npos; at = text.find(open, at)) {
        at += open.size();
        const std::size_t line = text.find('\n', at), end = text.find(close, at);
        blocks.push_back({text.substr(at, line - at), text.substr(line + 1, end - line - 1)});
    }
    return blocks;
}

/// Whether a block stands in its file.
inline bool stands_in_its_file(const DocCode& block) {
    const auto text = read_whole_file(fmt::format("{}/{}", NACRE_SOURCE_DIR, block.file));
    return text && !block.code.empty() && text->find(block.code) != text->npos;
}

}  // namespace nacre::test
