// Words and numbers of text formats.
#include <fmt/format.h>

#include <charconv>

#include "nacre/geometry/mesh_source.h"

namespace nacre {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

template <class T>
bool parse(std::string_view word, T& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return stop == end && !word.empty() && error == std::errc{};
}

}  // namespace

bool TextLines::line_done() {
    const std::size_t start = rest_.find_first_not_of(kBlank);
    rest_.remove_prefix(start == std::string_view::npos ? rest_.size() : start);
    return rest_.empty();
}

bool TextLines::next_line() {
    const std::string_view text = source_.bytes;
    while (offset_ < text.size()) {
        const std::size_t end = std::min(text.find('\n', offset_), text.size());
        rest_ = text.substr(offset_, end - offset_);
        rest_ = rest_.substr(0, rest_.find('#'));
        offset_ = std::min(end + 1, text.size());
        ++line_;
        if (!line_done()) return true;
    }
    rest_ = {};
    return false;
}

std::string_view TextLines::word() {
    if (line_done()) return {};
    const std::string_view found = rest_.substr(0, rest_.find_first_of(kBlank));
    rest_.remove_prefix(found.size());
    return found;
}

std::string_view TextLines::any_word() {
    if (line_done() && !next_line()) return {};
    return word();
}

double TextLines::to_number(std::string_view word, const char* what) const {
    double value = 0;
    if (!parse(word, value))
        source_.fail(line_, word.empty() ? fmt::format("{} is missing; the line is too short", what)
                                         : fmt::format("'{}' stands where {} should be a number",
                                                       word, what));
    return value;
}

std::int64_t TextLines::to_integer(std::string_view word, const char* what) const {
    std::int64_t value = 0;
    if (!parse(word, value))
        source_.fail(line_, word.empty() ? fmt::format("{} is missing; the line is too short", what)
                                         : fmt::format("'{}' stands where {} should be an integer",
                                                       word, what));
    return value;
}

double TextLines::number(const char* what) { return to_number(word(), what); }

}  // namespace nacre
