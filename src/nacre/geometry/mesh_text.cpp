// Words and numbers of text formats.
#include <fmt/format.h>

#include <charconv>
#include <cstdlib>

#include "nacre/geometry/mesh_source.h"

namespace nacre {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

template <class T>
std::errc parse(std::string_view word, T& value) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return stop == end && !word.empty() ? error : std::errc::invalid_argument;
}

/// Where a comment begins. "1.#IND" and "1.#QNAN", as one family of programs spells what is no
/// number, are words: cut off there they would be the number 1.
std::size_t comment_of(std::string_view line) {
    std::size_t at = line.find('#');
    while (at != line.npos && at > 0 && line[at - 1] == '.') at = line.find('#', at + 1);
    return at;
}

}  // namespace

std::optional<double> number_in(std::string_view word) {
    double value = 0;
    const std::errc error = parse(word, value);
    // from_chars does not say which way the number is out of range.
    if (error == std::errc::result_out_of_range)
        return std::strtod(std::string(word).c_str(), nullptr);
    return error == std::errc{} ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> integer_in(std::string_view word) {
    std::int64_t value = 0;
    return parse(word, value) == std::errc{} ? std::optional(value) : std::nullopt;
}

std::size_t byte_order_mark(std::string_view text) {
    return text.starts_with("\xef\xbb\xbf") ? 3 : 0;
}

bool TextLines::line_done() {
    const std::size_t start = rest_.find_first_not_of(kBlank);
    rest_.remove_prefix(start == std::string_view::npos ? rest_.size() : start);
    return rest_.empty();
}

std::string_view TextLines::take_line() {
    const std::string_view text = source_.bytes;
    const std::size_t end = std::min(text.find_first_of("\r\n", offset_), text.size());
    const std::string_view line = text.substr(offset_, end - offset_);
    offset_ = std::min(end + (text.substr(end, 2) == "\r\n" ? 2 : 1), text.size());
    ++lines_read_;
    return line.substr(0, comment_of(line));
}

bool TextLines::next_line() {
    while (offset_ < source_.bytes.size()) {
        rest_ = take_line();
        line_ = lines_read_;
        if (!line_done()) return true;
    }
    rest_ = {};
    return false;
}

void TextLines::join_continued() {
    const auto continued = [](std::string_view line) {
        const std::size_t last = line.find_last_not_of(kBlank);
        return last != line.npos && line[last] == '\\' ? last : line.npos;
    };
    std::size_t backslash = continued(rest_);
    if (backslash == rest_.npos) return;
    std::string joined;
    for (std::string_view line = rest_;; line = take_line()) {
        backslash = continued(line);
        joined += line.substr(0, backslash);
        joined += ' ';
        if (backslash == line.npos || offset_ >= source_.bytes.size()) break;
    }
    joined_ = std::move(joined);
    rest_ = joined_;
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
    if (const auto value = number_in(word)) return *value;
    source_.fail(line_, word.empty()
                            ? fmt::format("{} is missing; the line is too short", what)
                            : fmt::format("'{}' stands where {} should be a number", word, what));
}

std::int64_t TextLines::to_integer(std::string_view word, const char* what) const {
    if (const auto value = integer_in(word)) return *value;
    source_.fail(line_, word.empty()
                            ? fmt::format("{} is missing; the line is too short", what)
                            : fmt::format("'{}' stands where {} should be an integer", word, what));
}

double TextLines::number(const char* what) { return to_number(word(), what); }

}  // namespace nacre
