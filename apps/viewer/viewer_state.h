#pragma once
// What the viewer shows: all that its window and its scripts change, and nothing of how it is shown.
#include "apps/viewer/scene_edits.h"
#include "nacre/techniques/techniques.h"

namespace nacre::viewer {

enum class Quantity : int { color, luminance, illuminance };

struct Display {
    float exposure = 0;  ///< stops
    Quantity quantity = Quantity::color;
    double low = 10, high = 1e5;  ///< of the scale of false colours, cd/m^2 or lx
    bool operator==(const Display&) const = default;
};

/// Where scales of false colours begin and end before anybody says otherwise.
std::pair<double, double> usual_scale(Quantity quantity);

/// How frames are made: what of quality a viewer may trade for speed.
struct FrameQuality {
    bool average = true;  ///< frames of a still picture
    int light_points = 8;
    int light_view = 512;
    bool operator==(const FrameQuality&) const = default;
};
/// Throws InputError unless it is a power of 2.
int checked_light_view(int width);

struct ViewerState {
    OrbitCamera camera;
    TechniqueChoice technique;  ///< of the whole picture, or its left side
    TechniqueChoice beside;     ///< of the right side
    bool split = false;
    double divider = 0.5;  ///< where the sides meet, share of the width
    MaterialEdit material;
    std::vector<LightEdit> lights;  ///< one each of ViewerScene::lights
    Deformation deformation;
    bool animated = false;  ///< the deformation swings
    Display display;
    FrameQuality quality;
    int samples = 16;  ///< a pixel, of techniques offline where nobody waits for more

    bool operator==(const ViewerState& o) const;
};
bool same(const TechniqueChoice& a, const TechniqueChoice& b);

/// Radians of phase by which an animated deformation goes on in a second.
inline constexpr float swing_per_second = 2.f;

/// The scene that is looked at: as it was loaded.
struct ViewerScene {
    Scene scene;
    std::string name;                    ///< for titles and files
    std::optional<ColorMode> mode = {};  ///< asked for by the user

    SceneParts parts = {};
    Box3f object = {};  ///< bounds of the translucent shapes
    std::vector<SceneLight> lights = {};
    std::size_t key_light = 0;  ///< the first that turns

    /// Throws InputError for scenes without translucent shapes.
    ViewerScene(Scene scene, std::string name, std::optional<ColorMode> mode);
    /// What is shown at first.
    ViewerState state() const;
    /// The changed tree with its meshes at rest.
    SceneParts parts_of(const ViewerState& state) const;
};

/// The techniques by which a viewer may show something, those in real time first.
std::vector<const TechniqueDescription*> viewer_techniques();
bool is_realtime(const TechniqueChoice& choice);

/// Sets an option of a technique, checked and by its name in the list. Throws InputError.
void set_option(TechniqueChoice& choice, const std::string& name, const std::string& value);
/// Its value as text: what was set, else the default.
std::string option_of(const TechniqueChoice& choice, const Parameter& parameter);

/// How the false colours run, dark to light; t in [0, 1], sRGB.
Vec3f false_color(float t);

}  // namespace nacre::viewer
