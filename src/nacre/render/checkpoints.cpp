#include "nacre/render/checkpoints.h"

#include <algorithm>
#include <chrono>

namespace nacre {

Checkpoints::Checkpoints(double interval_s, std::function<void()> work) {
    if (!(interval_s > 0)) return;
    // A year is for ever, and fits every clock.
    const std::chrono::duration<double> interval(std::min(interval_s, 3e7));
    thread_ = std::thread([this, interval, work = std::move(work)] {
        std::unique_lock lock(mutex_);
        while (!wake_.wait_for(lock, interval, [this] { return ended_; })) {
            lock.unlock();
            work();
            lock.lock();
        }
    });
}

Checkpoints::~Checkpoints() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

}  // namespace nacre
