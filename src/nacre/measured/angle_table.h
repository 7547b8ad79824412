#pragma once
// Rows of four angles and values, as astm.cpp and csv.cpp read them between commas.
#include <memory>
#include <optional>

#include "nacre/measured/column_names.h"
#include "nacre/measured/scattered.h"
#include "nacre/text/lines.h"

namespace nacre {

struct AngleTable {
    MeasuredInfo info;  ///< format, description, parameterisation
    ColumnKind kind = ColumnKind::grey;
    bool degrees = true;
    std::array<std::string_view, 4> names;  ///< of the angles, in messages
    std::array<std::size_t, 4> column{0, 1, 2, 3};
    std::size_t first_value = 4;           ///< columns from here on are values
    std::optional<std::size_t> announced;  ///< how many rows a header promised
};

/// Reads the rows behind the header. Lines that begin with '#' are comments. theta of the exit may
/// go to 180 degrees: transmission. The surface is isotropic if all incidences have one azimuth. Rows
/// that make a full grid become one (angle_grid.h), others scattered samples (scattered.h).
/// Throws InputError by line.
std::unique_ptr<Measured> read_angle_rows(const MeasuredSource& source, LineSplitter& lines,
                                          AngleTable table);

}  // namespace nacre
