#pragma once
// What stands for a material that a peer does not have.
#include "nacre/scene/material.h"

namespace nacre {

/// Share of uniform light that a material reflects, in linear RGB, at texture coordinates (0.5,
/// 0.5); without what it lets through. From 4096 samples.
Vec3f mean_albedo(const Material& material);

}  // namespace nacre
