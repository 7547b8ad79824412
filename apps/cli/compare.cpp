#include "apps/cli/compare.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "apps/cli/progress_bar.h"
#include "nacre/math/error.h"
#include "nacre/scene/content_key.h"
#include "nacre/scene/split_words.h"

namespace nacre::cli {

double parse_share(const std::string& option, const std::string& text) {
    double value = 0;
    char unit = 0, end = 0;
    const int n = std::sscanf(text.c_str(), "%lf%c%c", &value, &unit, &end);
    if (n < 1 || n > 2 || (n == 2 && unit != '%') || !(value > 0) || !std::isfinite(value))
        throw InputError(
            fmt::format("{}: '{}' is not a positive share; write 0.5% or 0.005", option, text));
    return n == 2 ? value / 100 : value;
}

std::vector<int> parse_counts(const std::string& option, const std::string& text) {
    std::vector<int> counts;
    for (const std::string_view view : split_words(text)) {
        const std::string word(view);
        int n = 0;
        char end = 0;
        if (std::sscanf(word.c_str(), "%d%c", &n, &end) != 1 || n < 1)
            throw InputError(fmt::format(
                "{}: '{}' is not a number of samples; write 16, or several as 4,16", option, word));
        counts.push_back(n);
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
    std::ifstream self("/proc/self/exe", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(self), {}};
    return fmt::format("{} (build {:08x})", version, hash_bytes(bytes) >> 32);
}

PartProgress::PartProgress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}

PartProgress::~PartProgress() { end_line(); }

void PartProgress::end_line() {
    if (open_) std::fputc('\n', stderr);
    open_ = false;
}

void PartProgress::show(const ExperimentProgress& p) {
    if (quiet_) return;
    const bool begins = p.part != part_;
    if (begins) {
        end_line();
        part_ = p.part;
        next_tenth_ = 1;
        start_ = std::chrono::steady_clock::now();
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const std::string time = p.share > 0.02 && p.share < 1
                                 ? format_seconds(seconds * (1 - p.share) / p.share) + " left"
                                 : format_seconds(seconds);
    const std::string label = fmt::format("[{}/{}] {}", p.part, p.parts, p.what);
    if (terminal_) {
        constexpr int width = 24;
        const int filled = int(width * std::min(1., p.share));
        fmt::print(stderr, "\r{:<56} [{}{}] {:3.0f} %  {:<12} {:<18}", label,
                   std::string(filled, '#'), std::string(width - filled, '.'), 100 * p.share, time,
                   p.note);
        std::fflush(stderr);
        open_ = true;
    } else if (begins) {
        fmt::print(stderr, "{}{}{}\n", label, p.note.empty() ? "" : ": ", p.note);
    } else if (p.share * 10 >= next_tenth_ && p.share < 1 && seconds > 10) {
        next_tenth_ = int(p.share * 10) + 1;
        fmt::print(stderr, "  {:.0f} %, {}{}{}\n", 100 * p.share, time, p.note.empty() ? "" : ", ",
                   p.note);
    } else if (p.share >= 1 && next_tenth_ <= 10) {
        next_tenth_ = 11;
        fmt::print(stderr, "  {}{}{}\n", time, p.note.empty() ? "" : ", ", p.note);
    }
}

}  // namespace nacre::cli
