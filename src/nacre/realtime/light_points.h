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

/// What a light without extent gives in each direction.
struct LightShape {
    Vec3f peak = {};                  ///< linear RGB intensity where it is largest
    bool even = true;                 ///< the same in all directions
    std::vector<float> falloff = {};  ///< over the peak; columns the angle about y, rows from +y
    static constexpr int width = 1024, height = 512;
};
/// Of a point light or a spot.
LightShape shape_of(const Light& light);

/// The lights as they shine on the neighbourhood of `middle`: points and spots (without their color,
/// which shape_of knows) and parallel lights as they are, others as `points` places in all, by their power. `index` numbers frames: the places are
/// those of a sequence that fills lamps evenly.
std::vector<LightPoint> light_points(const Scene& scene, const Point3f& middle, int points,
                                     std::uint32_t index);

}  // namespace nacre
