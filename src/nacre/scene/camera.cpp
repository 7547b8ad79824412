#include "nacre/scene/camera.h"

#include <charconv>
#include <numbers>

#include "nacre/math/error.h"
#include "nacre/math/warp.h"
#include "nacre/scene/build.h"
#include "nacre/text/names.h"

namespace nacre {

namespace {

constexpr double degrees = std::numbers::pi / 180.0;

/// Where the camera stands and how its local axes lie in the world. A scale in the transform
/// changes the length of a camera-space unit: clipping distances are measured in those units.
struct Placement {
    Point3f origin;
    Vec3f x, y, z;

    explicit Placement(const Transform& to_world)
        : origin(to_world.point({0.f, 0.f, 0.f})),
          x(to_world.vector({1.f, 0.f, 0.f})),
          y(to_world.vector({0.f, 1.f, 0.f})),
          z(to_world.vector({0.f, 0.f, 1.f})) {}

    Vec3f vector(const Vec3f& v) const { return x * v.x + y * v.y + z * v.z; }

    /// The ray from `o` along `d` (both in camera space, d.z > 0), clipped at the planes z = near
    /// and z = far.
    Ray ray(const Point3f& o, const Vec3f& d, float near, float far) const {
        const Vec3f direction = vector(d);
        const float length_of_d = length(direction);
        const float t_per_z = length_of_d / d.z;
        return {origin + vector(o), direction * (1.f / length_of_d), (near - o.z) * t_per_z,
                (far - o.z) * t_per_z};
    }
};

struct Clip {
    float near, far;
};

Clip get_clip(const SceneNode& node) {
    const double near = node.get_float("near_clip", 1e-2);
    const double far = node.get_float("far_clip", 1e4);
    if (!(near > 0.0))
        node.fail_at("near_clip", fmt::format("near_clip must be greater than 0; got {}", near));
    if (!(far > near))
        node.fail_at(
            node.has("far_clip") ? "far_clip" : "near_clip",
            fmt::format("far_clip must be greater than near_clip; got {} and {}", far, near));
    return {static_cast<float>(near), static_cast<float>(far)};
}

/// "50mm" or "50": millimetres of focal length for 35 mm film.
double parse_focal_length(const SceneNode& node) {
    std::string text = node.get_string("focal_length", "50mm");
    std::string_view number = text;
    if (number.ends_with("mm")) number.remove_suffix(2);
    double mm = 0.0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), mm);
    if (error != std::errc() || end != number.data() + number.size() || !(mm > 0.0) ||
        !std::isfinite(mm))
        node.fail_at("focal_length",
                     fmt::format("focal_length must be a length in millimetres such as '50mm'; got "
                                 "'{}'",
                                 text));
    return mm;
}

/// Half the width of the film at distance 1.
double half_width(const SceneNode& node, double aspect) {
    if (node.has("fov") && node.has("focal_length"))
        node.fail_at("focal_length", "give either fov or focal_length, not both");
    std::string axis = node.get_choice("fov_axis", {"x", "y", "diagonal", "smaller", "larger"});
    double tangent;
    if (node.has("fov")) {
        const double fov = node.get_float("fov");
        if (!(fov > 0.0 && fov < 180.0))
            node.fail_at("fov", fmt::format("fov must lie between 0 and 180 degrees; got {}", fov));
        tangent = std::tan(0.5 * fov * degrees);
    } else {
        // The frame of 35 mm film is 36 mm by 24 mm; its diagonal becomes that of our film.
        tangent = std::hypot(36.0, 24.0) / (2.0 * parse_focal_length(node));
        axis = "diagonal";
    }
    if (axis == "smaller") axis = aspect > 1.0 ? "y" : "x";
    if (axis == "larger") axis = aspect > 1.0 ? "x" : "y";
    if (axis == "y") return tangent * aspect;
    if (axis == "diagonal") return tangent / std::sqrt(1.0 + 1.0 / (aspect * aspect));
    return tangent;
}

/// Nothing moves in a scene of nacre, so the shutter has no effect; files that set it are read.
void accept_shutter(const SceneNode& node) {
    node.get_float("shutter_open", 0.0);
    node.get_float("shutter_close", 0.0);
}

/// The map from the film to the plane z = 1 of camera space, where x points to the left.
struct Film {
    float half_width, half_height;
    Vec2f offset;  ///< of the principal point, in widths and heights of the film

