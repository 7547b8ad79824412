#pragma once
// Measured reflectance as rows of angles and values, as text formats have it.
#include <functional>
#include <span>

#include "nacre/measured/angle_grid.h"
#include "nacre/measured/formats.h"

namespace nacre {

struct MeasuredRow {
    AngleRow angles;                ///< radians; of isotropic surfaces phi_i is 0
    std::span<const double> value;  ///< sr^-1; without meaning unless known
    bool known;
};

/// The data's own samples, or if they have none, more than 100,000, are RGL's or not to be used, a
/// grid in steps of options.step: theta from 0 to 89 degrees; isotropic phi_o from 0 to 180 degrees,
/// else phi_i and phi_o around, in steps of at least 15 degrees. Exits behind the surface are rows if
/// light goes through. Samples of light from behind, and those below the horizon that are missing,
/// are no rows.
void for_each_row(const Measured& data, const WriteOptions& options,
                  const std::function<void(const MeasuredRow&)>& visit);

/// Words that can stand in a comment of one line.
std::string one_line(std::string text);

}  // namespace nacre
