#pragma once
// Files of scattering reference vectors, {group: rows}: phase functions, Fresnel, diffusion
// profiles, layers, tissue, the diffusion equation. Every group has a function that goes over its rows and compares each
// number that the library can tell.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "nacre/vectors/check.h"

namespace nacre {

/// Deviations of a group; the worst is the largest over its tolerance.
class Comparison {
  public:
    explicit Comparison(Measure measure, double tolerance)
        : measure_(measure), tolerance_(tolerance) {}

    /// To the group's tolerance, or to one of its own.
    void add(const std::string& where, double value, const nlohmann::json& expected) {
        add(where, value, expected, tolerance_);
    }
    void add(const std::string& where, double value, const nlohmann::json& expected,
             double tolerance) {
        const double e = expected.get<double>();
        // Below 1e-30, which no quantity here is, stand zeros that are rounding.
        const double scale =
            measure_ == Measure::relative && std::abs(e) > 1e-30 ? std::abs(e) : 1.;
        put(where, std::abs(value - e) / scale, tolerance);
    }
    void add_estimate(const std::string& where, double value, double error,
                      const nlohmann::json& expected, double expected_error) {
        const double off = std::abs(value - expected.get<double>());
        put(where, off == 0. ? 0. : off / std::hypot(error, expected_error), tolerance_);
    }

    int count() const { return count_; }
    double deviation() const { return deviation_; }
    double tolerance() const { return worst_tolerance_; }  ///< of the worst
    bool good() const { return worst_ <= 1.; }
    const std::string& where() const { return where_; }

  private:
    void put(const std::string& where, double deviation, double tolerance) {
        ++count_;
        double ratio = deviation / tolerance;
        if (!std::isfinite(ratio)) ratio = std::numeric_limits<double>::infinity();
        if (ratio < worst_) return;
        worst_ = ratio;
        deviation_ = deviation;
        worst_tolerance_ = tolerance;
        where_ = where;
    }

    Measure measure_;
    double tolerance_;
    int count_ = 0;
    double worst_ = 0., deviation_ = 0., worst_tolerance_ = tolerance_;
    std::string where_;
};

/// Goes over a group. Throws nlohmann's exceptions for rows that are not as expected.
using CompareGroup = void (*)(const nlohmann::json& group, Comparison& result);

// The groups, by the rooms that answer them.
void compare_phase(const nlohmann::json& group, Comparison& result);
void compare_fresnel(const nlohmann::json& group, Comparison& result);
void compare_skin(const nlohmann::json& group, Comparison& result);
void compare_materials(const nlohmann::json& group, Comparison& result);
void compare_dipole(const nlohmann::json& group, Comparison& result);
void compare_better_dipole(const nlohmann::json& group, Comparison& result);
void compare_photon_beam(const nlohmann::json& group, Comparison& result);
void compare_directional_dipole(const nlohmann::json& group, Comparison& result);
void compare_normalised_diffusion(const nlohmann::json& group, Comparison& result);
void compare_chiang(const nlohmann::json& group, Comparison& result);
void compare_triangle(const nlohmann::json& group, Comparison& result);
void compare_kubelka_munk(const nlohmann::json& group, Comparison& result);
void compare_hanrahan_krueger(const nlohmann::json& group, Comparison& result);
void compare_slab(const nlohmann::json& group, Comparison& result);
void compare_half_space(const nlohmann::json& group, Comparison& result);
void compare_diffusion(const nlohmann::json& group, Comparison& result);
void compare_monte_carlo(const nlohmann::json& group, Comparison& result);
void compare_anchors(const nlohmann::json& group, Comparison& result);

/// Whether the file is one of scattering vectors: it has at least one of the groups' names.
bool is_scattering_file(const nlohmann::json& all);
/// Every group in the order of the file; `tell` gets each when it is done. `path` is for messages.
/// Throws InputError for a group that is not as expected.
VectorReport check_scattering(const nlohmann::json& all, const std::string& path,
                              const TellGroup& tell);

}  // namespace nacre
