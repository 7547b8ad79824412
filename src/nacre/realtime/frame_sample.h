#pragma once
// How the frames of an average differ: all who average frames draw alike, so that the same seed
// gives the same picture.
#include "nacre/math/random.h"
#include "nacre/render/filter.h"

namespace nacre {

/// Where frame `index` of an average samples its pixels.
inline FilterSample frame_sample(const Filter& filter, std::uint64_t seed, std::uint32_t index) {
    Random random(stream_key(seed, index));
    return filter.sample(random.next2());
}
/// FrameOptions::index of the first frame: other seeds begin elsewhere in the sequences.
inline std::uint32_t first_frame(std::uint64_t seed) {
    return std::uint32_t(stream_key(seed, 0x6672616dull) >> 44);
}

}  // namespace nacre
