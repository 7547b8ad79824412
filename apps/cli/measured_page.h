#pragma once
// What a file of measured reflectance holds, in words.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace nacre {
class Measured;
}

namespace nacre::cli {

/// Whether the name ends as one of the formats' files do (formats.h).
bool has_measured_extension(const std::filesystem::path& file);

/// Reads it and says what it holds. Throws InputError as read_measured does.
nlohmann::ordered_json describe_measured(const std::filesystem::path& file);
nlohmann::ordered_json describe_measured(const std::filesystem::path& file, const Measured& data);

/// Throws InputError if what should be the name of a model is that of a file or folder, and of no
/// model: `nacre data instead` is for those.
void refuse_data_as_model(const std::string& name, std::string_view instead);

}  // namespace nacre::cli
