#pragma once
// Counter-based random numbers: number i of stream `key` is a hash of (key, i), so that any pixel
// and sample can be drawn again by itself and a picture does not depend on which thread drew what.
#include <cstdint>

#include "nacre/math/vec.h"

namespace nacre {

/// Finaliser of MurmurHash3 with the constants of Stafford's variant 13, as used in SplitMix64: a
/// bijection of 64 bits in which every input bit changes every output bit with probability close to
/// 1/2.
constexpr std::uint64_t mix_bits(std::uint64_t v) {
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
    return v ^ (v >> 31);
}

/// Key of a stream from up to four numbers (seed, pixel, sample, purpose).
constexpr std::uint64_t stream_key(std::uint64_t a, std::uint64_t b, std::uint64_t c = 0,
                                   std::uint64_t d = 0) {
    std::uint64_t h = mix_bits(a + 0x9e3779b97f4a7c15ull);
    h = mix_bits(h ^ (b + 0x9e3779b97f4a7c15ull));
    h = mix_bits(h ^ (c + 0xd1b54a32d192ed03ull));
    return mix_bits(h ^ (d + 0x8cb92ba72f3d8dd7ull));
}

/// Uniform float in [0, 1) from the upper 24 bits of `bits`.
constexpr float to_unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// A stream of random numbers: SplitMix64 (Steele, Lea, Flood 2014), whose state is nothing but key
/// + i * constant.
class Random {
  public:
    explicit constexpr Random(std::uint64_t key) : counter_(key) {}

    constexpr std::uint64_t next_bits() {
        counter_ += 0x9e3779b97f4a7c15ull;
        return mix_bits(counter_);
    }
    /// Uniform in [0, 1).
    constexpr float next() { return static_cast<float>(next_bits() >> 40) * 0x1p-24f; }
    /// Two uniform numbers for the price of one.
    constexpr Vec2f next2() {
        const std::uint64_t b = next_bits();
        return {to_unit_float(static_cast<std::uint32_t>(b)),
                to_unit_float(static_cast<std::uint32_t>(b >> 32))};
    }

  private:
    std::uint64_t counter_;
};

}  // namespace nacre
