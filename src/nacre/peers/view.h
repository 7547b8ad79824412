#pragma once
// A camera as other renderers describe it, found from its rays: whatever made it, with defaults and
// conventions already applied.
#include "nacre/geometry/transform.h"
#include "nacre/scene/camera.h"

namespace nacre {

struct PeerView {
    bool orthographic = false;
    Vec3d origin;                ///< middle of the lens, or of the film of parallel rays
    Vec3d right, up, forward;    ///< unit vectors as the picture shows them
    double half_width = 0;       ///< of the film: at distance 1, or in scene units if orthographic
    double half_height = 0;      ///< the same
    Vec2<double> shift;          ///< of the film's middle from the axis, in its widths and heights
    bool mirrored = false;       ///< right x up points ahead: the picture is a mirror image
    double near = 0, far = 0;    ///< along `forward`
    double aperture_radius = 0;  ///< 0: everything is sharp
    double focus_distance = 0;   ///< along `forward`
};

PeerView view_of(const Camera& camera);

}  // namespace nacre
