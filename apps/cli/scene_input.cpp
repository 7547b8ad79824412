#include "apps/cli/scene_input.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "apps/cli/number_option.h"
#include "apps/cli/verb.h"
#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/scene/demo_scene.h"
#include "nacre/scene/load.h"
#include "nacre/techniques/techniques.h"
#include "nacre/text/names.h"

namespace nacre::cli {
namespace {

constexpr const char* demo = "demo";
constexpr std::pair demo_size{360, 480};

// Scenes of another renderer go to the scene reader too, which says what to do with them.
bool is_scene(const std::filesystem::path& file) {
    const std::string ext = file.extension().string();
    return ext == ".xml" || ext == ".XML" || ext == ".pbrt";
}

std::optional<ColorMode> parse_mode(const std::string& text) {
    if (text.empty()) return {};
    if (text == "rgb") return ColorMode::rgb_bands;
    if (text == "spectral") return ColorMode::spectral;
    throw InputError("--mode: " + unknown_name("mode", text, {"rgb", "spectral"}));
}

std::map<std::string, std::string> parse_defines(const std::vector<std::string>& defines) {
    std::map<std::string, std::string> r;
    for (const std::string& d : defines) {
        const std::size_t equals = d.find('=');
        if (equals == 0 || equals == d.npos)
            throw InputError(fmt::format("-D: '{}' is not of the form name=value", d));
        r[d.substr(0, equals)] = d.substr(equals + 1);
    }
    return r;
}

bool is_demo(const SceneInput& input) {
    return input.scene == demo && !std::filesystem::exists(demo);
}

}  // namespace

void add_scene_options(CLI::App& app, SceneInput& input) {
    app.add_option("-D,--define", input.defines, "name=value: sets a <default> of the scene")
        ->allow_extra_args(false);
    app.add_option("--size", input.size, "WIDTHxHEIGHT in pixels, instead of the scene's");
    app.add_option("--mode", input.mode, "rgb or spectral (default: what the scene needs)");
    app.add_option(
        "--material", input.material,
        "of a bare mesh: a measured medium or skin (see 'nacre models'; default: marble)");
    add_number(app, "--height-mm", input.height_mm, {1e-9, 1e9},
               "height of a bare mesh (default: 100)");
    add_number(app, "--crease-angle", input.crease_angle, {0, 180},
               "of a bare mesh: edges between triangles whose normals differ by more degrees are "
               "hard (0: all, 180: none; default: normals as in the file, else 50)");
    app.add_option("--up", input.up,
                   "of a bare mesh: which of its axes is up: x, y, z, -x, -y or -z (default: "
                   "guessed)");
    app.add_option("--view", input.view,
                   "of a bare mesh: front, back, left, right, top, three-quarter (default), or "
                   "AZIMUTH,ELEVATION in degrees from the front to the right and upwards");
    app.add_option(
        "--camera", input.camera,
        "of a bare mesh: the viewer, as 'origin=0,60,400 target=0,50,0 fov=30'; x right, "
        "y up, z to the front, in mm");
    app.add_option("--light", input.lights,
                   "of a bare mesh: a light in place of the usual ones, as 'point "
                   "position=-200,300,300'; also spot, directional, sphere, area")
        ->allow_extra_args(false);
    app.add_option("--env", input.environment,
                   "of a bare mesh: a picture of the surroundings, which lights in place of the "
                   "usual lights, as 'studio.hdr rotate=90 scale=2'");
    app.add_option("--background", input.background,
                   "of a bare mesh: what is seen behind it and lights nothing: R,G,B, none (black) "
                   "or env (default)");
    app.add_flag("--floor", input.floor,
                 "of a bare mesh: it stands on a floor (default without --env and --background)");
    app.add_flag("--no-floor", input.no_floor, "of a bare mesh: it does not");
}

bool is_scene_file(const SceneInput& input) { return !is_demo(input) && is_scene(input.scene); }

namespace {

constexpr const char* of_the_object[] = {"--material", "--height-mm", "--crease-angle", "--up"};
constexpr const char* of_the_stage[] = {"--view",       "--camera", "--light",   "--env",
                                        "--background", "--floor",  "--no-floor"};

StageOptions stage_of(const SceneInput& input, const CLI::App& app) {
    StageOptions stage;
    if (app.count("--view") && app.count("--camera"))
        throw InputError("give either --view or --camera: both say where the viewer is");
    if (input.floor && input.no_floor) throw InputError("give either --floor or --no-floor");
    if (app.count("--view")) stage.view = parse_view(input.view);
    if (app.count("--camera")) stage.camera = parse_stage_camera(input.camera);
    for (const std::string& light : input.lights) stage.lights.push_back(parse_stage_light(light));
    if (app.count("--env")) stage.environment = parse_stage_environment(input.environment);
    if (app.count("--background")) stage.background = parse_background(input.background);
    if (input.floor || input.no_floor) stage.floor = input.floor;
    return stage;
}

std::optional<SignedAxis> parse_up(const std::string& text) {
    if (const auto up = find_signed_axis(text)) return up;
    throw InputError("--up: " + unknown_name("direction", text, {"x", "y", "z", "-x", "-y", "-z"}));
}

}  // namespace

Scene load(const SceneInput& input, const CLI::App& app, std::vector<std::filesystem::path>* files,
           std::optional<MeshPose>* pose) {
    const std::filesystem::path file = input.scene;
    if (files) files->push_back(file);
    if (has_image_extension(file))
        throw InputError(fmt::format("{}: is an image; {} takes a scene or a mesh", input.scene,
                                     app.get_name().substr(app.get_name().rfind(' ') + 1)));
    const auto refuse = [&](const char* option, const char* why) {
        if (app.count(option)) throw InputError(fmt::format("{}: {} {}", input.scene, option, why));
    };
    const std::optional<ColorMode> mode = parse_mode(input.mode);
    std::pair<int, int> size{0, 0};
    if (!input.size.empty()) size = parse_size("--size", input.size);
    const auto refuse_of_bare_meshes = [&] {
        for (const char* option : of_the_object)
            refuse(option, "is for bare meshes; a scene says itself what its shapes are");
        for (const char* option : of_the_stage)
            refuse(option, "is for bare meshes; a scene says itself what is in it");
    };
    const char* no_names = "is for scene files; a mesh has no names to set";
    if (is_demo(input)) {
        refuse_of_bare_meshes();
        refuse("-D", no_names);
        refuse("--mode", "is for scenes of others; the built-in one is RGB");
        if (!size.first) size = demo_size;
        return make_demo_scene(size.first, size.second);
    }
    if (is_scene(file)) {
        refuse_of_bare_meshes();
        LoadOptions load;
        load.defines = parse_defines(input.defines);
        load.mode = mode;
        load.files = files;
        std::tie(load.width, load.height) = size;
        Scene scene = load_scene(file, load);
        plan_of(scene);  // refuses what no technique understands, whoever renders it
        return scene;
    }
    refuse("-D", no_names);
    MeshSceneOptions mesh;
    mesh.mode = mode;
    if (!input.material.empty()) mesh.material = input.material;
    if (app.count("--height-mm")) mesh.height_mm = input.height_mm;
    mesh.crease_angle = input.crease_angle;
    if (size.first) std::tie(mesh.width, mesh.height) = size;
    if (app.count("--up")) mesh.up = parse_up(input.up);
    mesh.stage = stage_of(input, app);
    if (files && mesh.stage.environment) files->push_back(mesh.stage.environment->file);
    if (pose) mesh.pose = &pose->emplace();
    return load_mesh_scene(file, mesh);
}

std::string arguments_of(const SceneInput& input) {
    std::string text = shell_word(input.scene);
    for (const std::string& d : input.defines) text += " -D " + shell_word(d);
    if (!input.size.empty()) text += " --size " + input.size;
    if (!input.mode.empty()) text += " --mode " + input.mode;
    if (!input.material.empty()) text += " --material " + shell_word(input.material);
    if (input.height_mm > 0) text += fmt::format(" --height-mm {:g}", input.height_mm);
    if (input.crease_angle) text += fmt::format(" --crease-angle {:g}", *input.crease_angle);
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) text += fmt::format(" {} {}", option, shell_word(value));
    };
    add("--up", input.up);
    add("--view", input.view);
    add("--camera", input.camera);
    for (const std::string& light : input.lights) add("--light", light);
    add("--env", input.environment);
    add("--background", input.background);
    if (input.floor) text += " --floor";
    if (input.no_floor) text += " --no-floor";
    return text;
}

std::string sentence_about(const MeshPose& pose) {
    const char* by_shape = ", by its shape,";
    return fmt::format("up is {}{} and the front {}{}; --up and --view change that",
                       name_of(pose.up), pose.up_by_shape ? by_shape : "", name_of(pose.front),
                       pose.front_by_shape ? ", by its shape" : "");
}

std::pair<int, int> parse_size(const std::string& option, const std::string& text) {
    const std::size_t cross = text.find('x');
    const auto side = [&](std::string_view part) {
        const auto n = whole_in(part);
        return n && *n >= 1 && *n <= most_pixels_a_side ? int(*n) : 0;
    };
    const std::string_view all(text);
    const int width = cross == text.npos ? 0 : side(all.substr(0, cross)),
              height = cross == text.npos ? 0 : side(all.substr(cross + 1));
    if (width == 0 || height == 0)
        throw InputError(fmt::format(
            "{}: '{}' is not a size; write WIDTHxHEIGHT in pixels, from 1 to {} each, such as "
            "640x480",
            option, text, most_pixels_a_side));
    return {width, height};
}

}  // namespace nacre::cli
