#pragma once
// How the media of make_medium get their coefficients, one way a file, and what they share. The
// medium's phase function is set before.
#include "nacre/scene/build.h"

namespace nacre {

/// The same everywhere, by whichever parameters they are given.
void set_homogeneous_coefficients(const SceneNode& node, Medium& medium);
/// Volumes, or the same everywhere.
void set_heterogeneous_coefficients(const SceneNode& node, Medium& medium, BuildContext& context);
/// Human skin.
void set_skin_coefficients(const SceneNode& node, Medium& medium);

/// Parameter `name` of `node` as a spectrum; throws for values outside the range of its role.
SpectrumPtr get_coefficient(const SceneNode& node, std::string_view name, ColorRole role,
                            float otherwise);
/// The same, or a <volume> of that name if it is a constvolume; null for other volumes.
SpectrumPtr get_uniform_coefficient(const SceneNode& node, std::string_view name, ColorRole role,
                                    float otherwise);

/// Sets extinction and albedo.
void set_scattering_and_absorption(Medium& medium, SpectrumPtr scattering, SpectrumPtr absorption);

}  // namespace nacre
