#pragma once
// A whole measurement, several incidences of one patch, as tables and as a file that can go on.
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "nacre/goniometer/measurement.h"

namespace nacre {

struct MeasurementSet {
    /// What was measured and how, in words: what must agree for it to go on.
    std::map<std::string, std::string> facts;
    std::vector<std::string> lanes;  ///< what the first lanes are: "r", "g", "b"; "550nm"
    std::vector<IncidenceMeasurement> incidences;
    bool complete = true;
};

/// The table that measured/csv.cpp reads: comments with the facts, a line of names, then one row an
/// incidence and bin: theta_i, phi_i, theta_o, phi_o of the middle of the bin, degrees (above 90:
/// light that came through), and the value of each lane, sr^-1; or, with `errors`, its standard
/// error. Incidences without rays are left out.
std::string csv_of(const MeasurementSet& set, bool errors = false);

/// The same of values that somebody else has of the bins: NaN is no measurement. `title` is the
/// first comment. Rows of transmitted light only where there is some, and `transmission`.
std::string csv_of(const MeasurementSet& set, const std::string& title,
                   const std::function<double(std::size_t incidence, bool below, std::size_t bin,
                                              int lane)>& value,
                   bool transmission = true);

/// JSON: facts, lanes, and for each incidence its angles, rays, shares of the light and the arrays
/// `brdf`, `brdf_error` (and `btdf`, `btdf_error` where light passes), bins by polar angle and then
/// azimuth, of each the lanes; and under `sums` what it takes to go on.
/// Of incidences without rays the angles alone.
std::string json_of(const MeasurementSet& set);

/// What json_of wrote; incidences without rays have no bins. Throws InputError "FILE: ..." for anything else.
MeasurementSet read_measurement(const std::filesystem::path& file);

/// Throws InputError that names the first fact in which `found`, of FILE, differs from what is asked
/// for.
void check_facts(const std::map<std::string, std::string>& found,
                 const std::map<std::string, std::string>& asked, const std::string& file);

}  // namespace nacre
