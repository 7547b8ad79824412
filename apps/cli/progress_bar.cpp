#include "apps/cli/progress_bar.h"

#include <unistd.h>

#include <cstdio>

namespace nacre::cli {

ProgressBar::ProgressBar(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() {
    if (drawn_) std::fputc('\n', stderr);
}

void ProgressBar::show(const RenderProgress& p) {
    if (quiet_ || p.total == 0) return;
    const double share = static_cast<double>(p.done) / static_cast<double>(p.total);
    const int percent = static_cast<int>(100 * share);
    const std::string left =
        p.done == 0 ? "" : format_seconds(p.seconds * (1 - share) / share) + " left";
    if (terminal_) {
        constexpr int width = 40;
        const int filled = static_cast<int>(width * share);
        fmt::print(stderr, "\r[{}{}] {:3} %  {:<20}", std::string(filled, '#'),
                   std::string(width - filled, '.'), percent,
                   p.done == p.total ? format_seconds(p.seconds) : left);
        std::fflush(stderr);
        drawn_ = true;
    } else if (percent >= next_percent_ && p.done < p.total) {
        fmt::print(stderr, "{} %, {}\n", percent, left);
        next_percent_ = percent / 10 * 10 + 10;
    }
}

std::string format_seconds(double seconds) {
    if (seconds < 60) return fmt::format("{:.1f} s", seconds);
    const long s = std::lround(seconds);
    if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace nacre::cli
