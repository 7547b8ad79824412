#pragma once
// A BRDF as matrix over pairs of directions.
#include <array>
#include <cstdint>
#include <vector>

#include "nacre/measured/factor/grid.h"
#include "nacre/measured/target.h"

namespace nacre {

struct FactorMatrix {
    FactorGrid grid;
    /// Red, green and blue, sr^-1, row by row; 0 where there is no value. Green and blue are empty
    /// if all three are the same.
    std::array<std::vector<double>, 3> values;
    /// 1 where there is a value, row by row; empty if there is one everywhere.
    std::vector<std::uint8_t> known;
    std::size_t below = 0;    ///< pairs with a direction below the horizon
    std::size_t missing = 0;  ///< others of which the target has no value

    std::size_t size() const { return std::size_t(grid.count()) * grid.count(); }
    int channels() const { return values[1].empty() ? 1 : 3; }
    bool has(std::size_t at) const { return known.empty() || known[at]; }
};

/// Asks the target for each pair once. Throws InputError: a side that is not from 2 to 64, a target
/// without a value, one without a value above 0, one with values that are not finite. Negative ones,
/// which measurements and colours outside sRGB have, stay as they are.
FactorMatrix sample_matrix(const Target& target, const FactorGrid& grid);

}  // namespace nacre
