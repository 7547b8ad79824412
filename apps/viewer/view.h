#pragma once
// `nacre view`: what the verb hands over.
#include <filesystem>
#include <functional>
#include <string>

#include "apps/viewer/viewer_state.h"

namespace nacre::viewer {

struct ViewOptions {
    std::filesystem::path screenshot;      ///< headless if it is given
    std::filesystem::path script;          ///< what is done first; empty: nothing
    int frames = 1;                        ///< in the picture of a screenshot
    int width = 512, height = 512;         ///< of the picture
    int light_view = 0, light_points = 0;  ///< 0: as usual
    double ui_scale = 0;                   ///< of letters and controls; 0: as the screen says
    std::string command_line, version;     ///< for the metadata of pictures
    std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// Opens a window, or none if a screenshot is asked for. Throws RunError where there is no display
/// or no OpenGL, InputError for wrong scripts and for what techniques refuse.
void view(const ViewerScene& scene, const ViewOptions& options);

/// Writes what is shown: .png as a screen shows it, other formats the radiance itself.
void write_screenshot(class ViewerFrames& frames, const ViewerState& state,
                      const ViewOptions& options, const std::filesystem::path& file);

}  // namespace nacre::viewer
