// A bare mesh as a scene: upright, in millimetres, in a medium. What stands around it is in stage.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nacre/geometry/gltf_materials.h"
#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/layers/skin.h"
#include "nacre/optics/media.h"
#include "nacre/scene/gltf/shapes.h"
#include "nacre/scene/load.h"
#include "nacre/scene/scene_builder.h"
#include "nacre/scene/stage_nodes.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

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

/// A size that is not given: this tall, unless something much wider would become a landscape.
constexpr double usual_height = 100, usual_width = 250;

/// Where the object comes to stand: upright, in millimetres, centred above the origin, on y = 0.
struct Placement {
    MeshPose pose;
    Point3f foot;
    float scale;
    double height;

    Placement(const MeshPose& pose_, const Box3f& box, const std::string& name,
              const MeshSceneOptions& options)
        : pose(pose_), height(options.height_mm.value_or(usual_height)) {
        if (options.pose) *options.pose = pose;
        const Vec3f size = box.diagonal();
        if (box.empty() || !(size.y > 0.f))
            throw InputError(
                fmt::format("{}: has no height along {}, which is up; turn it upright "
                            "(--up)",
                            name, name_of(pose.up)));
        const double widest = std::max(size.x, size.z);
        if (!options.height_mm && widest * usual_height > usual_width * size.y)
            height = usual_width * (size.y / widest);
        scale = static_cast<float>(height) / size.y;
        foot = {box.center().x, box.lower.y, box.center().z};
    }

    /// The mesh there, its outside outside.
    std::shared_ptr<Mesh> place(Mesh mesh) const {
        turn(pose, mesh);
        for (Point3f& p : mesh.positions) p = (p - foot) * scale;
        if (inspect(mesh).inside_out()) {
            for (Mesh::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
            for (Vec3f& n : mesh.normals) n = -n;
        }
        return std::make_shared<Mesh>(std::move(mesh));
    }

    static void turn(const MeshPose& pose, Mesh& mesh) {
        if (pose.is_identity()) return;
        for (Point3f& p : mesh.positions) p = pose.turn(p);
        for (Vec3f& n : mesh.normals) n = pose.turn(n);
    }
    static Box3f turned(const MeshPose& pose, const Box3f& box) {
        Box3f r;
        if (box.empty()) return r;
        r.extend(pose.turn(box.lower));
        r.extend(pose.turn(box.upper));
        return r;
    }
};

void check_height(const MeshSceneOptions& options) {
    const double height = options.height_mm.value_or(usual_height);
    if (!(height > 0.0) || !std::isfinite(height))
        throw InputError(
            fmt::format("the height of the object must be positive; got {} mm", height));
}

/// The placed shapes, whose meshes are in the context, with all that is around them.
Scene arrange(const std::vector<NodePtr>& shapes, double height, BuildContext& context,
              const MeshSceneOptions& options) {
    Box3f box;
    for (const NodePtr& shape : shapes) box.extend(context.meshes.at(shape.get())->bounds());
    auto root = make_node("scene", "");
    auto integrator = make_node("integrator", "volpath");
    add(root, integrator);
    set_stage(root, {box, height, options.width, options.height}, options.stage);
    for (const NodePtr& shape : shapes) {
        if (options.crease_angle) set(shape, "crease_angle", "float", *options.crease_angle);
        add(root, shape);
    }
    if (options.stage.environment) context.search_path.emplace_back(".");
    Scene scene = build_scene(root, context, options.mode);
    scene.background = stage_background(options.stage, context);
    return scene;
}

/// A glTF in its own materials.
Scene make_gltf_scene(const GltfObject& object, const std::string& name,
                      const MeshSceneOptions& options) {
    Box3f box;
    for (const GltfPart& part : object.parts) box.extend(part.mesh->bounds());
    MeshPose pose;
    pose.up = options.up.value_or(pose.up);
    pose.front = usual_front(pose.up);
    const Placement placement(pose, Placement::turned(pose, box), name, options);
    GltfObject placed = object;
    for (GltfPart& part : placed.parts) part.mesh = placement.place(*part.mesh);
    BuildContext context;
    const auto shapes = make_gltf_shapes(placed, name, 1. / placement.scale, context);
    return arrange(shapes, placement.height, context, options);
}

/// A mesh in one material.
Scene make_scene(const Mesh& mesh, const MeshPose& pose, const MeshSceneOptions& options) {
    const Filling inside = filling(material_of(options));
    const std::string name = mesh.name.empty() ? "mesh" : mesh.name;
    const Placement placement(pose, Placement::turned(pose, mesh.bounds()), name, options);
    auto shape = translucent_shape(inside);
    if (!mesh.name.empty()) shape->id = mesh.name;
    BuildContext context;
    context.meshes[shape.get()] = placement.place(mesh);
    return arrange({shape}, placement.height, context, options);
}

}  // namespace

const MeasuredMedium* translucent_material(std::string_view name) {
    if (const MeasuredMedium* medium = measured_media().look(name)) return medium;
    if (plain_name(name) == "skin") return nullptr;
    std::vector<std::string_view> names = measured_media().names();
    names.emplace_back("skin");
    throw InputError(unknown_name(measured_media().what(), name, names));
}

MeshPose pose_of_file(const std::filesystem::path& file, const Mesh& mesh,
                      std::optional<SignedAxis> given_up) {
    if (has_gltf_extension(file)) {  // which says it
        const SignedAxis up = given_up.value_or(SignedAxis{1, 1});
        return {.up = up, .front = usual_front(up)};
    }
    // Printers and CAD, whose format it is, build upwards along z.
    const bool is_stl = plain_name(file.extension().string()) == ".stl";
    return guess_pose(mesh, is_stl ? SignedAxis{2, 1} : SignedAxis{1, 1}, given_up);
}

Scene make_mesh_scene(std::shared_ptr<Mesh> mesh, const MeshSceneOptions& options) {
    check_height(options);
    return make_scene(*mesh, guess_pose(*mesh, {1, 1}, options.up), options);
}

Scene load_mesh_scene(const std::filesystem::path& file, const MeshSceneOptions& options) {
    filling(material_of(options));  // a wrong name is told before a large mesh is read
    check_height(options);
    if (has_gltf_extension(file) && !options.material) {
        const GltfObject object = load_gltf(file);
        if (object.has_materials()) return make_gltf_scene(object, file.string(), options);
    }
    std::shared_ptr<Mesh> mesh = load_mesh(file);
    if (mesh->name.empty()) mesh->name = file.filename().string();
    return make_scene(*mesh, pose_of_file(file, *mesh, options.up), options);
}

}  // namespace nacre
