#include "apps/cli/progress_bar.h"

#include <unistd.h>

#include <cmath>

#include "apps/cli/streams.h"
#include "nacre/math/error.h"

namespace nacre::cli {
namespace {

using Seconds = std::chrono::duration<double>;

Seconds interval(bool terminal) { return Seconds(terminal ? 0.2 : 5.); }

}  // namespace

StatusLine::StatusLine(bool quiet, Text text, double first_after_s)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO)),
      text_(std::move(text)),
      next_(Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(first_after_s))) {
    if (quiet_) return;
    ticker_ = std::thread([this] {
        std::unique_lock lock(mutex_);
        while (!ends_.wait_for(lock, Seconds(0.5), [this] { return ended_; }))
            // What begins says so itself; before that there is nothing to tell for a while.
            if (Clock::now() >= next_ + Seconds(drawn_ ? 0. : 1.)) show(false);
    });
}

StatusLine::~StatusLine() {
    if (!ticker_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    ends_.notify_all();
    ticker_.join();
    if (terminal_ && drawn_) say_line("\n");
}

void StatusLine::show(bool last) {
    const Clock::time_point now = Clock::now();
    if (!last && now < next_) return;
    const std::string text = text_(terminal_);
    if (text.empty()) return;
    next_ = now + std::chrono::duration_cast<Clock::duration>(interval(terminal_));
    drawn_ = true;
    say_line(terminal_ ? "\r" + text : text + "\n");
}

void StatusLine::print_whole(const std::string& line) {
    if (quiet_) return;
    if (terminal_ && drawn_) say_line("\n");
    drawn_ = false;
    say_line(line + "\n");
    next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(interval(terminal_));
}

void ProgressBar::show(const RenderProgress& p) {
    line_.update([&] {
        phase_ = std::string(p.phase);
        share_ = p.share();
        seconds_ = p.seconds;
        heard_ = Clock::now();
    });
}

std::string ProgressBar::text(bool terminal) const {
    // Most of what is prepared is ready before anybody could read of it.
    if (!phase_.empty() && Clock::now() < start_ + Seconds(1.)) return "";
    const double seconds = seconds_ + Seconds(Clock::now() - heard_).count();
    // What was heard long ago tells nothing of what is left.
    const bool fresh = Clock::now() < heard_ + Seconds(3.);
    const std::string share =
        fresh ? format_share(share_, seconds)
              : fmt::format("{} %, {}", int(100 * share_), format_seconds(seconds));
    if (!terminal) return (phase_.empty() ? "" : phase_ + ": ") + share;
    constexpr int width = 40;
    const int filled = int(width * std::min(1., share_));
    return fmt::format("[{}{}] {:<26} {:<24}", std::string(filled, '#'),
                       std::string(width - filled, '.'), share, phase_);
}

PhotonProgress::PhotonProgress(bool quiet, std::string fewer)
    : fewer_(std::move(fewer)),
      bar_(quiet, 2.),
      work_(nullptr, Work::Clock::time_point::max(),
            [this](std::string_view, double share) { tell(share); }) {}

void PhotonProgress::tell(double share) {
    if (share < last_share_) start_ = Clock::now();  // the next simulation
    last_share_ = share;
    const double seconds = Seconds(Clock::now() - start_).count();
    constexpr double parts = 1e6, day = 86400.;
    bar_.show({std::uint64_t(parts * share), std::uint64_t(parts), seconds, "photons"});
    const double all = share > 0. ? seconds / share : 0.;
    if (seconds < 10. || all < day) return;
    throw InputError(fmt::format(
        "at this rate the photons take {:.3g} days: ask for fewer, by {}, for thinner layers or "
        "for "
        "more absorption; adding-doubling (nacre slab --method ad) takes no longer for such layers",
        all / day, fewer_));
}

std::string format_seconds(double seconds) {
    if (seconds < 60) return fmt::format("{:.1f} s", seconds);
    const long s = std::lround(seconds);
    if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string format_share(double share, double seconds) {
    const int percent = int(100 * share);
    if (share >= 1) return fmt::format("100 %, {}", format_seconds(seconds));
    // From a small share nothing can be told yet.
    if (share <= 0 || seconds < 0.5 || (share < 0.001 && seconds < 10))
        return fmt::format("{} %, {}", percent, format_seconds(seconds));
    return fmt::format("{} %, {} left", percent, format_seconds(seconds * (1 - share) / share));
}

}  // namespace nacre::cli
