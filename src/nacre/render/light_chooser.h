#pragma once
// Choosing one light among many for next-event estimation.
#include <span>
#include <vector>

#include "nacre/scene/scene.h"

namespace nacre {

/// Chooses lights with probability half uniform, half in proportion to their power: no light is
/// starved, and a scene with one strong light wastes few samples on the weak ones.
class LightChooser {
  public:
    explicit LightChooser(std::span<const LightPtr> lights);

    struct Choice {
        const Light* light = nullptr;
        float probability = 0.f;
    };
    /// `u` in [0, 1); light is null if the scene has none.
    Choice choose(float u) const;
    float probability(const Light* light) const;
    bool empty() const { return choices_.empty(); }

  private:
    std::vector<Choice> choices_;     // in the order of the scene's lights
    std::vector<float> cumulative_;   // running sum of probabilities
    std::vector<Choice> by_address_;  // sorted by pointer, for `probability`
};

}  // namespace nacre
