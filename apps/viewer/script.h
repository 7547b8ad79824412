#pragma once
// The viewer's scripts: a line a command, '#' begins a comment. docs/viewer.md lists them.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/viewer/viewer_state.h"

namespace nacre::viewer {

/// What a line asks for beyond a change of the state.
struct Step {
    enum class Kind { change, frames, screenshot, save } kind = Kind::change;
    int frames = 0;
    std::filesystem::path file = {};
};

/// Does what a line says to the state. Throws InputError for what is wrong with it.
Step obey(std::string_view line, const ViewerScene& scene, ViewerState& state);

struct ScriptLine {
    std::size_t number;  ///< from 1
    std::string text;
};
/// The lines of a file that say something, each of which was tried on a copy of the scene's first
/// state. Throws InputError "FILE:LINE: what is wrong".
std::vector<ScriptLine> read_script(const std::filesystem::path& file, const ViewerScene& scene);

/// The names of all commands, for documentation and its test.
std::vector<std::string_view> command_names();

}  // namespace nacre::viewer
