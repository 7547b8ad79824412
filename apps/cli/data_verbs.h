#pragma once
// What `nacre data` does with a file, one a file (data_<name>.cpp).
#include "apps/cli/verb.h"

namespace nacre::cli {

/// A subcommand, and what it does.
struct Subverb {
    CLI::App* app;
    Action action;
};

Subverb set_up_data_audit(CLI::App& app);
Subverb set_up_data_convert(CLI::App& app);
Subverb set_up_data_eval(CLI::App& app);
Subverb set_up_data_info(CLI::App& app);

}  // namespace nacre::cli
