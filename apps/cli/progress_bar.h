#pragma once
// How far long work is, on standard error: a line that is drawn anew on a terminal, otherwise a
// line every five seconds. Also where nothing is heard of the work for a while.
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "nacre/math/work.h"
#include "nacre/render/render.h"

namespace nacre::cli {

class StatusLine {
  public:
    /// What to say now; may be empty. Called with the line's own lock held.
    using Text = std::function<std::string(bool terminal)>;

    /// `first_after_s`: what ends sooner shows nothing.
    StatusLine(bool quiet, Text text, double first_after_s = 0);
    /// Ends the line on a terminal.
    ~StatusLine();
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;

    /// Changes what `text` tells, by `change`, and shows it if it is time to.
    template <class Change>
    void update(Change&& change) {
        const std::lock_guard lock(mutex_);
        change();
        if (!quiet_) show(false);
    }
    /// Ends the drawn line and prints this one. Called with the lock held, from `change`.
    void print_whole(const std::string& line);
    bool terminal() const { return terminal_; }

  private:
    using Clock = std::chrono::steady_clock;
    void show(bool last);

    bool quiet_, terminal_;
    Text text_;
    std::mutex mutex_;
    std::condition_variable ends_;
    bool ended_ = false, drawn_ = false;
    Clock::time_point next_;
    std::thread ticker_;
};

/// Of a render.
class ProgressBar {
  public:
    explicit ProgressBar(bool quiet, double first_after_s = 0)
        : line_(
              quiet, [this](bool terminal) { return text(terminal); }, first_after_s) {}
    void show(const RenderProgress& progress);

  private:
    std::string text(bool terminal) const;

    using Clock = std::chrono::steady_clock;
    std::string phase_ = "preparing";
    double share_ = 0, seconds_ = 0;  ///< of that phase, when it was last heard of
    const Clock::time_point start_ = Clock::now();
    Clock::time_point heard_ = start_;
    StatusLine line_;  ///< last: its thread uses the others
};

/// Of Monte Carlo simulation of layers.
class PhotonProgress {
  public:
    /// `fewer` says how to ask for fewer photons: "--photons".
    PhotonProgress(bool quiet, std::string fewer);
    /// Its progress is shown; work that would take more than a day ends, after some seconds, in
    /// InputError that says what to change.
    const Work& work() const { return work_; }

  private:
    void tell(double share);

    using Clock = std::chrono::steady_clock;
    std::string fewer_;
    double last_share_ = 0;
    Clock::time_point start_ = Clock::now();
    ProgressBar bar_;
    Work work_;
};

/// "1:02:03", "2:03", "3.4 s".
std::string format_seconds(double seconds);
/// "34 %, 12.0 s left", or the time so far where there is no telling.
std::string format_share(double share, double seconds);

}  // namespace nacre::cli
