#pragma once
// Light that a picture lacks because its integrator cannot find it (docs/integrators.md): said
// beforehand, since the picture looks plausible.
#include "nacre/techniques/techniques.h"

namespace nacre {

/// What a scene rendered by a plan cannot show: media, if its integrator does not follow light
/// through them and no technique stands for them; and point, spot and directional lights beyond a
/// smooth refracting boundary that it does not follow them through, or by way of a mirror. A
/// sentence each that says what to do; none if nothing is missing.
std::vector<std::string> missing_light(const Scene& scene, const RenderPlan& plan);
/// The same for complete simulation.
std::vector<std::string> missing_in_simulation(const Scene& scene);
/// The scene's warnings and those of `missing_light`: what whoever renders it shows.
std::vector<std::string> warnings_of(const Scene& scene, const RenderPlan& plan);

/// Throws InputError if complete simulation leaves the inside of an object dark that point, spot or
/// directional lights ought to light: its picture is then no truth to measure others against.
void require_lit_insides(const Scene& scene);

}  // namespace nacre
