#pragma once
// The coordinates of pairs of directions that ALTA's files name. Only for alta.cpp.
#include <span>

#include "nacre/measured/formats.h"
#include "nacre/measured/half_angle.h"

namespace nacre {

struct AltaCoordinates {
    std::string_view name;  ///< as #PARAM_IN has it
    int count;
    bool isotropic;
    const char* words;
    /// Light is wi, the view wo. Throws InputError for angles out of range, by line.
    DirectionPair (*directions)(const MeasuredSource& source, std::size_t line,
                                std::span<const double> x);
};

/// Throws InputError with the known names.
const AltaCoordinates& find_alta_coordinates(const MeasuredSource& source, std::string_view name);

}  // namespace nacre
