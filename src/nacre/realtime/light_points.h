#pragma once
// Lights as frames see them: points and directions, each of which gets a picture of its own. What
// has extent (lamps, the sky) is several of them, others in each frame, so that frames average to
// the light.
#include <vector>

#include "nacre/scene/scene.h"

namespace nacre {

struct LightPoint {
    const Light* light = nullptr;
    bool parallel = false;
    Vec3f position = {};    ///< of parallel light the direction to it
    Vec3f normal = {};      ///< of a lamp's surface, whose light follows the cosine; 0: none
    Vec3f color = {};       ///< linear RGB: irradiance at the object's middle, facing the light
    float distance2 = 1.f;  ///< to the object's middle, squared; parallel: 1
};

/// The lights as they shine on the neighbourhood of `middle`: points and parallel lights as they
/// are, others as `points` places in all, by their power. `index` numbers frames: the places are
/// those of a sequence that fills lamps evenly.
std::vector<LightPoint> light_points(const Scene& scene, const Point3f& middle, int points,
                                     std::uint32_t index);

}  // namespace nacre
