#pragma once
// A key for what a scene shows, so that a picture of it that took long can be found again.
#include <cstdint>
#include <map>
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

/// Such keys of its parts, for who wants to say in what two scenes differ: "shape", "emitter",
/// "sensor" and whatever else stands in the scene's file, each with all that is in it; "integrator"
/// is how it is rendered there; "mesh" what came from no file; "scene" its own settings. Film and
/// sampler are in none.
std::map<std::string, std::string> content_keys_by_part(const Scene& scene);

/// The hash that keys are made of.
std::uint64_t hash_bytes(std::string_view bytes);

}  // namespace nacre
