#pragma once
// Something that is done again and again while others work.
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace nacre {

class Checkpoints {
  public:
    /// Does `work` on a thread of its own every `interval_s` seconds, counted from the end of the
    /// last one, until this goes out of scope; 0: never.
    Checkpoints(double interval_s, std::function<void()> work);
    /// Waits for work that has begun.
    ~Checkpoints();
    Checkpoints(const Checkpoints&) = delete;
    Checkpoints& operator=(const Checkpoints&) = delete;

  private:
    std::mutex mutex_;
    std::condition_variable wake_;
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace nacre
