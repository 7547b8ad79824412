#pragma once
// The medium of `nacre profile`, as it is given on the command line.
#include <optional>
#include <string>

#include "nacre/bssrdf/medium.h"

namespace CLI {
class App;
}

namespace nacre::cli {

struct MediumOptions {
    std::string material, channel;
    std::optional<double> sigma_s, sigma_s_prime, sigma_a, g, eta;
};

void add_medium_options(CLI::App& app, MediumOptions& options);

/// A measured medium or skin in one of its bands, or coefficients. Throws InputError unless exactly
/// one of material, sigma_s and sigma_s' is given, and for an asymmetry out of range.
ProfileMedium profile_medium(const MediumOptions& options);

/// "marble, green band: sigma_s 2.62 mm^-1, ...".
std::string medium_title(const ProfileMedium& medium, const MediumOptions& options);

}  // namespace nacre::cli
