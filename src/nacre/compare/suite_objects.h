#pragma once
// The objects of the suite, each in a sphere of 30 mm about the origin, y up.
#include <memory>
#include <string_view>

#include "nacre/geometry/mesh.h"

namespace nacre {

/// ball, sheet, bowl, bust or slab; closed, with smooth normals, in mm.
std::shared_ptr<Mesh> make_suite_object(std::string_view name);

}  // namespace nacre
