#pragma once
// Which parameters of a model a fit varies, between which bounds and from where.
#include <string>
#include <vector>

#include "nacre/reflectance/registry.h"

namespace nacre {

/// Parameters that move together: one number, or three for a colour's bands.
struct Unknown {
    std::string name;             ///< what sets them all: "alpha" for alpha_u and alpha_v
    std::vector<int> parameters;  ///< positions
    bool colour = false;
    double low = 0., high = 0.;  ///< bounds of the fit, both ends included
    double start = 0.;
    int lobe = 0;  ///< of a sum, whose it is
};

/// Positions of the numbers of unknowns in the list that the solver sees: one for each band in a
/// row for a colour.
struct Layout {
    Layout(const std::vector<Unknown>& unknowns, int bands) {
        for (const Unknown& u : unknowns) {
            first.push_back(size);
            count.push_back(u.colour ? bands : 1);
            size += count.back();
        }
    }
    std::vector<int> first, count;
    int size = 0;
};

/// Colours and scalars that `given` does not set. Choices, whole numbers and wavelengths stay as
/// they are. A range that is open at its low end is closed a thousandth of the default above it.
/// Left at their defaults, too, unless given: Lafortune's second and third lobes and, if
/// `isotropic`, what only turns a surface anisotropic; parameters that share an alias (alpha_u,
/// alpha_v) are then one unknown. Throws InputError as find_parameters does.
std::vector<Unknown> plan_unknowns(const ModelDescription& model, const Settings& given,
                                   bool isotropic);

/// Where the fit starts: every combination of a quarter of, once and four times the scalars'
/// defaults (spread over the range, where that is 0), at most 27; beyond three scalars all move
/// together. Each entry has a value for every unknown.
std::vector<std::vector<double>> plan_starts(const std::vector<Unknown>& unknowns);

}  // namespace nacre
