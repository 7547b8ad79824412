// nacre data: files of measured reflectance.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/data_verbs.h"
#include "apps/cli/measured_page.h"
#include "apps/cli/plain_json.h"
#include "nacre/math/error.h"

namespace nacre::cli {
namespace {

struct InfoOptions {
    std::string file;
    bool json = false;
};

Subverb set_up_data_info(CLI::App& app) {
    auto o = std::make_shared<InfoOptions>();
    CLI::App* sub = app.add_subcommand("info", "say what a file holds: format, units, gaps");
    sub->add_option("file", o->file, "a measured file of any format")->required();
    sub->add_flag("--json", o->json, "for programs");
    return {sub, [o] {
                print_found(describe_measured(o->file), o->json);
                return success;
            }};
}

}  // namespace

Action set_up_data(CLI::App& app, const Invocation&) {
    app.require_subcommand(0, 1);
    const std::vector<Subverb> all{set_up_data_info(app), set_up_data_eval(app)};
    return [all] {
        for (const Subverb& sub : all)
            if (sub.app->parsed()) return sub.action();
        throw InputError(
            "say what to do with the data: nacre data info FILE, nacre data eval FILE");
    };
}

}  // namespace nacre::cli
