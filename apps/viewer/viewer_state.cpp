#include "apps/viewer/viewer_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/scene/subsurface.h"

namespace nacre::viewer {

bool same(const TechniqueChoice& a, const TechniqueChoice& b) {
    return a.technique == b.technique && a.options == b.options;
}

std::pair<double, double> usual_scale(Quantity quantity) {
    // A pixel of a picture is about a millionth of the half space.
    return quantity == Quantity::illuminance ? std::pair{1e-5, 1.} : std::pair{10., 1e5};
}

int checked_light_view(int width) {
    if (!std::has_single_bit(unsigned(width)))
        throw InputError(fmt::format(
            "a light's picture of {} pixels has no levels; its width is a power of 2, such as 512",
            width));
    return width;
}

bool ViewerState::operator==(const ViewerState& o) const {
    return camera == o.camera && same(technique, o.technique) && same(beside, o.beside) &&
           split == o.split && divider == o.divider && material == o.material &&
           lights == o.lights && deformation == o.deformation && animated == o.animated &&
           display == o.display && quality == o.quality && samples == o.samples;
}

ViewerScene::ViewerScene(Scene given, std::string name_, std::optional<ColorMode> mode_)
    : scene(std::move(given)), name(std::move(name_)), mode(mode_) {
    parts = {scene.root, meshes_of(scene)};
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i)
        if (is_translucent(scene.shapes[i])) object.extend(scene.rays.bounds(i));
    if (object.empty())
        throw InputError(
            "nothing in the scene is translucent: no shape has a homogeneous medium inside behind "
            "a dielectric boundary, smooth or equally rough everywhere; 'nacre render' shows it");
    const OrbitCamera camera(scene, object);
    lights = lights_of(scene, camera);
    const auto key = std::ranges::find_if(lights, &SceneLight::turns);
    if (key != lights.end()) key_light = std::size_t(key - lights.begin());
}

ViewerState ViewerScene::state() const {
    ViewerState s;
    s.camera = OrbitCamera(scene, object);
    // As the scene says, if that is in real time; else the first of those.
    const auto all = viewer_techniques();
    s.technique.technique = std::string(all.front()->name);
    s.beside.technique = "volpath";
    for (const ShapeBinding& shape : scene.shapes)
        if (shape.subsurface)
            if (const auto* t = techniques().look(shape.subsurface->technique); t && t->realtime)
                s.technique.technique = std::string(t->name);
    for (const SceneLight& light : lights) s.lights.push_back({light.azimuth, light.elevation, 1});
    return s;
}

SceneParts ViewerScene::parts_of(const ViewerState& state) const {
    return edited(scene, parts, state.material, lights, state.lights, state.camera.compass(),
                  Vec3d(object.center()));
}

std::vector<const TechniqueDescription*> viewer_techniques() {
    std::vector<const TechniqueDescription*> all(techniques().begin(), techniques().end());
    std::ranges::stable_partition(all, [](const auto* t) { return t->realtime != nullptr; });
    return all;
}

bool is_realtime(const TechniqueChoice& choice) {
    return techniques().find(choice.technique).realtime != nullptr;
}

void set_option(TechniqueChoice& choice, const std::string& name, const std::string& value) {
    const TechniqueChoice one = checked({choice.technique, {{name, value}}});
    std::erase_if(choice.options,
                  [&](const auto& option) { return option.first == one.options[0].first; });
    choice.options.push_back(one.options[0]);
}

std::string option_of(const TechniqueChoice& choice, const Parameter& parameter) {
    const std::string given = choice.option(parameter.name);
    return given.empty() ? default_text(parameter) : given;
}

Vec3f false_color(float t) {
    // Lightness grows evenly while the hue goes from blue over green and yellow to white.
    static constexpr Vec3f stops[] = {
        {0.f, 0.f, 0.f},       {0.16f, 0.10f, 0.45f}, {0.10f, 0.35f, 0.62f}, {0.05f, 0.58f, 0.50f},
        {0.40f, 0.75f, 0.22f}, {0.93f, 0.80f, 0.20f}, {1.f, 0.90f, 0.62f},   {1.f, 1.f, 1.f}};
    constexpr int last = int(std::size(stops)) - 1;
    const float x = std::clamp(t, 0.f, 1.f) * last;
    const int i = std::min(int(x), last - 1);
    return stops[i] + (stops[i + 1] - stops[i]) * (x - float(i));
}

}  // namespace nacre::viewer
