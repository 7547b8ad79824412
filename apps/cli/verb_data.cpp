// nacre data: files of measured reflectance.
#include <CLI/CLI.hpp>

#include "apps/cli/data_verbs.h"
#include "nacre/math/error.h"

namespace nacre::cli {
Action set_up_data(CLI::App& app, const Invocation&) {
    app.require_subcommand(0, 1);
    const std::vector<Subverb> all{set_up_data_info(app), set_up_data_audit(app),
                                   set_up_data_convert(app), set_up_data_eval(app)};
    return [all] {
        for (const Subverb& sub : all)
            if (sub.app->parsed()) return sub.action();
        throw InputError(
            "say what to do with the data: nacre data info FILE, audit, convert, eval");
    };
}

}  // namespace nacre::cli
