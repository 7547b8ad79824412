#pragma once
// The window's controls, drawn from what techniques, media and lights say of themselves: what is
// new in their lists is there by itself.
#include <deque>

#include "apps/viewer/viewer_frames.h"

namespace nacre::viewer {

/// What the window is asked for besides changes of the state.
struct Requests {
    bool png = false, exr = false, save = false, quit = false;
};

/// What the controls show and the picture does not hang on.
struct ControlState {
    std::size_t light = 0;  ///< whose sliders are shown
    int resolution = 1;     ///< pixels of the screen a pixel of the picture, along each axis
    bool help = false, hidden = false, timings = true;
    std::string message;  ///< what was done or refused last
    bool is_error = false;
    std::string device;
    std::vector<PassTime> passes;  ///< of the last frame
    std::deque<float> frame_ms;    ///< of the last frames
    std::size_t bytes = 0;         ///< of the device
};

/// Draws the panel into the current ImGui window.
void draw_controls(const ViewerScene& scene, const ViewerFrames& frames, ViewerState& state,
                   ControlState& controls, Requests& requests);
/// The list of keys and of what the pointer does, over everything.
void draw_help(ControlState& controls, float scale);
/// Times of passes.
void draw_timings(const ControlState& controls);

}  // namespace nacre::viewer