    Vec3f direction(Vec2f film) const {
        return {half_width * (1.f - 2.f * (film.x + offset.x)),
                half_height * (1.f - 2.f * (film.y + offset.y)), 1.f};
    }
};

Film get_film(const SceneNode& node, double aspect) {
    const double half = half_width(node, aspect);
    return {static_cast<float>(half),
            static_cast<float>(half / aspect),
            {static_cast<float>(node.get_float("principal_point_offset_x", 0.0)),
             static_cast<float>(node.get_float("principal_point_offset_y", 0.0))}};
}

class Perspective final : public Camera {
  public:
    Perspective(const Placement& placement, const Film& film, Clip clip)
        : placement_(placement), film_(film), clip_(clip) {}

    Ray ray(Vec2f film, Vec2f) const override {
        return placement_.ray({}, film_.direction(film), clip_.near, clip_.far);
    }

  private:
    Placement placement_;
    Film film_;
    Clip clip_;
};

class ThinLens final : public Camera {
  public:
    ThinLens(const Placement& placement, const Film& film, Clip clip, float aperture_radius,
             float focus_distance)
        : placement_(placement),
          film_(film),
          clip_(clip),
          radius_(aperture_radius),
          focus_(focus_distance) {}

    Ray ray(Vec2f film, Vec2f lens) const override {
        const Vec2f disk = square_to_disk(lens) * radius_;
        const Point3f on_lens{disk.x, disk.y, 0.f};
        const Point3f in_focus = film_.direction(film) * focus_;
        return placement_.ray(on_lens, in_focus - on_lens, clip_.near, clip_.far);
    }

  private:
    Placement placement_;
    Film film_;
    Clip clip_;
    float radius_, focus_;
};

class Orthographic final : public Camera {
  public:
    Orthographic(const Placement& placement, float aspect, Clip clip)
        : placement_(placement), aspect_(aspect), clip_(clip) {}

    Ray ray(Vec2f film, Vec2f) const override {
        return placement_.ray({1.f - 2.f * film.x, (1.f - 2.f * film.y) / aspect_, 0.f},
                              {0.f, 0.f, 1.f}, clip_.near, clip_.far);
    }

  private:
    Placement placement_;
    float aspect_;
    Clip clip_;
};

CameraPtr make_perspective(const SceneNode& node, float aspect) {
    return std::make_shared<Perspective>(Placement(node.get_transform("to_world")),
                                         get_film(node, aspect), get_clip(node));
}

CameraPtr make_thin_lens(const SceneNode& node, float aspect) {
    const Clip clip = get_clip(node);
    const double radius = node.get_float("aperture_radius");
    if (!(radius >= 0.0))
        node.fail_at("aperture_radius",
                     fmt::format("aperture_radius must not be negative; got {}", radius));
    const double focus = node.get_float("focus_distance", clip.far);
    if (!(focus > 0.0))
        node.fail_at("focus_distance",
                     fmt::format("focus_distance must be greater than 0; got {}", focus));
    return std::make_shared<ThinLens>(Placement(node.get_transform("to_world")),
                                      get_film(node, aspect), clip, static_cast<float>(radius),
                                      static_cast<float>(focus));
}

CameraPtr make_orthographic(const SceneNode& node, float aspect) {
    return std::make_shared<Orthographic>(Placement(node.get_transform("to_world")), aspect,
                                          get_clip(node));
}

using Factory = CameraPtr (*)(const SceneNode&, float);
constexpr std::pair<std::string_view, Factory> factories[] = {
    {"perspective", make_perspective},
    {"thinlens", make_thin_lens},
    {"orthographic", make_orthographic},
};

}  // namespace

CameraPtr make_camera(const SceneNode& node, float aspect, BuildContext&) {
    std::vector<std::string> known;
    for (const auto& [name, factory] : factories) {
        if (name == node.type) {
            accept_shutter(node);
            // Mitsuba's cameras all take it; where everything is sharp it changes nothing.
            if (name != "thinlens") node.get_float("focus_distance", 0.0);
            CameraPtr camera = factory(node, aspect);
            // Read by whoever builds the rest of the scene.
            for (const char* tag : {"film", "sampler", "medium"}) node.children_of(tag);
            node.check_all_used();
            return camera;
        }
        known.emplace_back(name);
    }
    node.fail(unknown_name("sensor type", node.type, known));
}

}  // namespace nacre
