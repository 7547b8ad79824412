#pragma once
// Materials of generated patches: a reflectance model, or an ideal mirror.
#include <string_view>

#include "nacre/goniometer/microgeometry.h"
#include "nacre/goniometer/patch.h"

namespace nacre {

/// "mirror", which reflects everything, or a model with settings, "blinn_phong kd=0.2 ks=0.5 n=40",
/// the same everywhere and black from below; for these wavelengths only. Throws InputError as
/// find_evaluator and AnyModel do.
SurfaceBsdf surface_bsdf(std::string_view text, const Wavelengths& wavelengths);

/// A generated surface of one material.
Patch make_patch(Microgeometry geometry, SurfaceBsdf bsdf);

}  // namespace nacre
