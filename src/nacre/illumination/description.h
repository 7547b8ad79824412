#pragma once
// What an illumination model says about itself: the scene reader, the command line and the
// documentation read it from here. The numbers 1-23 and the division into parts are those of
// A. Formella, D. Fellner 2004, Berechnungsmodelle (lecture notes, TU Braunschweig), which collect
// the models that computer graphics used before and beside the BRDF.
#include <limits>
#include <span>
#include <string_view>

namespace nacre::illumination {

inline constexpr double unlimited = std::numeric_limits<double>::infinity();

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

struct Parameter {
    enum class Kind {
        number,
        spectrum,  ///< may vary with wavelength
        choice,    ///< one of `choices`; its value is the position in them
    };
    std::string_view name, meaning;
    std::string_view unit = "";  ///< empty: a pure number
    double low = 0., high = unlimited;
    double otherwise = 0.;  ///< default
    Kind kind = Kind::number;
    bool low_excluded = false, high_excluded = false;
    std::span<const std::string_view> choices = {};
};

struct Description {
    int number;
    std::string_view name;   ///< as typed: lower case, words joined by underscores
    std::string_view title;  ///< as written
    std::string_view authors;
    int year;
    std::string_view source, formula;
    Part part;
    std::span<const Parameter> parameters;
    LightDistance light_distance = LightDistance::ignored;
    bool uses_viewer_distance = false;
    bool uses_light = true;  ///< I_L is in the formula
    /// Whether I / (I_L cos_i) is a BRDF: a function of the two directions alone.
    bool is_brdf = false;
    std::string_view properties;  ///< what it is if not a BRDF; reciprocity, energy
    std::string_view errata = "";
};

/// Parameters that several models share.
inline constexpr Parameter diffuse_coefficient = {.name = "kd",
                                                  .meaning = "diffuse reflection coefficient",
                                                  .high = 1.,
                                                  .otherwise = 1.,
                                                  .kind = Parameter::Kind::spectrum};
inline constexpr Parameter specular_coefficient = {.name = "ks",
                                                   .meaning = "specular reflection coefficient",
                                                   .high = 1.,
                                                   .otherwise = 1.,
                                                   .kind = Parameter::Kind::spectrum};
inline constexpr Parameter ambient_coefficient = {.name = "ka",
                                                  .meaning = "ambient reflection coefficient",
                                                  .high = 1.,
                                                  .otherwise = 1.,
                                                  .kind = Parameter::Kind::spectrum};
inline constexpr Parameter highlight_exponent = {
    .name = "m", .meaning = "exponent of the highlight; larger is narrower", .otherwise = 20.};
inline constexpr Parameter distance_constant = {.name = "dk",
                                                .meaning = "added to |V| against division by zero",
                                                .unit = "length",
                                                .otherwise = 1.,
                                                .low_excluded = true};
inline constexpr Parameter refractive_index = {.name = "n",
                                               .meaning = "index of refraction",
                                               .otherwise = 1.5,
                                               .kind = Parameter::Kind::spectrum,
                                               .low_excluded = true};

}  // namespace nacre::illumination
