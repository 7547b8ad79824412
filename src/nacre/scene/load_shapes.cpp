// Shapes of a scene file, with their material, media and light.
#include <fmt/format.h>

#include "nacre/geometry/figure.h"
#include "nacre/geometry/mesh_build.h"
#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/scene/scene_builder.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

using AddGeometry = std::uint32_t (*)(const SceneNode&, RayScene&, BuildContext&);

/// Applies the map in place. Where it mirrors, triangles are turned round, so that
/// counter-clockwise stays outside.
void apply(const Transform& to_world, Mesh& mesh) {
    if (to_world.is_identity()) return;
    for (Point3f& p : mesh.positions) p = to_world.point(p);
    for (Vec3f& n : mesh.normals) n = normalize(to_world.normal(n));
    if (to_world.swaps_handedness())
        for (Mesh::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

std::uint32_t add_mesh(const SceneNode& node, std::shared_ptr<Mesh> mesh, RayScene& rays) {
    const bool face_normals = node.get_bool("face_normals", false);
    const bool flip_normals = node.get_bool("flip_normals", false);
    return rays.add(std::move(mesh), face_normals, flip_normals);
}

/// A mesh without normals is smooth, but for its hard edges, unless its faces are asked for. An
/// angle that is given replaces the normals of the file.
std::uint32_t add_read(const SceneNode& node, std::shared_ptr<Mesh> mesh, RayScene& rays) {
    const bool given = node.has("crease_angle");
    const double angle = node.get_float_in("crease_angle", default_crease_angle, 0, 180);
    if (!node.get_bool("face_normals", false) && (given || mesh->normals.empty()))
        compute_normals(*mesh, angle);
    return add_mesh(node, std::move(mesh), rays);
}

std::uint32_t add_mesh_file(const SceneNode& node, RayScene& rays, BuildContext& context) {
    const auto in_memory = context.meshes.find(&node);
    if (in_memory != context.meshes.end()) return add_read(node, in_memory->second, rays);
    // Options first: a wrong one is told before the file is looked for.
    const MeshOptions options = read_mesh_options(node);
    return add_read(node, load_mesh(find_mesh_file(node, context), options), rays);
}

std::uint32_t add_built(const SceneNode& node, Mesh mesh, RayScene& rays) {
    mesh.name = node.type;
    apply(node.get_transform("to_world"), mesh);
    return add_mesh(node, std::make_shared<Mesh>(std::move(mesh)), rays);
}

std::uint32_t add_rectangle(const SceneNode& node, RayScene& rays, BuildContext&) {
    return add_built(node, make_rectangle(), rays);
}

std::uint32_t add_cube(const SceneNode& node, RayScene& rays, BuildContext&) {
    return add_built(node, make_cube(), rays);
}

/// <shape type="figure">: the built-in sculptures (geometry/figure.h), in mm as they stand.
std::uint32_t add_figure(const SceneNode& node, RayScene& rays, BuildContext& context) {
    const auto in_memory = context.meshes.find(&node);
    if (in_memory != context.meshes.end()) return add_mesh(node, in_memory->second, rays);
    const std::string name = node.get_choice("name", {"bust", "pot", "drape"});
    const double resolution = node.get_float_in("resolution", 1.6, 0.2, 8.);
    Mesh mesh = make_figure(static_cast<float>(resolution), name);
    apply(node.get_transform("to_world"), mesh);
    return add_mesh(node, std::make_shared<Mesh>(std::move(mesh)), rays);
}

double get_radius(const SceneNode& node) {
    const double radius = node.get_float("radius", 1.0);
    if (!(radius > 0.0))
        node.fail_at("radius", fmt::format("'radius' of {} must be positive; got {}",
                                           node.describe(), radius));
    return radius;
}

std::uint32_t add_sphere(const SceneNode& node, RayScene& rays, BuildContext&) {
    const Transform to_world = node.get_transform("to_world");
    const Vec3d x = to_world.map_vector({1, 0, 0}), y = to_world.map_vector({0, 1, 0}),
                z = to_world.map_vector({0, 0, 1});
    const double scale = length(x);
    // Files give six digits or so.
    const double tolerance = 1e-4 * scale;
    if (std::abs(length(y) - scale) > tolerance || std::abs(length(z) - scale) > tolerance ||
        std::abs(dot(x, y)) > tolerance * scale || std::abs(dot(y, z)) > tolerance * scale ||
        std::abs(dot(z, x)) > tolerance * scale)
        node.fail_at("to_world",
                     "a sphere must stay a sphere: use the same scale along all axes, or a mesh");
    Sphere sphere;
    sphere.center = Point3f(to_world.map_point(node.get_vector("center", {0, 0, 0})));
    sphere.radius = static_cast<float>(get_radius(node) * scale);
    sphere.flip_normals = node.get_bool("flip_normals", false);
    sphere.x = x / scale, sphere.y = y / scale, sphere.z = z / scale;
    return rays.add(Primitive(sphere));
}

std::uint32_t add_disk(const SceneNode& node, RayScene& rays, BuildContext&) {
    return rays.add(
        Primitive(Disk{node.get_transform("to_world"), node.get_bool("flip_normals", false)}));
}

std::uint32_t add_cylinder(const SceneNode& node, RayScene& rays, BuildContext&) {
    const Vec3d p0 = node.get_vector("p0", {0, 0, 0}), p1 = node.get_vector("p1", {0, 0, 1});
    const double radius = get_radius(node), height = length(p1 - p0);
    if (!(height > 0.0))
        node.fail_at("p1", "the ends p0 and p1 of a cylinder must not be the same point");
    const Frame<double> frame = Frame<double>::around((p1 - p0) / height);
    const Vec3d s = frame.s * radius, t = frame.t * radius, n = frame.n * height;
    const Transform along({s.x, t.x, n.x, p0.x,  //
                           s.y, t.y, n.y, p0.y,  //
                           s.z, t.z, n.z, p0.z,  //
                           0, 0, 0, 1});
    return rays.add(Primitive(
        Cylinder{node.get_transform("to_world") * along, node.get_bool("flip_normals", false)}));
}

constexpr std::pair<std::string_view, AddGeometry> shape_types[] = {
    {"obj", add_mesh_file}, {"ply", add_mesh_file},       {"off", add_mesh_file},
    {"stl", add_mesh_file}, {"gltf", add_mesh_file},      {"serialized", add_mesh_file},
    {"sphere", add_sphere}, {"rectangle", add_rectangle}, {"cube", add_cube},
    {"disk", add_disk},     {"cylinder", add_cylinder},   {"figure", add_figure},
};

AddGeometry geometry_of(const SceneNode& node) {
    std::vector<std::string> known;
    for (const auto& [name, add] : shape_types) {
        if (name == node.type) return add;
        known.emplace_back(name);
    }
    if (node.type == "shapegroup" || node.type == "instance")
        node.fail(fmt::format("{}: nacre has no instances; write every shape by itself",
                              node.describe()));
    node.fail(unknown_name("shape type", node.type, known));
}

/// What is missing in a scene file: Mitsuba's default, black if the surface shines.
MaterialPtr default_material(const SceneNode& shape, bool shines, BuildContext& context) {
    const auto diffuse = make_node("bsdf", "diffuse");
    diffuse->location = shape.location;
    if (shines) diffuse->values.push_back({"reflectance", "float", 0.0, shape.location});
    context.made.push_back(diffuse);
    return make_material(*diffuse, context);
}

const SceneNode* only_child(const SceneNode& shape, const char* tag) {
    const auto found = shape.children_of(tag);
    if (found.size() > 1)
        throw InputError(fmt::format("{}: a second <{}> in {}; the first is at {}",
                                     found[1]->location.str(), tag, shape.describe(),
                                     found[0]->location.str()));
    return found.empty() ? nullptr : found[0]->node.get();
}

void warn_about_interior(const SceneNode& node, const ShapeBinding& shape, const Mesh* mesh,
                         BuildContext& context) {
    const auto warn = [&](const std::string& message) {
        const std::string where = node.location.file ? node.location.str() + ": " : "";
        context.warnings.push_back(fmt::format("{}'{}': {}", where, shape.name, message));
    };
    if (!(shape.material->flags() & (transmits | has_null)))
        warn("no light passes its material, so the medium inside cannot be seen");
    const bool flipped = node.get_bool("flip_normals", false);
    if (!mesh) {
        if (node.type != "sphere")
            warn(
                "the surface is open by itself; light in the medium inside gets lost unless other "
                "shapes close it");
        else if (flipped)
            warn(
                "flip_normals turns the surface inside out; the medium would fill the outside: "
                "leave it out");
        return;
    }
    MeshReport report = inspect(*mesh);
    if (flipped) report.volume = -report.volume;
    if (flipped && report.inside_out())
        warn(
            "flip_normals turns the surface inside out; the medium would fill the outside: leave "
            "it out");
    else if (const std::string message = warning(report, true); !message.empty())
        warn(message);
}

}  // namespace

MeshOptions read_mesh_options(const SceneNode& node) {
    MeshOptions options;
    options.to_world = node.get_transform("to_world");
    if (node.type == "serialized") {
        const std::int64_t index = node.get_int("shape_index", 0);
        if (index < 0 || index > 1'000'000)
            node.fail_at("shape_index", fmt::format("there is no mesh of number {}", index));
        options.shape_index = static_cast<int>(index);
    }
    if (node.has("flip_tex_coords"))
        options.flip_tex_coords = node.get_bool("flip_tex_coords", false);
    return options;
}

std::filesystem::path find_mesh_file(const SceneNode& node, BuildContext& context) {
    const std::filesystem::path file = context.file(node, "filename");
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool gltf = node.type == "gltf" && extension == ".glb";
    if (extension != "." + node.type && !gltf)
        node.fail_at("filename", fmt::format("{} reads .{} files, not '{}'", node.describe(),
                                             node.type, file.filename().string()));
    return file;
}

std::string name_of_shape(const SceneNode& shape) {
    if (!shape.id.empty()) return shape.id;
    for (const SceneValue& v : shape.values)
        if (v.name == "filename")
            if (const auto* file = std::get_if<std::string>(&v.value)) return *file;
    return shape.type;
}

void add_shape(const SceneNode& node, Scene& scene, BuildContext& context,
               std::vector<PendingAreaLight>& lights) {
    const AddGeometry add_geometry = geometry_of(node);
    ShapeBinding shape;
    shape.name = name_of_shape(node);
    const SceneNode* emitter = only_child(node, "emitter");
    if (emitter && emitter->type != "area")
        emitter->fail(
            fmt::format("{} cannot stand in a shape; only type 'area' can", emitter->describe()));
    const SceneNode* bsdf = only_child(node, "bsdf");
    shape.material =
        bsdf ? make_material(*bsdf, context) : default_material(node, emitter != nullptr, context);
    if (const SceneNode::Child* medium = node.child("interior", "medium"))
        shape.interior = add_medium(*medium->node, scene, context);
    if (const SceneNode::Child* medium = node.child("exterior", "medium"))
        shape.exterior = add_medium(*medium->node, scene, context);
    shape.separates_media = shape.interior || shape.exterior;
    if (const SceneNode* subsurface = only_child(node, "subsurface"))
        read_subsurface(*subsurface, shape, bsdf != nullptr, scene, context);
    for (const SceneNode::Child& c : node.children)
        if (c.node->tag == "medium" && c.name != "interior" && c.name != "exterior")
            throw InputError(
                fmt::format("{}: a medium of a shape is named 'interior' or "
                            "'exterior'",
                            c.location.str()));

    std::uint32_t index = 0;
    try {
        index = add_geometry(node, scene.rays, context);
    } catch (const InputError& e) {
        // Readers of meshes know their own file only.
        const std::string message = e.what();
        if (!node.location.file || message.starts_with(*node.location.file)) throw;
        node.fail(message);
    }
    node.check_all_used();
    if (emitter) lights.push_back({emitter, index});
    if (shape.interior) warn_about_interior(node, shape, scene.rays.mesh(index), context);
    scene.shapes.push_back(std::move(shape));
}

}  // namespace nacre
