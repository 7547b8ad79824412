#pragma once
// From what the viewer shows to its picture: frames of techniques in real time, averaged while
// nothing changes, and pictures of techniques that refine in the background.
#include <chrono>

#include "apps/viewer/background_render.h"
#include "nacre/image/image.h"
#include "nacre/realtime/frame_renderer.h"

namespace nacre::viewer {

/// How pictures of techniques offline are waited for.
enum class Patience {
    none,         ///< what there is so far: windows
    all_samples,  ///< ViewerState::samples: scripts
};

class ViewerFrames {
  public:
    /// Of the context that is current, as it is in all calls.
    ViewerFrames(Gpu& gpu, const ViewerScene& scene, Patience patience);
    ~ViewerFrames();

    /// Makes one frame more: linear RGB of width x height, rgba32f. What did not change since the
    /// last is kept. Throws InputError for what a technique refuses; then the next call begins anew.
    const Texture& render(const ViewerState& state, int width, int height);

    /// One side of the picture, for people.
    struct Side {
        std::string technique;
        int samples = 0;     ///< frames in the mean, or samples a pixel
        bool waits = false;  ///< nothing of it to be seen yet
    };
    const std::vector<Side>& sides() const { return sides_; }
    int first_width() const { return first_width_; }  ///< of the left side
    /// Whether another call would show something new while the state stays.
    bool goes_on() const;

    /// 8 bits of sRGB a channel as a screen shows it, with a line between two sides.
    const Texture& shown(const ViewerState& state);
    /// The picture as the last call left it.
    Image image() const;
    std::size_t bytes() const;

  private:
    struct Half;
    void make_scene(const ViewerState& state);
    void update_scene(const ViewerState& state, bool first);
    void show(Half& half, const ViewerState& state, const TechniqueChoice& choice, int column,
              int width);
    void show_realtime(Half& half, const ViewerState& state, const TechniqueChoice& choice,
                       int column);
    void show_background(Half& half, const ViewerState& state, const TechniqueChoice& choice,
                         int column);
    void add(const Texture& frame, int column, float share, float weight);
    std::shared_ptr<const Scene> shown_scene(const ViewerState& state);

    Gpu& gpu_;
    const ViewerScene& given_;
    Patience patience_;
    std::shared_ptr<Scene> scene_;        ///< at rest
    std::vector<LightPtr> built_lights_;  ///< which its shapes refer to, whatever shines now
    bool moving_lights_ = false;  ///< its lights are where the last edits put them, all else is not
    ViewerState last_;            ///< what was rendered
    bool has_last_ = false;
    std::unique_ptr<Half> halves_[2];
    std::vector<Side> sides_;
    int width_ = 0, height_ = 0, first_width_ = 0;
    float pixel_ = 0;
    bool parallel_ = false;
    std::chrono::steady_clock::time_point changed_;
    Texture picture_, shown_, scale_;
};

}  // namespace nacre::viewer
