#pragma once
// A picture by a technique that takes longer than a frame, refined by a thread of its own.
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "apps/viewer/viewer_state.h"
#include "nacre/render/frame_settings.h"

namespace nacre::viewer {

/// What is rendered: copies of all that the thread looks at.
struct BackgroundJob {
    std::shared_ptr<const Scene> scene;  ///< as it is shown, bent and turned
    TechniqueChoice technique;
    FrameSettings frame;  ///< but for the number of samples
    int samples = 0;      ///< a pixel; 0: until it is stopped
    int threads = 0;      ///< 0: all
};

class BackgroundRender {
  public:
    explicit BackgroundRender(BackgroundJob job);
    /// Stops it and waits for that.
    ~BackgroundRender();

    struct Picture {
        std::vector<float> rgba;  ///< of the crop window; alpha 1 where there are samples
        int samples = 0;          ///< that all pixels have
    };
    /// What came since the last call; false if nothing did. Throws what ended the render.
    bool take(Picture& picture);
    /// Waits until all samples are there, or the render ended otherwise.
    void wait();

  private:
    void run();
    void publish(const Film& film, int samples);

    BackgroundJob job_;
    std::atomic<bool> stop_{false};
    std::mutex mutex_;
    std::condition_variable changed_;
    Picture picture_;
    bool fresh_ = false, ended_ = false;
    std::exception_ptr error_;
    std::thread thread_;
};

}  // namespace nacre::viewer
