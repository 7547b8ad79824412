#pragma once
// Numbers in the lines of text files, and what is said where there is none.
#include <vector>

#include "nacre/measured/formats.h"

namespace nacre {

/// The numbers of a line, between blanks or (`commas`) between commas, of which two in a row are
/// refused. NaN stands for what was not measured. Throws InputError "FILE, line N: 'x' is no
/// number" for other words and infinities.
void take_numbers(const MeasuredSource& source, std::size_t line, std::string_view text,
                  bool commas, std::vector<double>& numbers);

/// Words between commas, without blanks around them.
std::vector<std::string_view> comma_words(std::string_view text);

/// Throws unless theta lies in [0, limit] within a rounding of 1e-4 (radians), by its name; what
/// lies beyond for rounding comes back as the limit. `unit_hint` is said where degrees are likely.
double checked_theta(const MeasuredSource& source, std::size_t line, std::string_view name,
                     double theta, double limit);
/// Throws unless finite.
double checked_phi(const MeasuredSource& source, std::size_t line, std::string_view name,
                   double phi);

/// A unit vector by its polar angles, radians.
Vec3d polar_direction(double theta, double phi);
/// The angle to the normal, radians.
double theta_of(const Vec3d& w);

}  // namespace nacre
