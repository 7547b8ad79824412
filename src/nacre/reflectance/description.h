#pragma once
// What a model says of itself: the manual page from which the scene reader, the command line, the
// checks and the documentation are driven. Plain data, given once, in the model's own file.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nacre/catalogue/parameter.h"

namespace nacre {

/// A sum of spectra that must not exceed 1, lest energy appear from nowhere.
struct SumBound {
    std::vector<std::string_view> parameters;
};

enum class Energy {
    conserves,  ///< the albedo is at most 1 for every direction and all allowed parameters
    exceeds,    ///< somewhere the albedo is above 1
};

/// Of what values of a parameter a claim speaks, where not of all that are allowed.
struct Condition {
    std::string_view parameter;
    double low = 0., high = 1.;                  ///< within these, ends included
    std::string_view same_as = "";               ///< or as large as this other parameter
    std::vector<std::string_view> choices = {};  ///< of a choice: one of these
};

/// Numbers of a model's parameters by name, of a choice its position.
using NamedNumbers = std::vector<std::pair<std::string_view, double>>;

/// A condition that ties several parameters, in words and as what a check does to drawn ones.
struct JointCondition {
    std::string_view text = "";  ///< empty: none
    void (*bring_within)(NamedNumbers& numbers) = nullptr;
};

/// How the model behaves with given options, as claims that the checks put to the test.
struct Behaviour {
    std::string_view options = "";  ///< settings that choose it, "variant=classic"; empty: always
    bool reciprocal = true;
    Energy energy = Energy::conserves;
    std::string_view energy_note = "";  ///< for which parameters, how far
    /// exceeds: settings, and the angle of incidence in degrees, at which the albedo is above 1.
    std::string_view witness = "";
    double witness_degrees = 0.;
    double at_most = 0.;                     ///< exceeds: no albedo is above this; 0: not said
    std::vector<Condition> conditions = {};  ///< of which parameters the claims speak; empty: all
    JointCondition joint = {};
    /// Settings (beside the options) at which the checks look; at least one.
    std::vector<std::string_view> examples = {};
};

struct ModelDescription {
    std::string_view name;   ///< in scene files and on the command line: lower case, underscores
    std::string_view title;  ///< as the field says
    std::string_view authors;
    int year = 0;
    std::string_view paper;      ///< title, where it appeared
    std::string_view equations;  ///< numbers in the paper
    std::string_view formula;    ///< as text, one line a string line
    std::vector<Parameter> parameters;
    std::vector<SumBound> bounds = {};
    std::vector<Behaviour> behaviours;
    std::string_view isotropy = "isotropic";
    std::string_view sampling;
    std::string_view albedo = "";               ///< what is known in closed form
    std::vector<std::string_view> errata = {};  ///< of the literature, and what is done about them
    std::vector<std::string_view> references = {};
};

/// The conditions of a claim in words, "sigma up to 0.3, alpha_v = alpha_u"; empty: none.
std::string condition_text(const Behaviour& behaviour);
/// Options and conditions, "variant=full, for sigma up to 0.3"; empty: always.
std::string claim_text(const Behaviour& behaviour);

// The parameters that many models share.

/// Diffuse albedo.
inline Parameter diffuse_parameter(double otherwise) {
    return {.name = "kd",
            .meaning = "diffuse albedo",
            .kind = ParameterKind::spectrum,
            .otherwise = otherwise,
            .aliases = {"diffuse_reflectance", "diffuseReflectance"}};
}
/// Weight of the highlight.
inline Parameter specular_parameter(double otherwise) {
    return {.name = "ks",
            .meaning = "weight of the highlight",
            .kind = ParameterKind::spectrum,
            .otherwise = otherwise,
            .aliases = {"specular_reflectance", "specularReflectance"}};
}

}  // namespace nacre
