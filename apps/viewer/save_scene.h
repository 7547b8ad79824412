#pragma once
// What the viewer shows, as a scene file that `nacre render` reads.
#include "apps/viewer/viewer_state.h"

namespace nacre::viewer {

struct SavedScene {
    std::vector<std::filesystem::path> files;  ///< the scene's first
    std::vector<std::string> left_out;         ///< what no scene file holds, a sentence each
};

/// Writes the scene as it is shown, `width` x `height` pixels: its matter by the technique of the
/// picture (of its left side), its camera, lights, form. Meshes that are in no file, or are bent,
/// go to files beside it, NAME_1.ply. Throws InputError for scenes that no file holds.
SavedScene save_scene(const ViewerScene& scene, const ViewerState& state, int width, int height,
                      const std::filesystem::path& file);

}  // namespace nacre::viewer
