#pragma once
// The project's own scenes for comparing techniques: five objects, two albedos, matter that is the
// same everywhere or veined, and light from three sides. Chapter 7 of the seed thesis could only
// quote such numbers from papers, each on another object and machine.
#include <string>
#include <string_view>
#include <vector>

#include "nacre/scene/scene.h"

namespace nacre {

/// One scene of the suite, by its words.
struct SuiteCase {
    std::string object;  ///< ball, sheet, bowl, bust, slab
    std::string albedo;  ///< high, low
    std::string matter;  ///< homogeneous, veined
    std::string light;   ///< front, side, back

    /// "ball high homogeneous front"
    std::string id() const;
    /// For people: "thick: a ball of 50 mm".
    std::vector<std::string> labels() const;
};

/// All 60 cases, or those that `filter` names: "ball,bust,front" are the ball and the bust in front
/// light, in all matters. Throws InputError for a word that no case has.
std::vector<SuiteCase> suite_cases(std::string_view filter = "");

/// The scene of a case: the object alone in dim surroundings, lit by a shining ball. Lengths are
/// millimetres.
///
/// The matter scatters isotropically: `high` is the measured marble (Jensen et al. 2001), `low` has
/// reduced albedos of 0.91, 0.80 and 0.67. Homogeneous matter has a smooth boundary of index 1.5.
/// Veined matter is a quarter as dense, its density changes by 1:10 between veins and ground, and
/// it has no boundary: lamps are not sampled through refracting boundaries of matter that is not
/// the same everywhere, and the reference would take hours. `even` replaces it by matter of its
/// mean density, which is what a technique for homogeneous matter can take for it.
Scene make_suite_scene(const SuiteCase& which, int width, int height, bool even = false);

}  // namespace nacre
