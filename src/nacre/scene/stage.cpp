#include "nacre/scene/stage_nodes.h"

#include <fmt/format.h>

#include <cmath>

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;

/// The object's bounding sphere, about which everything is arranged.
struct Stage {
    Vec3d center;
    double radius;
    double flatness;  ///< height by the longer side of the floor plan
};

/// What suits an upright object, and a flat one.
double between(const Stage& stage, double of_upright, double of_flat) {
    constexpr double flat = 0.1, upright = 0.4;
    const double t = std::clamp((upright - stage.flatness) / (upright - flat), 0., 1.);
    return of_upright + (of_flat - of_upright) * t;
}

/// Of flat things one sees nothing from low above the floor.
double usual_elevation(const Stage& stage) { return between(stage, 14, 38); }

Vec3d eye_of(const Stage& stage, const StageOptions& options, double fov) {
    if (options.camera) return options.camera->origin;
    const StageView view = options.view.value_or(StageView{.elevation = usual_elevation(stage)});
    const double distance = 1.08 * stage.radius / std::sin(fov / 2 * degree);
    return stage.center + direction(view.azimuth, view.elevation) * distance;
}

NodePtr camera_for(const Stage& stage, const StageOptions& options, const StagePlan& plan) {
    // 26 degrees are about those of an 80 mm lens on 35 mm film: little distortion.
    const StageCamera given = options.camera.value_or(StageCamera{});
    const Vec3d eye = eye_of(stage, options, given.fov);
    const Vec3d target = given.target.value_or(stage.center);
    Vec3d up = given.up;
    if (!options.camera && options.view && std::abs(options.view->elevation) > 89.9)
        up = direction(options.view->azimuth, 0) * -std::copysign(1., options.view->elevation);
    const double distance = options.camera ? length(target - eye)
                                           : 1.08 * stage.radius / std::sin(given.fov / 2 * degree);
    if (!(distance > 0)) throw InputError("--camera: origin and target are the same place");
    auto camera = make_node("sensor", "perspective");
    set(camera, "fov", "float", given.fov);
    set(camera, "fov_axis", "string", std::string("smaller"));
    set(camera, "near_clip", "float", (options.camera ? 0.0001 : 0.01) * distance);
    set(camera, "far_clip", "float", (options.camera ? 1e5 : 1000) * distance);
    set(camera, "to_world", "transform", Transform::look_at(eye, target, up));
    auto film = make_node("film", "hdrfilm");
    set(film, "width", "integer", std::int64_t{plan.width_pixels});
    set(film, "height", "integer", std::int64_t{plan.height_pixels});
    add(camera, film);
    auto sampler = make_node("sampler", "sobol");
    set(sampler, "sample_count", "integer", std::int64_t{64});
    add(camera, sampler);
    return camera;
}

NodePtr floor_under(const Stage& stage, double height) {
    auto grey = make_node("bsdf", "diffuse");
    set_rgb(grey, "reflectance", {0.4f, 0.4f, 0.4f});
    auto shape = make_node("shape", "rectangle");
    // A thousandth of the height below the object, so that the two surfaces never coincide; wide
    // enough for its edge to be far behind.
    const double half = 60 * stage.radius;
    set(shape, "to_world", "transform",
        Transform::translate({0, -1e-3 * height, 0}) * Transform::rotate({1, 0, 0}, -90) *
            Transform::scale({half, half, 1}));
    add(shape, grey);
    return shape;
}

/// 4 radii away; `white` is the radiance that it alone gives to a white surface turned towards it.
NodePtr lamp(const Stage& stage, const Vec3d& from, const Vec3f& color, double white) {
    const double distance = 4 * stage.radius;
    return ball_light(stage.center + from * distance, 0.9 * stage.radius, distance, color, white);
}

void add_usual_lights(const NodePtr& root, const Stage& stage, double azimuth) {
    auto sky = make_node("emitter", "constant");
    set_rgb(sky, "radiance", {0.13f, 0.14f, 0.16f});
    add(root, sky);
    // With the sky and the floor a white object in the key light comes to just below 1. The light
    // from behind is stronger, because what passes through the object is little; it stands high
    // enough to stay out of the picture. What lies flat is turned to both alike.
    add(root, lamp(stage, direction(azimuth - 53, 40), {1.12f, 0.98f, 0.78f}, 0.6));
    add(root,
        lamp(stage, direction(azimuth + 130, 40), {1.04f, 1.f, 0.9f}, between(stage, 1.6, 0.6)));
}

