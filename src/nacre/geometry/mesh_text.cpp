// Words and numbers of text formats.
#include <fmt/format.h>

#include "nacre/geometry/mesh_source.h"
#include "nacre/text/number.h"

namespace nacre {

TextLines::TextLines(const MeshSource& source, std::size_t offset, std::size_t line)
    : source_(source), lines_(source.bytes, offset, line) {
    if (offset == 0 && is_utf16(source.bytes))
        source.fail("is text in UTF-16, which is not read; save it as UTF-8 or ASCII");
}

bool TextLines::line_done() {
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
    return rest_.empty();
}

bool TextLines::next_line() {
    while (following_line())
        if (!line_done()) return true;
    return false;
}

bool TextLines::following_line() {
    rest_ = {};
    if (!lines_.next(rest_)) return false;
    rest_ = without_comment(rest_);
    return true;
}

std::string_view TextLines::word() { return take_word(rest_); }

std::string_view TextLines::any_word() {
    if (line_done() && !next_line()) return {};
    return word();
}

double TextLines::to_number(std::string_view word, const char* what) const {
    const auto value = parse_number(word);
    if (!value)
        source_.fail(line(),
                     word.empty()
                         ? fmt::format("{} is missing; the line is too short", what)
                         : fmt::format("'{}' stands where {} should be a number", word, what));
    return *value;
}

std::int64_t TextLines::to_integer(std::string_view word, const char* what) const {
    const auto value = parse_integer(word);
    if (!value)
        source_.fail(line(),
                     word.empty()
                         ? fmt::format("{} is missing; the line is too short", what)
                         : fmt::format("'{}' stands where {} should be an integer", word, what));
    return *value;
}

double TextLines::number(const char* what) { return to_number(word(), what); }

}  // namespace nacre
