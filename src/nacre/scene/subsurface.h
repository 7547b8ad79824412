#pragma once
// How light below the surface of a shape is to be approximated: <subsurface> of a scene file, or
// `nacre render --technique`. docs/subsurface.md tells what the techniques do.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/scene/scene.h"

namespace nacre {

/// What a scene says: names, settings, places. Which there are is known to the list of techniques
/// (techniques/techniques.h), which checks them.
struct SubsurfaceSettings {
    std::string technique = "two_pass";
    std::string profile = "dipole";  ///< R(r); the type of the element
    struct Option {
        std::string name, value;
        std::string where = {};  ///< "file:line:column"; may be empty
    };
    std::vector<Option> options = {};
    std::string where = {};  ///< place of the element; may be empty
};

/// What a <subsurface> holds beside the options of techniques: the coefficients and the method.
std::span<const std::string_view> subsurface_parameters();

/// Whether a technique can take the shape for a translucent object: its boundary refracts, smooth
/// or rough, or is not there, and it has a homogeneous medium inside.
bool is_translucent(const ShapeBinding& shape);
/// The same with any medium inside, uneven ones included.
bool holds_translucent_medium(const ShapeBinding& shape);
/// Index inside over outside of a translucent shape; 1 if nothing refracts.
float boundary_eta(const ShapeBinding& shape);

}  // namespace nacre
