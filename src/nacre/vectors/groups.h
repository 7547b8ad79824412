#pragma once
// Which groups of the reference vectors each reflectance model answers, and how the parameters of
// the vectors become the model's.
#include <span>
#include <string_view>
#include <vector>

#include "nacre/catalogue/settings.h"

namespace nacre {

/// A group of the reference vectors that a model answers.
struct ReferenceGroup {
    std::string_view name;           ///< as in the file
    std::string_view settings = "";  ///< beside those of the vector; they win over it
    bool pdf = false;  ///< the group holds densities: of wo, for a given wi, instead of values
    /// Parameters of the vectors that mean nothing here, such as tags of the formula.
    std::vector<std::string_view> ignored = {};
    /// What names alone cannot say: rewrites the settings of a vector (nested lists are flattened,
    /// "lobes_0_C_2") to the parameters of the model.
    void (*adapt)(Settings& settings) = nullptr;
    double tolerance = 1e-9;    ///< relative, in double precision; what the file states
    bool albedos_only = false;  ///< a name of the file's table of albedos, without vectors
};

/// What the model of that name answers; empty if nothing.
std::span<const ReferenceGroup> groups_of(std::string_view model);

}  // namespace nacre