/// A light's +z towards its target.
Transform facing(const StageLight& light, const Vec3d& target) {
    const Vec3d ahead = normalize(target - light.position);
    return Transform::look_at(light.position, target,
                              std::abs(ahead.y) > 0.999 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0});
}

NodePtr light_node(const Stage& stage, const StageLight& light) {
    using Type = StageLight::Type;
    const Vec3d target = light.target.value_or(stage.center);
    const double distance = length(stage.center - light.position);
    const bool is_placed = light.type != Type::directional;
    if (is_placed && (!(distance > 0) || !(length(target - light.position) > 0)))
        throw InputError("--light: it stands in the middle of what it is to light; move it away");
    // A white surface shines with irradiance / pi.
    const auto emission = [&](double per_irradiance) {
        return light.emission.value_or(light.color * float(light.white * pi * per_irradiance));
    };
    const auto shining = [&](NodePtr shape, const Vec3f& radiance) {
        auto emitter = make_node("emitter", "area");
        set_rgb(emitter, "radiance", radiance);
        add(shape, emitter);
        return shape;
    };
    switch (light.type) {
        case Type::point: {
            auto node = make_node("emitter", "point");
            set(node, "position", "point", light.position);
            set_rgb(node, "intensity", emission(distance * distance));
            return node;
        }
        case Type::spot: {
            auto node = make_node("emitter", "spot");
            set(node, "to_world", "transform", facing(light, target));
            set_rgb(node, "intensity", emission(distance * distance));
            set(node, "cutoff_angle", "float", light.cutoff_angle);
            set(node, "beam_width", "float", light.beam_width);
            return node;
        }
        case Type::directional: {
            auto node = make_node("emitter", "directional");
            set(node, "direction", "vector", light.direction);
            set_rgb(node, "irradiance", emission(1));
            return node;
        }
        case Type::sphere: {
            auto shape = make_node("shape", "sphere");
            set(shape, "center", "point", light.position);
            set(shape, "radius", "float", light.radius);
            const double relative = distance / light.radius;
            return shining(shape, emission(relative * relative / pi));
        }
        case Type::area:
            break;
    }
    auto shape = make_node("shape", "rectangle");
    const double half = 0.5 * light.size, relative = distance / light.size;
    set(shape, "to_world", "transform", facing(light, target) * Transform::scale({half, half, 1}));
    return shining(shape, emission(relative * relative));
}

NodePtr environment_node(const StageEnvironment& environment) {
    if (!std::filesystem::is_regular_file(without_layer(environment.file)))
        throw InputError(fmt::format("--env: cannot find '{}'", environment.file.string()));
    auto node = make_node("emitter", "envmap");
    set(node, "filename", "string", environment.file.string());
    set(node, "scale", "float", environment.scale);
    set(node, "to_world", "transform", Transform::rotate({0, 1, 0}, environment.rotate));
    return node;
}

}  // namespace

void set_stage(const NodePtr& root, const StagePlan& plan, const StageOptions& options) {
    const Vec3d size(plan.object.diagonal());
    const Stage stage{Vec3d(plan.object.center()), 0.5 * length(size),
                      size.y / std::max(size.x, size.z)};
    add(root, camera_for(stage, options, plan));
    const Vec3d from =
        eye_of(stage, options, options.camera ? options.camera->fov : 26) - stage.center;
    if (options.environment) add(root, environment_node(*options.environment));
    const bool has_floor = options.floor.value_or(!options.environment && !options.background);
    for (const StageLight& light : options.lights) {
        if (has_floor && light.type != StageLight::Type::directional && light.position.y <= 0)
            throw InputError(
                "--light: it stands below the floor, which keeps its light from the "
                "object; move it, or leave the floor out (--no-floor)");
        add(root, light_node(stage, light));
    }
    if (!options.environment && options.lights.empty()) {
        // They stand about the viewer, so that every side is lit alike.
        const bool by_place = options.camera && std::hypot(from.x, from.z) > 0;
        add_usual_lights(root, stage,
                         by_place       ? std::atan2(from.x, from.z) / degree
                         : options.view ? options.view->azimuth
                                        : StageView{}.azimuth);
    }
    if (!has_floor) return;
    if ((stage.center + from).y <= 0)
        throw InputError(
            "the viewer is below the floor and sees nothing of the object; leave the "
            "floor out (--no-floor)");
    add(root, floor_under(stage, plan.height));
}

LightPtr stage_background(const StageOptions& options, BuildContext& context) {
    if (!options.background) return nullptr;
    auto node = make_node("emitter", "constant");
    set_rgb(node, "radiance", *options.background);
    return make_light(*node, context);
}

}  // namespace nacre
