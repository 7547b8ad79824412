#pragma once
// What work that takes long looks at while it is at it: whether it should stop, and whom to tell
// how far it is.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string_view>

namespace nacre {

/// Ends work that was asked to stop before it had a result.
class Stopped : public std::runtime_error {
  public:
    Stopped() : std::runtime_error("stopped before there was a result") {}
};

/// Asked and told by any thread. One made without arguments never stops and tells nobody.
class Work {
  public:
    using Clock = std::chrono::steady_clock;
    /// The share of a phase that is done, in [0, 1]; called by one thread at a time, a few times a
    /// second. What it throws ends the work.
    using Tell = std::function<void(std::string_view phase, double share)>;

    Work() = default;
    Work(const std::atomic<bool>* stop, Clock::time_point deadline, Tell tell)
        : stop_(stop), deadline_(deadline), tell_(std::move(tell)) {}

    bool stopped() const {
        return (stop_ && stop_->load(std::memory_order_relaxed)) ||
               (deadline_ != Clock::time_point::max() && Clock::now() >= deadline_);
    }
    /// Throws Stopped if it should. Cheap: a flag, and a look at the clock if there is a deadline.
    void check() const {
        if (stopped()) throw Stopped();
    }

    void tell(std::string_view phase, double share) const {
        if (!tell_) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) return;
        const Clock::time_point now = Clock::now();
        if (now < next_) return;
        next_ = now + std::chrono::milliseconds(200);
        tell_(phase, share);
    }
    /// A phase begins: told whenever that is.
    void begin(std::string_view phase) const {
        check();
        if (!tell_) return;
        const std::lock_guard lock(mutex_);
        next_ = Clock::now() + std::chrono::milliseconds(200);
        tell_(phase, 0.);
    }
    bool tells() const { return bool(tell_); }

  private:
    const std::atomic<bool>* stop_ = nullptr;
    Clock::time_point deadline_ = Clock::time_point::max();
    Tell tell_;
    mutable std::mutex mutex_;
    mutable Clock::time_point next_{};
};

/// A phase of work that has `total` equal parts. `name` outlives it.
class WorkPhase {
  public:
    WorkPhase(const Work& work, std::string_view name, std::uint64_t total)
        : work_(work), name_(name), total_(total) {
        work_.begin(name_);
    }
    /// Some parts more are done; throws Stopped if the work should stop.
    void advance(std::uint64_t parts = 1) {
        work_.check();
        if (!work_.tells()) return;
        const std::uint64_t done = done_.fetch_add(parts, std::memory_order_relaxed) + parts;
        work_.tell(name_, total_ ? double(done) / double(total_) : 1.);
    }

  private:
    const Work& work_;
    std::string_view name_;
    std::uint64_t total_;
    std::atomic<std::uint64_t> done_{0};
};

}  // namespace nacre
