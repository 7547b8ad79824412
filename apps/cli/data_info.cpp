// nacre data info: what a measured file holds.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/data_verbs.h"
#include "apps/cli/measured_page.h"
#include "apps/cli/plain_json.h"

namespace nacre::cli {
namespace {

struct DataInfoArguments {
    std::string file;
    bool json = false;
};

}  // namespace

Subverb set_up_data_info(CLI::App& app) {
    auto o = std::make_shared<DataInfoArguments>();
    CLI::App* sub = app.add_subcommand("info", "say what a file holds: format, units, gaps");
    sub->add_option("file", o->file, "a measured file of any format")->required();
    sub->add_flag("--json", o->json, "for programs");
    return {sub, [o] {
                print_found(describe_measured(o->file), o->json);
                return success;
            }};
}

}  // namespace nacre::cli
