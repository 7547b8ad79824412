#include <fmt/format.h>

#include <set>

#include "nacre/scene/gltf/shapes.h"
#include "nacre/scene/legacy_settings.h"
#include "nacre/scene/load.h"
#include "nacre/scene/scene_builder.h"

namespace nacre {
namespace {

/// The one child of that tag, or null; a second one is an error.
const SceneNode* only_child(const SceneNode& node, const std::string& tag) {
    const auto found = node.children_of(tag);
    if (found.size() > 1)
        throw InputError(fmt::format("{}: a second <{}>; the first is at {}",
                                     found[1]->location.str(), tag, found[0]->location.str()));
    return found.empty() ? nullptr : found[0]->node.get();
}

/// All objects that another object of the tree holds, not counting the scene itself.
void collect_nested(const SceneNode& node, std::set<const SceneNode*>& nested) {
    for (const SceneNode::Child& c : node.children)
        if (nested.insert(c.node.get()).second) collect_nested(*c.node, nested);
}

/// Objects that stand in the scene only to be referred to. Those that nobody refers to are built
/// all the same, so that mistakes in them do not pass.
void build_shared_objects(const SceneNode& root, Scene& scene, BuildContext& context) {
    std::set<const SceneNode*> nested;
    for (const SceneNode::Child& c : root.children) collect_nested(*c.node, nested);
    for (const SceneNode::Child* c : root.children_of("bsdf")) make_material(*c->node, context);
    for (const SceneNode::Child* c : root.children_of("medium"))
        add_medium(*c->node, scene, context);
    for (const SceneNode::Child* c : root.children_of("texture"))
        if (!nested.contains(c->node.get()))
            make_texture(*c->node, ColorRole::reflectance, context);
    for (const SceneNode::Child* c : root.children_of("phase"))
        if (!nested.contains(c->node.get())) make_phase(*c->node);
    for (const SceneNode::Child* c : root.children_of("volume"))
        if (!nested.contains(c->node.get())) make_volume(*c->node, ColorRole::unbounded, context);
}

/// A camera in front of the whole scene (+z looks back at the viewer, y up), for files without one.
CameraPtr default_camera(const Scene& scene, BuildContext& context) {
    constexpr double fov = 40.0, pi = 3.14159265358979323846;
    const Vec3d center(context.scene_center);
    const double aspect = double(scene.film.width) / scene.film.height;
    // The smaller angle of view must hold the bounding sphere.
    const double half = fov * pi / 360.0;
    const double distance = 1.05 * context.scene_radius / std::sin(half);
    SceneNode node;
    node.tag = "sensor";
    node.type = "perspective";
    const auto set = [&](const char* name, const char* tag, auto value) {
        node.values.push_back({name, tag, std::move(value), {}});
    };
    set("fov", "float", fov);
    set("fov_axis", "string", std::string("smaller"));
    set("near_clip", "float", 1e-3 * distance);
    set("far_clip", "float", 1e3 * distance);
    set("to_world", "transform",
        Transform::look_at(center + Vec3d(0, 0, distance), center, {0, 1, 0}));
    return make_camera(node, static_cast<float>(aspect), context);
}

/// A size that was asked for takes the place of the film's, and of a crop window within it.
void set_film_size(FilmSettings& film, const BuildContext& context) {
    if (context.film_width <= 0 || context.film_height <= 0) return;
    film.width = context.film_width;
    film.height = context.film_height;
    film.crop_x = film.crop_y = film.crop_width = film.crop_height = 0;
}

void read_sensor(const SceneNode& root, Scene& scene, BuildContext& context) {
    const SceneNode* sensor = only_child(root, "sensor");
    scene.sampler.samples = 4;  // Mitsuba's default
    if (!sensor) {
        context.warnings.push_back(fmt::format(
            "{}: the scene has no <sensor>; a camera that frames it is used", root.location.str()));
        set_film_size(scene.film, context);
        scene.camera = default_camera(scene, context);
        return;
    }
    if (const SceneNode* film = only_child(*sensor, "film")) scene.film = read_film(*film, context);
    set_film_size(scene.film, context);
    if (const SceneNode* sampler = only_child(*sensor, "sampler"))
        scene.sampler = read_sampler(*sampler);
    if (const SceneNode* medium = only_child(*sensor, "medium"))
        scene.camera_medium = add_medium(*medium, scene, context);
    const float aspect =
        static_cast<float>(scene.film.width) / static_cast<float>(scene.film.height);
    scene.camera = make_camera(*sensor, aspect, context);
    sensor->check_all_used();
}

void set_bounds(const Scene& scene, BuildContext& context) {
    if (scene.rays.shape_count() == 0) return;
    const Box3f box = scene.rays.bounds();
    context.scene_center = box.center();
    context.scene_radius = 0.5f * length(box.diagonal());
}

void add_lights(const SceneNode& root, const std::vector<PendingAreaLight>& pending, Scene& scene,
                BuildContext& context) {
    for (const PendingAreaLight& p : pending) {
        scene.lights.push_back(make_area_light(*p.emitter, scene.rays, p.shape, context));
        p.emitter->check_all_used();
        scene.shapes[p.shape].light = scene.lights.back().get();
    }
    SourceLocation first;
    for (const SceneNode::Child* child : root.children_of("emitter")) {
        const SceneNode& node = *child->node;
        if (node.type == "area")
            throw InputError(fmt::format("{}: {} belongs into a <shape>, whose surface shines",
                                         child->location.str(), node.describe()));
        scene.lights.push_back(make_light(node, context));
        node.check_all_used();
        if (!scene.lights.back()->is_infinite()) continue;
        if (scene.environment)
            throw InputError(fmt::format("{}: a second light at infinity; the first is at {}",
                                         child->location.str(), first.str()));
        scene.environment = scene.lights.back().get();
        first = child->location;
    }
}

bool any_spectral(const Scene& scene) {
    const auto spectral = [](const auto& p) { return p->is_spectral(); };
    return std::any_of(scene.lights.begin(), scene.lights.end(), spectral) ||
           std::any_of(scene.media.begin(), scene.media.end(), spectral) ||
           std::any_of(scene.shapes.begin(), scene.shapes.end(),
                       [](const ShapeBinding& s) { return s.material->is_spectral(); }) ||
           (scene.integrator.legacy && scene.integrator.legacy->is_spectral());
}

}  // namespace

const Medium* add_medium(const SceneNode& node, Scene& scene, BuildContext& context) {
    const auto known = context.media.find(&node);
    const MediumPtr medium =
        known != context.media.end() ? known->second : make_medium(node, context);
    context.media[&node] = medium;
    if (std::find(scene.media.begin(), scene.media.end(), medium) == scene.media.end())
        scene.media.push_back(medium);
    return medium.get();
}

Scene build_scene(const SceneNodePtr& given, BuildContext& context, std::optional<ColorMode> mode) {
    const SceneNodePtr tree = with_gltf_shapes(given, context);
    const SceneNode& root = *tree;
    Scene scene;
    scene.root = tree;
    scene.search_path = context.search_path;
    scene.mm_per_unit = root.get_float("mm_per_unit", 1.0);
    if (!(scene.mm_per_unit > 0.0))
        root.fail_at("mm_per_unit",
                     fmt::format("'mm_per_unit' must be positive; got {}", scene.mm_per_unit));
    context.mm_per_unit = scene.mm_per_unit;

    if (const SceneNode* integrator = only_child(root, "integrator"))
        scene.integrator = read_integrator(*integrator);
    build_shared_objects(root, scene, context);
    std::vector<PendingAreaLight> pending;
    for (const SceneNode::Child* child : root.children_of("shape"))
        add_shape(*child->node, scene, context, pending);
    scene.rays.build();
    set_bounds(scene, context);
    add_lights(root, pending, scene, context);
    if (scene.shapes.empty() && !scene.environment)
        root.fail(
            "the scene has neither a <shape> nor a light at infinity: there is nothing to "
            "render");
    if (scene.lights.empty())
        context.warnings.push_back(
            fmt::format("{}: the scene has no light: the picture is black", root.location.str()));
    else if (!scene.integrator.legacy &&  // which has ambient light
             std::ranges::none_of(scene.lights, [](const LightPtr& l) { return l->power() > 0; }))
        context.warnings.emplace_back("the scene's lights are black, and so is the picture");
    read_sensor(root, scene, context);
    root.check_all_used();

    scene.mode = mode.value_or(any_spectral(scene) ? ColorMode::spectral : ColorMode::rgb_bands);
    scene.warnings = context.warnings;
    warn_about_media(scene);
    return scene;
}

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options) {
    BuildContext context;
    context.film_width = options.width;
    context.film_height = options.height;
    context.files = options.files;
    const SceneNodePtr root = read_scene_xml(file, options.defines, context.search_path);
    return build_scene(root, context, options.mode);
}

}  // namespace nacre
