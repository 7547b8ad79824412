#pragma once
// The scene that `render` and `compare` are given: a scene file, a bare mesh, or the built-in one.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nacre/geometry/mesh_pose.h"
#include "nacre/scene/scene.h"

namespace CLI {
class App;
}

namespace nacre::cli {

struct SceneInput {
    std::string scene;  ///< .xml, a mesh, or "demo"
    std::vector<std::string> defines;
    std::string size, mode, material;
    double height_mm = 0;
    std::optional<double> crease_angle;
    std::string up, view, camera, environment, background;
    std::vector<std::string> lights;
    bool floor = false, no_floor = false;
};

inline constexpr int most_pixels_a_side = 65536;

/// Declares -D, --size, --mode, and what is for bare meshes only: --material, --height-mm,
/// --crease-angle, --up, --view, --camera, --light, --env, --background, --floor and --no-floor.
void add_scene_options(CLI::App& app, SceneInput& input);

/// Loads it; `files` gets what was read for it and `pose` how a bare mesh stands in its file. Throws
/// InputError for options that do not belong to this kind of scene.
Scene load(const SceneInput& input, const CLI::App& app,
           std::vector<std::filesystem::path>* files = nullptr,
           std::optional<MeshPose>* pose = nullptr);

/// "up is +z, by its shape, and the front -y; --up and --view change that".
std::string sentence_about(const MeshPose& pose);

/// Whether it is a scene file and not a mesh or the built-in scene.
bool is_scene_file(const SceneInput& input);

/// The words with which `nacre render` loads the same scene.
std::string arguments_of(const SceneInput& input);

/// "WIDTHxHEIGHT" and the like: two positive numbers; throws InputError that names the option.
std::pair<int, int> parse_size(const std::string& option, const std::string& text);

}  // namespace nacre::cli
