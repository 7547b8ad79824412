#pragma once
// The Python job that builds and renders a scene in Blender. Used by the peer Cycles only.
#include <string_view>

namespace nacre {

/// Run as `blender -b --factory-startup -P job.py -- scene.json`; what scene.json holds is told in
/// the job itself.
std::string_view cycles_job();

}  // namespace nacre
