#pragma once
// OpenGL for tests that need it.
#include <gtest/gtest.h>

#include "apps/viewer/viewer_frames.h"

namespace nacre::test {

/// A test with a context of its own, which is current; skipped where there is none.
class OnDevice : public testing::Test {
  protected:
    void SetUp() override {
        try {
            context_ = std::make_unique<HeadlessContext>();
        } catch (const std::runtime_error& error) {
            GTEST_SKIP() << error.what();
        }
        use_ = std::make_unique<HeadlessContext::Use>(*context_);
        gpu_ = std::make_unique<Gpu>();
    }
    void TearDown() override {
        gpu_.reset();
        use_.reset();
        context_.reset();
    }
    /// Little work a frame: what is asked is whether it is the right one.
    static viewer::ViewerState quick(viewer::ViewerState state) {
        state.quality.light_points = 1;
        state.quality.light_view = 64;
        return state;
    }
    /// `count` frames of a state by nobody who saw another before.
    Image frames_of(const viewer::ViewerScene& scene, const viewer::ViewerState& state, int width,
                    int height, int count = 1) {
        viewer::ViewerFrames frames(*gpu_, scene, viewer::Patience::all_samples);
        for (int i = 0; i < count; ++i) frames.render(state, width, height);
        return frames.image();
    }

    std::unique_ptr<HeadlessContext> context_;
    std::unique_ptr<HeadlessContext::Use> use_;
    std::unique_ptr<Gpu> gpu_;
};

/// The largest difference of two pictures, over the mean of the first; columns from `first` to
/// before `last`.
inline double difference(const Image& a, const Image& b, int first = 0, int last = 1 << 20) {
    if (a.width != b.width || a.height != b.height) return 1e30;
    double most = 0, sum = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = first; x < std::min(a.width, last); ++x)
            for (int c = 0; c < 3; ++c) {
                most = std::max(most, std::abs(double(a.at(x, y, c)) - double(b.at(x, y, c))));
                sum += double(a.at(x, y, c));
            }
    return most / (sum / double(a.data.size()));
}

}  // namespace nacre::test
