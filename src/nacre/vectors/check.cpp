#include "nacre/vectors/check.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "nacre/math/error.h"
#include "nacre/vectors/file.h"
#include "nacre/vectors/functions.h"
#include "nacre/vectors/measured.h"
#include "nacre/vectors/scattering.h"

namespace nacre {

extern const char* const built_in_vectors;  // made by CMake

namespace {

using nlohmann::json;

/// Beyond this relative deviation, in double precision, an answer to a file of others is wrong.
constexpr double tolerance_of_files = 1e-6;

void put(VectorGroup& group, double deviation, const std::string& where) {
    if (!std::isfinite(deviation)) deviation = infinite;
    if (deviation >= group.deviation) {
        group.deviation = deviation;
        group.worst = where;
    }
    ++group.count;
}

void compare(const GroupModel& who, const json& vectors, VectorGroup& group) {
    for (const auto& v : vectors.at("vectors")) {
        const AnyModel model = model_of_vector(who, v.at("params"));
        const double value = answer(who, model, direction_of(v.at("wi")), direction_of(v.at("wo")));
        put(group, relative_deviation(value, v.at("value").get<double>()), v.value("id", ""));
    }
}

/// The same for functions; what they leave out of a vector's values is named in `omitted`.
void compare(const VectorFunction& answer, const json& vectors, VectorGroup& group,
             std::set<std::string>& omitted) {
    for (const auto& v : vectors.at("vectors")) {
        const auto values = answer(v);
        const json expected = v.contains("values") ? v["values"] : json{{"value", v.at("value")}};
        for (const auto& [name, number] : expected.items()) {
            const auto found = values.find(name);
            if (found == values.end()) {
                omitted.insert(name);
                continue;
            }
            double deviation = relative_deviation(found->second, number.get<double>());
            // A quotient of rounded sums that should vanish (total reflection, Brewster's angle).
            if (number.get<double>() == 0. && std::abs(found->second) < 1e-12) deviation = 0.;
            put(group, deviation, v.value("id", "") + " " + name);
        }
    }
}

VectorReport check_reflectance(const json& all, const std::string& path, const TellGroup& tell) {
    VectorReport report;
    const auto check = [&](const std::string& name, const json& vectors,
                           const std::optional<AnsweredGroup>& function) {
        const GroupModel who = model_of_group(name);
        if (!who.evaluator && !function) {
            report.not_covered.push_back(name);
            return;
        }
        VectorGroup group{
            .name = name,
            .who = who.evaluator ? std::string(who.evaluator->description().name) : function->who,
            .tolerance = tolerance_of_files};
        std::set<std::string> omitted;
        try {
            if (who.evaluator)
                compare(who, vectors, group);
            else
                compare(function->answer, vectors, group, omitted);
        } catch (const json::exception& error) {
            throw InputError(fmt::format("group '{}' of '{}': {}", name, path, error.what()));
        }
        group.good = group.deviation <= group.tolerance;
        for (const std::string& o : omitted) report.not_covered.push_back(name + "." + o);
        report.groups.push_back(std::move(group));
        if (tell) tell(report.groups.back());
    };
    for (const char* kind : {"models", "scalars"})
        if (all.contains(kind))
            for (const auto& [name, vectors] : all[kind].items())
                check(name, vectors, function_of_group(name));
    for (const MeasuredVectors& group : measured_vectors(all, path))
        check(group.name, group.vectors, group.answered);
    return report;
}

}  // namespace

bool VectorReport::good() const {
    return std::all_of(groups.begin(), groups.end(), [](const VectorGroup& g) { return g.good; });
}

VectorFile kind_of_vectors(const json& all, const std::string& path) {
    if (all.contains("models")) return VectorFile::reflectance;
    if (is_scattering_file(all)) return VectorFile::scattering;
    throw InputError(
        fmt::format("'{}' has neither \"models\", groups of reflectance vectors by name, nor a "
                    "known group of scattering vectors",
                    path));
}

VectorReport check_vectors(const json& all, const std::string& path, const TellGroup& tell) {
    return kind_of_vectors(all, path) == VectorFile::reflectance
               ? check_reflectance(all, path, tell)
               : check_scattering(all, path, tell);
}

std::vector<VectorGroup> check_built_in_vectors(const Evaluator& evaluator) {
    static const json vectors = json::parse(built_in_vectors);
    std::vector<VectorGroup> groups;
    for (const ReferenceGroup& g : groups_of(evaluator.description().name)) {
        if (!vectors["models"].contains(g.name)) continue;
        VectorGroup group{.name = std::string(g.name),
                          .who = std::string(evaluator.description().name),
                          .tolerance = std::max(g.tolerance, 1e-9)};
        compare({&evaluator, &g}, vectors["models"][group.name], group);
        group.good = group.deviation <= group.tolerance;
        groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace nacre
