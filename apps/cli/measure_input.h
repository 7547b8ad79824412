#pragma once
// What `nacre measure` is given: a scene file, or generated microgeometry and its material.
#include <map>
#include <string>
#include <vector>

#include "nacre/goniometer/patch.h"

namespace CLI {
class App;
}

namespace nacre::cli {

struct MeasureInput {
    std::string surface;   ///< .xml, or "v_grooves angle=30"
    std::string material;  ///< of generated surfaces
    std::vector<std::string> defines;
    std::vector<std::string> tile;  ///< x, y, width, height of the period of a scene
    std::optional<double> nm;
};

struct MeasuredPatch {
    Patch patch;
    Wavelengths wavelengths;
    std::vector<std::string> lanes;  ///< the names of those that count
    std::map<std::string, std::string> facts;
};

void add_measure_input(CLI::App& app, MeasureInput& input);

/// Throws InputError for what is no surface, for scenes with media that vary in space, and for
/// options that do not belong together.
MeasuredPatch load_patch(const MeasureInput& input);

}  // namespace nacre::cli
