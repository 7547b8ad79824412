#pragma once
// Cameras: from a point of the film to a ray.
#include <memory>

#include "nacre/geometry/ray_scene.h"

namespace nacre {

class Camera {
  public:
    virtual ~Camera() = default;
    /// The ray through `film` in [0,1]^2 (x to the right, y down, of the full film, not the crop
    /// window); `lens` in [0,1)^2 chooses the point of the aperture. tmin and tmax are the clipping
    /// planes.
    virtual Ray ray(Vec2f film, Vec2f lens) const = 0;
};
using CameraPtr = std::shared_ptr<const Camera>;

}  // namespace nacre
