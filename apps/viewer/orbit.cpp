#include "apps/viewer/orbit.h"

#include <algorithm>
#include <cmath>

#include "apps/viewer/put_value.h"
#include "nacre/scene/build.h"
#include "nacre/scene/xml/write_nodes.h"

namespace nacre::viewer {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double steepest = 89;  // degrees above the floor, where up and ahead still differ

}  // namespace

Vec3d Compass::direction(double azimuth, double elevation) const {
    const double a = azimuth * degree, e = elevation * degree;
    return front * (std::cos(e) * std::cos(a)) + right() * (std::cos(e) * std::sin(a)) +
           up * std::sin(e);
}

std::pair<double, double> Compass::angles(const Vec3d& direction) const {
    const Vec3d d = normalize(direction);
    return {std::atan2(dot(d, right()), dot(d, front)) / degree,
            std::asin(std::clamp(dot(d, up), -1., 1.)) / degree};
}

Compass Compass::of(const Vec3d& v) {
    const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    Compass c;
    if (y >= x && y >= z) {
        c.up = {0, std::copysign(1., v.y), 0};
    } else if (z >= x) {
        c.up = {0, 0, std::copysign(1., v.z)};
        c.front = {0, -1, 0};
    } else {
        c.up = {std::copysign(1., v.x), 0, 0};
    }
    return c;
}

OrbitCamera::OrbitCamera(const Scene& scene, const Box3f& object) : middle_(object.center()) {
    for (const SceneNode::Child& child : scene.root->children)
        if (child.node->tag == "sensor") own_ = child.node;
    const Camera& camera = *scene.camera;
    const Ray ahead = camera.ray({0.5f, 0.5f}, {0.5f, 0.5f}),
              top = camera.ray({0.5f, 0.f}, {0.5f, 0.5f}),
              foot = camera.ray({0.5f, 1.f}, {0.5f, 0.5f}),
              left = camera.ray({0.f, 0.5f}, {0.5f, 0.5f}),
              right = camera.ray({1.f, 0.5f}, {0.5f, 0.5f});
    const Vec3d forward(ahead.d), eye(ahead.o);
    parallel_ = length(Vec3d(top.d) - Vec3d(foot.d)) < 1e-6;
    const Vec3d rise = parallel_ ? Vec3d(top.o) - Vec3d(foot.o) : Vec3d(top.d) - Vec3d(foot.d);
    up_ = normalize(rise - forward * dot(rise, forward));
    compass_ = Compass::of(up_);
    // Of the way ahead, the place next to the object's middle; an object behind is not looked for.
    const double size = std::max(double(length(object.diagonal())), 1e-6);
    const double away = dot(middle_ - eye, forward);
    offset_ = forward * -(away > 1e-3 * size ? away : size);
    target_ = eye - offset_;
    if (parallel_) {
        scale_ = 0.5 * length(Vec3d(right.o) - Vec3d(left.o));
        height_per_unit_ = length(rise) / scale_;
    } else {
        height_per_unit_ =
            2 * std::tan(0.5 * std::acos(std::clamp(dot(Vec3d(top.d), Vec3d(foot.d)), -1., 1.)));
    }
    if (!own_) {  // as default_camera of the loader
        auto node = make_node("sensor", "perspective");
        set(node, "fov", "float", 40.);
        set(node, "fov_axis", "string", std::string("smaller"));
        set(node, "near_clip", "float", 1e-3 * length(offset_));
        set(node, "far_clip", "float", 1e3 * length(offset_));
        set(node, "to_world", "transform", Transform::look_at(eye, target_, up_));
        own_ = node;
    }
}

void OrbitCamera::turn(double right, double up) {
    moved_ = true;
    const Transform around = Transform::rotate(compass_.up, right);
    offset_ = around.map_vector(offset_);
    up_ = around.map_vector(up_);
    const double now = compass_.angles(offset_).second;
    const double step = up > 0 ? std::min(up, std::max(0., steepest - now))
                               : std::max(up, std::min(0., -steepest - now));
    if (step == 0) return;
    Vec3d side = cross(offset_, compass_.up);
    if (length(side) < 1e-3 * length(offset_)) side = cross(offset_, up_);
    const Transform lift = Transform::rotate(normalize(side), step);
    offset_ = lift.map_vector(offset_);
    up_ = lift.map_vector(up_);
}

void OrbitCamera::pan(double right, double up) {
    moved_ = true;
    const double height = height_per_unit_ * (parallel_ ? scale_ : length(offset_));
    const Vec3d across = normalize(cross(up_, offset_));
    target_ = target_ - across * (right * height) - up_ * (up * height);
}

void OrbitCamera::zoom(double factor) {
    moved_ = true;
    if (parallel_)
        scale_ *= factor;
    else
        offset_ = offset_ * factor;
}

void OrbitCamera::look_from(const StageView& view) {
    moved_ = true;
    const double distance = length(offset_);
    target_ = middle_;
    offset_ = compass_.direction(view.azimuth, view.elevation) * distance;
    up_ = compass_.up;
    if (std::abs(view.elevation) > steepest)
        up_ = compass_.direction(view.azimuth, 0) * -std::copysign(1., view.elevation);
}

SceneNodePtr OrbitCamera::sensor() const {
    if (!moved_) return own_;
    auto node = std::make_shared<SceneNode>(*own_);
    Transform to_world = Transform::look_at(eye(), target_, up_);
    if (parallel_) to_world = to_world * Transform::scale({scale_, scale_, 1});
    put(*node, "to_world", "transform", to_world);
    const double distance = length(offset_);
    put(*node, "near_clip", "float", (parallel_ ? 1e-6 : 1e-4) * distance);
    put(*node, "far_clip", "float", 1e5 * distance);
    return node;
}

CameraPtr OrbitCamera::camera(double aspect) const {
    BuildContext context;
    // A copy: nodes remember what was asked of them, and this one may be in use elsewhere.
    return make_camera(SceneNode(*sensor()), float(aspect), context);
}

}  // namespace nacre::viewer
