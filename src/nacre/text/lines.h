#pragma once
// Text as lines and words, whoever wrote it: byte order marks, line ends of any system.
#include <cstddef>
#include <string_view>

namespace nacre {

/// Blanks between words; line ends are blanks, too.
constexpr bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Bytes of the UTF-8 byte order mark that `text` begins with: 3 or 0.
std::size_t byte_order_mark(std::string_view text);

/// Whether `text` begins with the byte order mark of UTF-16, which no reader here reads.
bool is_utf16(std::string_view text);

/// Goes through a text line by line. A line ends with LF, CR LF or CR, mixed as they come; a byte
/// order mark at the start is no part of the first one.
class LineSplitter {
  public:
    /// Begins at a byte of `text`; `line` lines came before it.
    explicit LineSplitter(std::string_view text, std::size_t offset = 0, std::size_t line = 0)
        : text_(text), offset_(offset ? offset : byte_order_mark(text)), line_(line) {}

    /// Goes to the next line and hands it over without its end; false behind the last one.
    bool next(std::string_view& line);
    /// Number of the current line, from 1.
    std::size_t line() const { return line_; }
    /// Where the next line begins.
    std::size_t offset() const { return offset_; }

  private:
    std::string_view text_;
    std::size_t offset_, line_;
    std::size_t newline_ = 0;  ///< the next LF, if it is not before offset_; kept for files of CR
};

/// Takes the next word off `line`; empty if there is none.
std::string_view take_word(std::string_view& line);

/// The line up to a comment, which begins with '#'; that of "1.#IND" and the like, as Windows
/// printed what is no number, begins none.
std::string_view without_comment(std::string_view line);

}  // namespace nacre
