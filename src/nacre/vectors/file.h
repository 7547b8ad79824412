#pragma once
// Vectors of reflectance files, {"models": {group: {"vectors": [{"id", "params", "wi", "wo",
// "value"}]}}}, put before the models.
#include <nlohmann/json.hpp>

#include "nacre/reflectance/registry.h"
#include "nacre/vectors/groups.h"

namespace nacre {

/// Parameters of a vector as settings: numbers and words as they are, nested lists and objects with
/// the names and positions joined by underscores ("lobes_0_C_2").
Settings settings_of(const nlohmann::json& parameters);

/// Who answers a group.
struct GroupModel {
    const Evaluator* evaluator = nullptr;
    const ReferenceGroup* group = nullptr;
};

/// The model that answers the group of that name; empty if none does.
GroupModel model_of_group(std::string_view name);

/// The model with the parameters of one vector, and those that the group adds.
AnyModel model_of_vector(const GroupModel& who, const nlohmann::json& parameters);

Vec3d direction_of(const nlohmann::json& v);

/// What a model says to a vector: its value, or the density of drawing wo for a given wi.
double answer(const GroupModel& who, const AnyModel& model, const Vec3d& wi, const Vec3d& wo);

/// |value - expected| over |expected|; values that must be zero have no tolerance.
double relative_deviation(double value, double expected);

}  // namespace nacre
