#pragma once
// The viewer without a window: a script, frames, pictures.
#include "apps/viewer/view.h"

namespace nacre::viewer {

/// Runs the script, then `frames` frames, and writes the picture. Returns nothing that is not
/// written or said. Throws InputError before anything is rendered if a line of the script is wrong.
void view_headless(const ViewerScene& scene, const ViewOptions& options);

}  // namespace nacre::viewer
