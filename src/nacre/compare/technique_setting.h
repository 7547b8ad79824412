#pragma once
// Which techniques a comparison runs, and at which settings.
#include <string>
#include <string_view>
#include <vector>

#include "nacre/techniques/techniques.h"

namespace nacre {

/// A technique at one setting: a row of the table.
struct TechniqueSetting {
    TechniqueChoice choice;
    int samples = 16;  ///< a pixel

    /// "profile=dipole error=0.2", empty for the defaults.
    std::string options() const;
    /// "two_pass error=0.2 16 spp": what tells it from all others, and what its files are called.
    std::string id() const;
    /// The options of `nacre render` that render it.
    std::string arguments() const;
};

/// "all", or names separated by commas. A name alone stands for all variants of the technique; a
/// name with settings, "two_pass:error=0.1:spacing=0.5", for itself. Every one is run with each of
/// the numbers of samples. Throws InputError for unknown techniques, options and profiles, for
/// values out of range, and for what is asked for twice.
std::vector<TechniqueSetting> parse_techniques(std::string_view list,
                                               const std::vector<int>& samples);

}  // namespace nacre
