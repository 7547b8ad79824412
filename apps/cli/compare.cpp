#include "apps/cli/compare.h"

#include <cstdlib>

#include "apps/cli/number_option.h"
#include "nacre/math/error.h"
#include "nacre/scene/content_key.h"
#include "nacre/text/split_words.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

double parse_share(const std::string& option, const std::string& text) {
    const bool percent = text.ends_with('%');
    const auto value = number_in(std::string_view(text).substr(0, text.size() - percent));
    const double share = value.value_or(0) / (percent ? 100 : 1);
    if (!(share >= 1e-6 && share <= 1))
        throw InputError(fmt::format(
            "{}: '{}' is not a share from 0.0001% to 100%; write 0.5% or 0.005", option, text));
    return share;
}

std::vector<int> parse_counts(const std::string& option, const std::string& text) {
    std::vector<int> counts;
    for (const std::string_view view : split_words(text)) {
        const std::string word(view);
        const auto n = whole_in(word);
        if (!n || *n < 1 || *n > most_samples)
            throw InputError(fmt::format(
                "{}: '{}' is not a number of samples from 1 to {}; write 16, or several as 4,16",
                option, word, most_samples));
        counts.push_back(int(*n));
    }
    if (counts.empty()) throw InputError(fmt::format("{}: no number is given", option));
    return counts;
}

std::filesystem::path reference_store(const CompareOptions& o) {
    if (!o.keep.empty()) return o.keep;
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return std::filesystem::path(cache) / "nacre" / "references";
    if (const char* home = std::getenv("HOME"); home && *home)
        return std::filesystem::path(home) / ".cache" / "nacre" / "references";
    return o.output / "references";
}

std::string build_id() {
    const std::string self = read_whole_file("/proc/self/exe").value_or("");
    return fmt::format("{} (build {:08x})", version, hash_bytes(self) >> 32);
}

void PartProgress::show(const ExperimentProgress& p) {
    line_.update([&] {
        const bool begins = p.part != now_.part;
        if (begins) start_ = std::chrono::steady_clock::now();
        now_ = p;
        const std::string note = p.note.empty() ? "" : (begins ? ": " : ", ") + p.note;
        if (begins)
            line_.print_whole(fmt::format("[{}/{}] {}{}", p.part, p.parts, p.what, note));
        else if (p.share >= 1 && !ended_)
            line_.print_whole("  " + format_seconds(seconds_since(start_)) + note);
        ended_ = p.share >= 1;
    });
}

std::string PartProgress::text(bool terminal) const {
    if (ended_) return "";
    const std::string share = format_share(now_.share, seconds_since(start_));
    const std::string note = now_.note.empty() ? "" : ", " + now_.note;
    if (!terminal) return "  " + share + note;
    constexpr int width = 24;
    const int filled = int(width * std::min(1., now_.share));
    return fmt::format("  [{}{}] {:<48}", std::string(filled, '#'),
                       std::string(width - filled, '.'), share + note);
}

}  // namespace nacre::cli
