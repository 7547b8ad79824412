#pragma once
// Input files of MCML as `nacre slab` runs them.
#include <cstdint>
#include <filesystem>
#include <optional>

namespace nacre::cli {

struct McmlJob {
    std::filesystem::path input;
    /// .mco, .csv (all numbers with standard errors, mm), or a folder; empty: that of the input.
    std::filesystem::path output;
    std::optional<std::uint64_t> photons;  ///< instead of the file's
    std::uint64_t seed = 0;
    bool quiet = false;  ///< no progress
};

/// Simulates the runs and writes what MCML would, each under the name that its run gives, without
/// the folders in it. Throws InputError for what is wrong with the files, before the first run.
int run_mcml(const McmlJob& job);

}  // namespace nacre::cli
