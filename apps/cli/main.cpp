// The command line `nacre`: a table of verbs and the exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <new>

#include "apps/cli/streams.h"
#include "apps/cli/verb.h"
#include "nacre/math/error.h"
#include "nacre/scene/xml/scene_node.h"
#include "nacre/text/names.h"

namespace nacre::cli {

std::string shell_word(const std::string& word) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:@%^";
    if (!word.empty() && word.find_first_not_of(plain) == word.npos) return word;
    std::string r = "'";
    for (char c : word) r += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return r + "'";
}

namespace {

constexpr Verb verbs[] = {
    {"render", "render a scene (.xml) or a bare mesh in a translucent material", set_up_render},
    {"view", "look at translucent objects in a window, by techniques in real time", set_up_view},
    {"demo", "render the built-in scene", set_up_demo},
    {"models", "list materials, media, profiles, techniques, phase functions and integrators",
     set_up_models},
    {"eval", "evaluate a reflectance model: values, albedo, plots", set_up_eval},
    {"profile", "evaluate diffusion profiles: how far light spreads below a surface",
     set_up_profile},
    {"slab", "reflectance and transmittance of a stack of layers, by every method", set_up_slab},
    {"check", "check models against reference values and their claims", set_up_check},
    {"measure", "measure the BRDF of microgeometry: a virtual gonioreflectometer", set_up_measure},
    {"data", "measured reflectance: what a file holds", set_up_data},
    {"factor", "factor a BRDF into sums of products of textures", set_up_factor},
    {"fit", "fit reflectance models to a measured BRDF, or to another model", set_up_fit},
    {"info", "say what is in a scene, mesh, image or measured file", set_up_info},
    {"merge", "put together what was rendered with other seeds or in parts", set_up_merge},
    {"diff", "compare two pictures", set_up_diff},
    {"compare", "compare all techniques on a scene: error, time, memory, as a report",
     set_up_compare},
    {"image", "convert an image between EXR, PFM, HDR and PNG", set_up_image},
    {"gallery", "render the figures of the classic papers", set_up_gallery},
};

constexpr const char* exit_codes =
    "exit codes: 0 done, 1 failed (disk full, --strict), 2 wrong input, 130 interrupted";

std::string usage() {
    std::string text =
        "nacre: light that is reflected by surfaces and scattered below them\n\n"
        "usage: nacre VERB [options]\n\n";
    for (const Verb& v : verbs) text += fmt::format("  {:<8} {}\n", v.name, v.summary);
    text += fmt::format("  {:<8} {}\n", "help", "this list, or the options of a verb: help VERB");
    return text + fmt::format("\n  --version  print the version\n\n{}\n", exit_codes);
}

const Verb& find_verb(const std::string& name) {
    std::vector<std::string> known{"help"};
    for (const Verb& v : verbs) {
        if (name == v.name) return v;
        known.emplace_back(v.name);
    }
    throw InputError(unknown_name("verb", name, known));
}

/// The subcommand that was parsed last: where words that nobody took were meant to go.
const CLI::App& innermost(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : innermost(*chosen.front());
}

void refuse_extras(const CLI::App& app) {
    const std::vector<std::string> extras = app.remaining(true);
    for (const std::string& word : extras) {
        if (word.size() < 2 || word[0] != '-') continue;
        std::vector<std::string> known;
        for (const CLI::Option* o : innermost(app).get_options())
            for (const std::string& n : o->get_lnames()) known.push_back("--" + n);
        const std::string name = word.substr(0, word.find('='));
        throw InputError(unknown_name("option", name, known));
    }
    if (!extras.empty())
        throw InputError(fmt::format("unexpected argument '{}'; see 'nacre help'", extras.front()));
}

int run(std::vector<std::string> args) {
    const Invocation invocation{[&] {
        std::string line = "nacre";
        for (const std::string& a : args) line += " " + shell_word(a);
        return line;
    }()};
    const std::string first = args.empty() ? "help" : args[0];
    if (first == "--version" || first == "-V") {
        fmt::print("nacre {}\n", version);
        return success;
    }
    if (first == "help" || first == "--help" || first == "-h") {
        if (args.size() < 2) {
            fmt::print("{}", usage());
            return success;
        }
        args = {args[1], "--help"};
    }
    const Verb& verb = find_verb(args[0]);
    CLI::App app(verb.summary, fmt::format("nacre {}", verb.name));
    app.allow_extras();
    app.footer(std::string("\n") + exit_codes);
    const Action action = verb.set_up(app, invocation);
    std::vector<std::string> rest(args.rbegin(), args.rend() - 1);  // CLI11 takes them backwards
    try {
        app.parse(std::move(rest));
    } catch (const CLI::Success& e) {  // --help
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        throw InputError(fmt::format("{}; see 'nacre help {}'", e.what(), verb.name));
    }
    refuse_extras(app);
    return action();
}

}  // namespace
}  // namespace nacre::cli

int main(int argc, char** argv) {
    using namespace nacre::cli;
    const auto complain = [](const char* what) { say("nacre: {}\n", what); };
    keep_standard_streams();
    try {
        const int code = run({argv + 1, argv + argc});
        finish_standard_output();
        return code;
    } catch (const nacre::InputError& e) {
        complain(e.what());
        return wrong_input;
    } catch (const std::bad_alloc&) {
        complain("out of memory; ask for a smaller picture or mesh");
        return failure;
    } catch (const std::exception& e) {
        complain(e.what());
        return failure;
    }
}
