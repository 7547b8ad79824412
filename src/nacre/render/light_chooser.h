#pragma once
// Choosing one light among many for next-event estimation.
#include <span>
#include <vector>

#include "nacre/scene/scene.h"

namespace nacre {

/// Chooses lights by the irradiance that they could bring to the point, were nothing in between and
/// everything facing: power over the squared distance to where the light is. A tenth of the choices
/// is uniform, so that no light is starved by a bad guess. The cost is linear in the number of
/// lights up to `max_ranked`; beyond that power alone decides.
class LightChooser {
  public:
    /// `skip_uniform`: leaves out uniform environments, for integrators whose paths go on and meet
    /// them by themselves; a sample of them would be a worse one in the place of a lamp's.
    LightChooser(std::span<const LightPtr> lights, const Box3f& scene_bounds,
                 bool skip_uniform = false);

    struct Choice {
        const Light* light = nullptr;
        float probability = 0.f;
    };
    /// `u` in [0, 1); light is null if the scene has none that shines.
    Choice choose(const Point3f& from, float u) const;
    /// Probability with which `choose` takes `light` for that point.
    float probability(const Point3f& from, const Light* light) const;

    static constexpr std::size_t max_ranked = 32;

  private:
    struct Entry {
        const Light* light;
        float at_infinity;  // irradiance of lights without a place
        Point3f center;
        float power, min_distance2;
        float by_power;  // probability when there are too many lights to rank
    };
    float importance(const Entry& entry, const Point3f& from) const;
    float total(const Point3f& from) const;
    float mixed(float importance, float total) const;

    std::vector<Entry> entries_;  // in the order of the scene: pictures must not hang on addresses
    std::vector<std::pair<const Light*, std::uint32_t>> places_;  // in it, sorted by address
};

}  // namespace nacre
