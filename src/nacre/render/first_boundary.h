#pragma once
// The first smooth boundary that a path meets, as the camera sees it: both ways are followed, since
// a mirror image of a lamp that one path in twenty finds is noise.
#include "nacre/math/lanes.h"

namespace nacre {

/// Follows the reflection as a path of its own, whose findings `path` gets, and leaves `path` with
/// what is refracted. `reflected` and `refracted` are the shares of both. `follow(reflection)` turns
/// the copy into the mirrored direction and follows it to its end. Of a path, `result_` (found),
/// `throughput_` and `split_reflection_` (to be put to the roulette: reflection_chance) are used.
template <class Path, class Follow>
void split_at_first_boundary(Path& path, float reflected, float refracted, Follow&& follow) {
    Path reflection(path);
    reflection.result_ = Spectral(0.f);
    reflection.throughput_ *= Spectral(reflected);
    reflection.split_reflection_ = true;
    follow(reflection);
    path.result_ += reflection.result_;
    path.throughput_ *= Spectral(refracted);
}

}  // namespace nacre
