#pragma once
// Sample points: what numbers a path uses, keyed by seed, pixel and sample index.
#include <cstdint>
#include <string>

#include "nacre/math/random.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// The stream of numbers of one sample of one pixel. A value type, a few words large; cheap to
/// copy. `next1d` and `next2d` walk through well-distributed dimensions (stratified, Owen-scrambled
/// Sobol'); `random` is the counter-based stream for everything whose count is unbounded (free
/// paths of a random walk).
class Sampler {
  public:
    enum class Kind { independent, stratified, sobol };

    /// `samples` is the number of samples a pixel will get (strata); `pixel` any number that
    /// identifies it.
    Sampler(Kind kind, std::uint64_t seed, int samples);
    static Kind kind_from_name(const std::string& name);  ///< throws InputError for an unknown name

    void start(std::uint64_t pixel, std::uint32_t sample_index);
    float next1d();
    Vec2f next2d();
    Random& random() { return random_; }
    std::uint32_t sample_index() const { return index_; }

  private:
    Kind kind_;
    std::uint64_t seed_;
    int samples_;
    std::uint64_t pixel_key_ = 0;
    std::uint32_t index_ = 0;
    std::uint32_t dimension_ = 0;
    Random random_{0};
};

}  // namespace nacre
