#pragma once
// What columns of values mean by their names, as tables with a header of names have them.
#include <span>
#include <string_view>

#include "nacre/measured/formats.h"

namespace nacre {

enum class ColumnKind { grey, rgb, xyz, wavelengths };

/// "r","g","b" or "x","y","z" in either case, wavelengths ("400", "400nm"), or one column of any
/// other name. Fills info.channels and info.wavelengths. Throws InputError for anything else, and
/// for wavelengths that do not ascend.
ColumnKind take_columns(const MeasuredSource& source, std::size_t line,
                        std::span<const std::string_view> names, MeasuredInfo& info);

/// XYZ as linear red, green and blue in place; leaves other kinds alone.
void to_channels(ColumnKind kind, std::span<double> values);

}  // namespace nacre
