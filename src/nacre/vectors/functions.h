#pragma once
// Groups of reference vectors that are no BRDFs of the list: scalar functions (Fresnel,
// distributions, masking, ...) and the illumination models 1-23.
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace nacre {

/// The values of one vector by their names in the file ("value" where there is one alone). Names
/// that are missing are not covered.
using VectorFunction = std::function<std::map<std::string, double>(const nlohmann::json& vector)>;

struct AnsweredGroup {
    std::string who;  ///< what answers, for the table
    VectorFunction answer;
    double tolerance = 1e-6;  ///< largest relative deviation, in double precision
};

/// Who answers the group of that name; empty if nothing does.
std::optional<AnsweredGroup> function_of_group(const std::string& name);

}  // namespace nacre
