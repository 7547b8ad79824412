#pragma once
// Files of reference vectors against the library: those of reflectance ({"models": ...,
// "scalars": ...}) and those of scattering ({group: rows}).
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace nacre {

class Evaluator;

/// How deviations of a group are measured.
enum class Measure {
    relative,         ///< |value - expected| / |expected|
    absolute,         ///< |value - expected|
    standard_errors,  ///< |value - expected| over the combined standard error
};

struct VectorGroup {
    std::string name;
    std::string who = {};  ///< what answers it, of reflectance files
    int count = 0;         ///< numbers compared
    Measure measure = Measure::relative;
    double deviation = 0., tolerance = 0.;  ///< of the number that is worst
    bool good = false;
    std::string worst = {};  ///< where that is
};

struct VectorReport {
    std::vector<VectorGroup> groups;       ///< in the order of the file
    std::vector<std::string> not_covered;  ///< groups and values that nothing here answers

    bool good() const;  ///< no group is beyond its tolerance
};

/// Gets each group when it is done: some take seconds.
using TellGroup = std::function<void(const VectorGroup&)>;

/// Whether a parsed file holds reflectance or scattering vectors. Throws InputError if neither;
/// `path` is for messages, here and below.
enum class VectorFile { reflectance, scattering };
VectorFile kind_of_vectors(const nlohmann::json& all, const std::string& path);

/// Throws InputError for groups that are not as expected.
VectorReport check_vectors(const nlohmann::json& all, const std::string& path,
                           const TellGroup& tell = {});

/// The vectors that the library brings along (tests/reflectance/data/vectors.json), of one model:
/// to the tolerance of the group, 1e-9 at least.
std::vector<VectorGroup> check_built_in_vectors(const Evaluator& evaluator);

}  // namespace nacre
