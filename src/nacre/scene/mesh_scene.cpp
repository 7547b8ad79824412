// A bare mesh as a scene. Lengths are millimetres, y is up, the object stands on y = 0 and is
// looked at from +z.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "nacre/geometry/gltf_materials.h"
#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/layers/skin.h"
#include "nacre/optics/media.h"
#include "nacre/scene/gltf/shapes.h"
#include "nacre/scene/load.h"
#include "nacre/scene/scene_builder.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

/// The object's bounding sphere, about which everything is arranged.
struct Stage {
    Vec3d center;
    double radius;
};

/// 4 radii away; `white` is the radiance that it alone gives to a white surface turned towards it.
NodePtr lamp(const Stage& stage, const Vec3d& from, const Vec3f& color, double white) {
    const double distance = 4 * stage.radius;
    return ball_light(stage.center + from * distance, 0.9 * stage.radius, distance, color, white);
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

NodePtr camera_for(const Stage& stage, const MeshSceneOptions& options) {
    constexpr double fov = 26;  // about that of an 80 mm lens on 35 mm film: little distortion
    const double distance = 1.08 * stage.radius / std::sin(fov / 2 * std::numbers::pi / 180);
    auto camera = make_node("sensor", "perspective");
    set(camera, "fov", "float", fov);
    set(camera, "fov_axis", "string", std::string("smaller"));
    set(camera, "near_clip", "float", 0.01 * distance);
    set(camera, "far_clip", "float", 1000 * distance);
    set(camera, "to_world", "transform",
        Transform::look_at(stage.center + direction(28, 14) * distance, stage.center, {0, 1, 0}));
    auto film = make_node("film", "hdrfilm");
    set(film, "width", "integer", std::int64_t{options.width});
    set(film, "height", "integer", std::int64_t{options.height});
    add(camera, film);
    auto sampler = make_node("sampler", "sobol");
    set(sampler, "sample_count", "integer", std::int64_t{64});
    add(camera, sampler);
    return camera;
}

std::string_view material_of(const MeshSceneOptions& options) {
    return options.material ? std::string_view(*options.material) : "marble";
}

/// What fills the object, and its index of refraction.
struct Filling {
    NodePtr medium;
    double eta;
};

/// The coefficients are reduced ones, with isotropic scattering: what was measured, and by the
/// similarity relation as good as the true phase function after a few collisions.
Filling filling(std::string_view material) {
    Filling r;
    if (const MeasuredMedium* measured = translucent_material(material)) {
        r = {make_node("medium", "homogeneous"), measured->eta};
        set(r.medium, "material", "string", std::string(measured->name));
    } else {
        r = {make_node("medium", "skin"), SkinParameters{}.epidermis.eta};
    }
    add(r.medium, make_node("phase", "isotropic"));
    return r;
}

NodePtr translucent_shape(const Filling& filling) {
    auto boundary = make_node("bsdf", "dielectric");
    set(boundary, "int_ior", "float", filling.eta);
    set(boundary, "ext_ior", "float", 1.0);
    auto shape = make_node("shape", "obj");
    shape->id = "object";
    add(shape, boundary);
    add(shape, filling.medium, "interior");
    return shape;
}

/// Where the object comes to stand: in millimetres, centred above the origin, on y = 0.
struct Placement {
    Point3f foot;
    float scale;

    Placement(const Box3f& box, const std::string& name, double height_mm) {
        if (box.empty() || !(box.diagonal().y > 0.f))
            throw InputError(name + ": has no height along y, which is up; turn it upright");
        scale = static_cast<float>(height_mm) / box.diagonal().y;
        foot = {box.center().x, box.lower.y, box.center().z};
    }

    /// The mesh there, its outside outside.
    std::shared_ptr<Mesh> place(Mesh mesh) const {
        for (Point3f& p : mesh.positions) p = (p - foot) * scale;
        if (inspect(mesh).inside_out()) {
            for (Mesh::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
            for (Vec3f& n : mesh.normals) n = -n;
        }
        return std::make_shared<Mesh>(std::move(mesh));
    }
};

double height_of(const MeshSceneOptions& options) {
    const double height = options.height_mm.value_or(100.0);
    if (!(height > 0.0) || !std::isfinite(height))
        throw InputError(
            fmt::format("the height of the object must be positive; got {} mm", height));
    return height;
}

/// The placed shapes, whose meshes are in the context, with all that is around them.
Scene arrange(const std::vector<NodePtr>& shapes, BuildContext& context,
              const MeshSceneOptions& options) {
    Box3f box;
    for (const NodePtr& shape : shapes) box.extend(context.meshes.at(shape.get())->bounds());
    const Stage stage{Vec3d(box.center()), 0.5 * length(Vec3d(box.diagonal()))};
    auto root = make_node("scene", "");
    auto integrator = make_node("integrator", "volpath");
    add(root, integrator);
    add(root, camera_for(stage, options));
    auto sky = make_node("emitter", "constant");
    set_rgb(sky, "radiance", {0.13f, 0.14f, 0.16f});
    add(root, sky);
    // With the sky and the floor a white object in the key light comes to just below 1. The light
    // from behind is stronger, because what passes through the object is little; it stands high
    // enough to stay out of the picture.
    add(root, lamp(stage, direction(-25, 40), {1.12f, 0.98f, 0.78f}, 0.6));
    add(root, lamp(stage, direction(158, 40), {1.04f, 1.f, 0.9f}, 1.6));
    add(root, floor_under(stage, height_of(options)));
    for (const NodePtr& shape : shapes) {
        if (options.crease_angle) set(shape, "crease_angle", "float", *options.crease_angle);
        add(root, shape);
    }
    return build_scene(root, context, options.mode);
}

/// A glTF in its own materials.
Scene make_gltf_scene(const GltfObject& object, const std::string& name,
                      const MeshSceneOptions& options) {
    Box3f box;
    for (const GltfPart& part : object.parts) box.extend(part.mesh->bounds());
    const Placement placement(box, name, height_of(options));
    GltfObject placed = object;
    for (GltfPart& part : placed.parts) part.mesh = placement.place(*part.mesh);
    BuildContext context;
    const auto shapes = make_gltf_shapes(placed, name, 1. / placement.scale, context);
    return arrange(shapes, context, options);
}

}  // namespace

const MeasuredMedium* translucent_material(std::string_view name) {
    if (const MeasuredMedium* medium = measured_media().look(name)) return medium;
    if (plain_name(name) == "skin") return nullptr;
    std::vector<std::string_view> names = measured_media().names();
    names.emplace_back("skin");
    throw InputError(unknown_name(measured_media().what(), name, names));
}

Scene make_mesh_scene(std::shared_ptr<Mesh> mesh, const MeshSceneOptions& options) {
    const Filling inside = filling(material_of(options));
    const std::string name = mesh->name.empty() ? "mesh" : mesh->name;
    const Placement placement(mesh->bounds(), name, height_of(options));
    auto shape = translucent_shape(inside);
    if (!mesh->name.empty()) shape->id = mesh->name;
    BuildContext context;
    context.meshes[shape.get()] = placement.place(*mesh);
    return arrange({shape}, context, options);
}

Scene load_mesh_scene(const std::filesystem::path& file, const MeshSceneOptions& options) {
    filling(material_of(options));  // a wrong name is told before a large mesh is read
    if (has_gltf_extension(file) && !options.material) {
        const GltfObject object = load_gltf(file);
        if (object.has_materials()) return make_gltf_scene(object, file.string(), options);
    }
    std::shared_ptr<Mesh> mesh = load_mesh(file);
    if (mesh->name.empty()) mesh->name = file.filename().string();
    return make_mesh_scene(std::move(mesh), options);
}

}  // namespace nacre
