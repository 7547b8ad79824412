#pragma once
// What an illumination model says about itself: the scene reader, the command line and the
// documentation read it from here. The numbers 1-23 and the division into parts are those of
// A. Formella, D. Fellner 2004, Berechnungsmodelle (lecture notes, TU Braunschweig), which collect
// the models that computer graphics used before and beside the BRDF.
#include <string_view>
#include <vector>

#include "nacre/catalogue/parameter.h"

namespace nacre::illumination {

/// The terms that superpose to what the viewer sees, I = I_a + I_d + I_s, blended with what lies
/// behind by the transparency.
enum class Part { ambient, diffuse, specular, transparency };

/// How a model accounts for the distance |L| to the light, which decides what I_L is: see
/// light_convention.h.
enum class LightDistance {
    ignored,         ///< not in the formula
    inverse_square,  ///< by 1/|L|^2 or the solid angle of the light
    attenuated,      ///< by a free function of |L|
};

struct Description {
    int number;
    std::string_view name;                  ///< as typed: lower case, words joined by underscores
    std::vector<std::string_view> aliases;  ///< the number as it is typed
    std::string_view title;                 ///< as written
    std::string_view authors;
    int year;
    std::string_view source, formula;
    Part part;
    std::vector<Parameter> parameters;  ///< spectra and scalars are P and D of the struct
    LightDistance light_distance = LightDistance::ignored;
    bool uses_viewer_distance = false;
    bool uses_light = true;  ///< I_L is in the formula
    /// Whether I / (I_L cos_i) is a BRDF: a function of the two directions alone.
    bool is_brdf = false;
    std::string_view properties;  ///< what it is if not a BRDF; reciprocity, energy
    std::string_view errata = "";
};

/// Parameters that several models share.
inline Parameter diffuse_coefficient() {
    return {.name = "kd",
            .meaning = "diffuse reflection coefficient",
            .kind = ParameterKind::spectrum,
            .high = 1.,
            .otherwise = 1.};
}
inline Parameter specular_coefficient() {
    return {.name = "ks",
            .meaning = "specular reflection coefficient",
            .kind = ParameterKind::spectrum,
            .high = 1.,
            .otherwise = 1.};
}
inline Parameter ambient_coefficient() {
    return {.name = "ka",
            .meaning = "ambient reflection coefficient",
            .kind = ParameterKind::spectrum,
            .high = 1.,
            .otherwise = 1.};
}
inline Parameter highlight_exponent() {
    return {.name = "m",
            .meaning = "exponent of the highlight; larger is narrower",
            .high = infinite,
            .otherwise = 20.};
}
inline Parameter distance_constant() {
    return {.name = "dk",
            .meaning = "added to |V| against division by zero",
            .unit = "length",
            .high = infinite,
            .above_low = true,
            .otherwise = 1.};
}
inline Parameter refractive_index() {
    return {.name = "n",
            .meaning = "index of refraction",
            .kind = ParameterKind::spectrum,
            .high = infinite,
            .above_low = true,
            .otherwise = 1.5};
}

}  // namespace nacre::illumination
