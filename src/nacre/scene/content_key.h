#pragma once
// A key for what a scene shows, so that a picture of it that took long can be found again.
#include <cstdint>
#include <string>
#include <string_view>

#include "nacre/scene/scene.h"

namespace nacre {

/// 16 hexadecimal digits that two scenes share only if nothing in them tells their true pictures
/// apart: objects and their parameters, the contents of their files, meshes, camera, film, colour
/// mode and the length of paths. How they are rendered (sampler, accelerations, which of the
/// integrators) is not part of it. A 64-bit hash: not proof against somebody who wants to be
/// fooled. Throws InputError for a scene without `root`, RunError if a file cannot be read.
std::string content_key(const Scene& scene);

/// The hash that keys are made of.
std::uint64_t hash_bytes(std::string_view bytes);

}  // namespace nacre
