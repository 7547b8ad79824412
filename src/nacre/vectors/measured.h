#pragma once
// Reference vectors of measured BRDFs: the groups "merl" (half-angle coordinates and places in a
// file) and "svd" (singular values of BRDFs as matrices), whose files have forms of their own.
#include "nacre/vectors/functions.h"

namespace nacre {

struct MeasuredVectors {
    std::string name;
    nlohmann::json vectors;  ///< {"vectors": [{"id", ..., "values"}]}, as the scalar groups
    AnsweredGroup answered;
};

/// Those of the two groups that a file has. Throws InputError if they are not as expected; `path`
/// is for messages.
std::vector<MeasuredVectors> measured_vectors(const nlohmann::json& all, const std::string& path);

}  // namespace nacre
