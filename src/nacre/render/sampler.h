#pragma once
// Sample points: what numbers a path uses, keyed by seed, pixel and sample index.
#include <cstdint>
#include <string>

#include "nacre/math/random.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// The stream of numbers of one sample of one pixel. A value type, a few words large; cheap to
/// copy. `next1d` and `next2d` walk through well-distributed dimensions; `random` is the
/// counter-based stream for everything whose count is unbounded (free paths of a random walk).
///
/// Every number is uniform in [0, 1) by itself; over the samples of a pixel
/// - independent: nothing more;
/// - stratified: next1d puts one sample into each of N intervals, next2d at most one into each cell
///   of a grid of at least N nearly square cells, in an order that is shuffled anew for each
///   dimension and pixel;
/// - sobol: every call is the first one or two dimensions of Sobol's sequence, scrambled by nested
///   uniform scrambling (Owen 1995) and shuffled anew for each call and pixel (Burley 2020,
///   Practical Hash-based Owen Scrambling, Journal of Computer Graphics Techniques 9(4)). Best with
///   a power of two of samples.
class Sampler {
  public:
    enum class Kind { independent, stratified, sobol };

    /// `samples` is the number of samples a pixel will get (strata), at least 1.
    Sampler(Kind kind, std::uint64_t seed, int samples);
    static Kind kind_from_name(const std::string& name);  ///< throws InputError for an unknown name

    /// `pixel` is any number that identifies the pixel.
    void start(std::uint64_t pixel, std::uint32_t sample_index);
    float next1d();
    Vec2f next2d();
    Random& random() { return random_; }
    std::uint32_t sample_index() const { return index_; }
    /// A number of the pixel's own, the same for all its samples.
    std::uint64_t pixel_key() const { return pixel_key_; }

  private:
    /// A number that is the same for all samples of the pixel and differs between calls.
    std::uint64_t next_key() { return mix_bits(pixel_key_ + 0x9e3779b97f4a7c15ull * ++call_); }

    Kind kind_;
    std::uint64_t seed_;
    std::uint32_t samples_, columns_, rows_;
    std::uint64_t pixel_key_ = 0;
    std::uint32_t index_ = 0;
    std::uint32_t call_ = 0;
    Random random_{0};
};

/// Where position i of 0..n-1 goes in a permutation chosen by `key`: the swap-or-not shuffle
/// (Hoang, Morris, Rogaway 2012, An Enciphering Scheme Based on a Card Shuffle, CRYPTO).
std::uint32_t permute(std::uint32_t i, std::uint32_t n, std::uint64_t key);

}  // namespace nacre
