#pragma once
// Measured reflectance wherever people have it: a file of any format, or a folder of factors.
#include "nacre/measured/formats.h"

namespace nacre {

/// Throws InputError as read_measured (formats.h) does for files, as read_factors
/// (factor/textures.h) for folders.
std::unique_ptr<Measured> open_measured(const std::filesystem::path& path);

}  // namespace nacre
