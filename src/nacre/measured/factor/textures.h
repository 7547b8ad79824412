#pragma once
// Factored BRDFs in files: a folder with two EXR pictures of R x R pixels a term, g01.exr and
// h01.exr, g02.exr, ... in red, green and blue, 32-bit numbers of either sign. phi goes with x and
// theta with y, from the top left (grid.h). What the numbers mean stands in each file's metadata, so
// that the folder can be read again.
#include <filesystem>

#include "nacre/measured/factor/brdf.h"

namespace nacre {

/// Writes the terms; files of further terms that an earlier call left there are removed. Throws
/// RunError if that fails.
void write_factors(const FactoredBrdf& brdf, const std::filesystem::path& folder);

/// Throws InputError "FILE: what is wrong; how to mend it": no folder, no textures, one that is
/// missing, not square, without metadata, with other metadata than the first, or with a value that
/// is not finite.
FactoredBrdf read_factors(const std::filesystem::path& folder);

}  // namespace nacre
