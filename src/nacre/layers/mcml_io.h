#pragma once
// Files of MCML: input (.mci, version 1.0) and output (.mco).
// L. Wang, S. L. Jacques 1992, Monte Carlo Modeling of Light Transport in Multi-layered Tissues in
// Standard C, University of Texas M. D. Anderson Cancer Center.
//
// MCML counts in cm, nacre in mm: coefficients are divided by 10, lengths multiplied; on the way
// out densities per cm, cm^2 and cm^3 are 10, 100 and 1000 times those per mm.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/layers/slab_monte_carlo.h"

namespace nacre {

/// One run of an input file.
struct McmlRun {
    std::string output;   ///< name of the output file
    bool binary = false;  ///< format B; MCML itself writes only A
    std::uint64_t photons = 0;
    SlabBins bins;     ///< widths in mm
    LayerStack stack;  ///< in mm; a last layer of 1e6 cm or more is infinitely thick

    /// What a simulation of this run takes: `pairs` as MCML, with its roulette.
    SlabMonteCarloOptions options(std::uint64_t seed = 0) const;
};

/// The runs of an input file's text; `name` is for messages. Throws InputError "name:line: what".
std::vector<McmlRun> parse_mci(std::string_view text, const std::string& name);
std::vector<McmlRun> read_mci(const std::filesystem::path& file);

/// The text of an input file; an infinite thickness becomes 1e8 cm.
std::string mci_text(const std::vector<McmlRun>& runs);

/// The text of an output file, with the profiles that `result` holds. Unlike MCML's, their last
/// bins do not collect what falls beyond them.
std::string mco_text(const McmlRun& run, const SlabMonteCarloResult& result);

/// Everything in `result` as a table with a header, in mm, with standard errors: one line a number,
/// with the middle of its bin in radius (mm), depth (mm) and exit angle (degrees).
std::string slab_csv(const SlabBins& bins, const SlabMonteCarloResult& result);

}  // namespace nacre
