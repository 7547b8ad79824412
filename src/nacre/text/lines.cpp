#include "nacre/text/lines.h"

#include <algorithm>

namespace nacre {

std::size_t byte_order_mark(std::string_view text) {
    return text.starts_with("\xef\xbb\xbf") ? 3 : 0;
}

bool is_utf16(std::string_view text) {
    return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}

bool LineSplitter::next(std::string_view& line) {
    if (offset_ >= text_.size()) return false;
    if (newline_ < offset_ || newline_ == 0)
        newline_ = std::min(text_.find('\n', offset_), text_.size());
    const std::size_t end = std::min(text_.substr(0, newline_).find('\r', offset_), newline_);
    line = text_.substr(offset_, end - offset_);
    // CR LF is one end.
    offset_ = end + 1 == newline_ && newline_ < text_.size() ? newline_ + 1
                                                             : std::min(end + 1, text_.size());
    ++line_;
    return true;
}

std::string_view take_word(std::string_view& line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    while (at != end && is_blank(*at)) ++at;
    const char* const begin = at;
    while (at != end && !is_blank(*at)) ++at;
    line = {at, static_cast<std::size_t>(end - at)};
    return {begin, static_cast<std::size_t>(at - begin)};
}

std::string_view without_comment(std::string_view line) {
    for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1)) {
        const std::string_view rest = line.substr(at + 1);
        if (at == 0 || line[at - 1] != '.' ||
            !(rest.starts_with("IN") || rest.starts_with("QNAN") || rest.starts_with("SNAN")))
            return line.substr(0, at);
    }
    return line;
}

}  // namespace nacre
