#pragma once
// The viewer's window.
#include "apps/viewer/view.h"

namespace nacre::viewer {

/// Until it is closed. Throws RunError that says what is missing, and how to go on without a window.
void view_in_window(const ViewerScene& scene, const ViewOptions& options);

}  // namespace nacre::viewer
