#pragma once
// What stands around a bare mesh: viewer, lights, surroundings, floor. All of it is in the object's
// frame: millimetres, y up, the front towards +z, +x on the right of who looks at the front; the
// object stands centred above the origin on y = 0.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/math/vec.h"

namespace nacre {

/// From where the whole object is looked at, degrees.
struct StageView {
    double azimuth = 28;    ///< from the front towards +x
    double elevation = 14;  ///< above the floor
};

struct StageCamera {
    Vec3d origin;
    std::optional<Vec3d> target = {};  ///< unset: the object's middle
    Vec3d up{0, 1, 0};
    double fov = 26;  ///< degrees, of the shorter side of the film
};

struct StageLight {
    enum class Type { point, spot, directional, sphere, area } type = Type::point;
    Vec3d position{};  ///< not of directional ones
    Vec3d direction{0, -1, 0};
    std::optional<Vec3d> target = {};  ///< of spots and areas; unset: the object's middle
    Vec3f color{1, 1, 1};
    /// How bright a white surface at the object's middle, turned towards the light, is by it alone:
    /// radiance. Unused if `emission` is given.
    double white = 1;
    std::optional<Vec3f> emission = {};  ///< intensity, irradiance or radiance as in scene files
    double cutoff_angle = 20, beam_width = 15;  ///< of spots, degrees
    double radius = 20;                         ///< of spheres, mm
    double size = 40;                           ///< side of areas, mm
};

struct StageEnvironment {
    std::filesystem::path file;
    double rotate = 0;  ///< degrees about up, from +z towards +x
    double scale = 1;
};

struct StageOptions {
    std::optional<StageView> view = {};
    std::optional<StageCamera> camera = {};            ///< instead of a view
    std::vector<StageLight> lights = {};               ///< empty: chosen ones, unless ...
    std::optional<StageEnvironment> environment = {};  ///< ... this lights the object
    /// What the viewer sees where nothing is, which lights nothing; unset: what does light.
    std::optional<Vec3f> background = {};
    /// Unset: if neither environment nor background is given, both of which it would hide.
    std::optional<bool> floor = {};
};

// From what people write; InputError begins with the option's name.

/// front, back, left, right, top, three-quarter, or AZIMUTH,ELEVATION in degrees.
StageView parse_view(std::string_view text);
/// "origin=0,60,400 target=0,50,0 up=0,1,0 fov=30".
StageCamera parse_stage_camera(std::string_view text);
/// "point position=-200,300,200 white=0.8", ...
StageLight parse_stage_light(std::string_view text);
/// "studio.hdr rotate=90 scale=2".
StageEnvironment parse_stage_environment(std::string_view text);
/// "0.2,0.2,0.25", "env" (nothing) or "none" (black).
std::optional<Vec3f> parse_background(std::string_view text);
/// What the settings of --camera, --light and --env are, with units, ranges and defaults.
std::string stage_help();

}  // namespace nacre
