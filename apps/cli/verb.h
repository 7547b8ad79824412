#pragma once
// The verbs of the command line: one file each, one table (main.cpp).
#include <functional>
#include <span>
#include <string>

namespace CLI {
class App;
}

namespace nacre::cli {

/// What was typed, for messages and the metadata of pictures.
struct Invocation {
    std::string command_line;
};

/// Does the work once the options are read; returns the exit code.
using Action = std::function<int()>;

struct Verb {
    const char* name;
    const char* summary;  ///< one line of the list of verbs
    /// Declares the options of the verb; they are read before the action is called.
    Action (*set_up)(CLI::App& app, const Invocation& invocation);
};

/// A word as the shell takes it.
std::string shell_word(const std::string& word);

// Exit codes.
inline constexpr int success = 0, failure = 1, wrong_input = 2, interrupted = 130;

inline constexpr const char* version = NACRE_VERSION;

Action set_up_render(CLI::App& app, const Invocation& invocation);
Action set_up_demo(CLI::App& app, const Invocation& invocation);
Action set_up_eval(CLI::App& app, const Invocation& invocation);
Action set_up_profile(CLI::App& app, const Invocation& invocation);
Action set_up_slab(CLI::App& app, const Invocation& invocation);
Action set_up_check(CLI::App& app, const Invocation& invocation);
Action set_up_measure(CLI::App& app, const Invocation& invocation);
Action set_up_models(CLI::App& app, const Invocation& invocation);
Action set_up_data(CLI::App& app, const Invocation& invocation);
Action set_up_factor(CLI::App& app, const Invocation& invocation);
Action set_up_fit(CLI::App& app, const Invocation& invocation);
Action set_up_info(CLI::App& app, const Invocation& invocation);
Action set_up_diff(CLI::App& app, const Invocation& invocation);
Action set_up_merge(CLI::App& app, const Invocation& invocation);
Action set_up_compare(CLI::App& app, const Invocation& invocation);
Action set_up_image(CLI::App& app, const Invocation& invocation);
Action set_up_view(CLI::App& app, const Invocation& invocation);
Action set_up_gallery(CLI::App& app, const Invocation& invocation);

}  // namespace nacre::cli
