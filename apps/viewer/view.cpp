#include "apps/viewer/view.h"

#include "apps/viewer/headless.h"
#include "apps/viewer/window.h"

namespace nacre::viewer {

void view(const ViewerScene& scene, const ViewOptions& options) {
    if (options.screenshot.empty())
        view_in_window(scene, options);
    else
        view_headless(scene, options);
}

}  // namespace nacre::viewer
