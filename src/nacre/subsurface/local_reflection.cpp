#include "nacre/subsurface/local_reflection.h"

#include "nacre/technique/common_parameters.h"

namespace nacre {

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& local_reflection_technique() {
    static const TechniqueDescription description{
        .name = "brdf",
        .title = "local reflection",
        .authors = "J. H. Lambert",
        .year = 1760,
        .paper = "Photometria; with the total of a diffusion profile as albedo",
        .how = "all light leaves where it came in, through the same boundary",
        .precomputes = "the profile's total",
        .keeps = {.view = true, .light = true, .geometry = true},
        .parameters = {profile_parameter(), exit_fresnel_parameter()},
        .variants = "profile=dipole",
        .prepare = prepare_path_technique,
        .below = [](const ShapeInput& in) -> TranslucencyPtr {
            return std::make_shared<LocalReflection>(in.boundary, profile_tables(in),
                                                     exit_scale(in));
        }};
    return description;
}

}  // namespace nacre
