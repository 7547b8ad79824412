#include "apps/viewer/scene_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/put_value.h"
#include "nacre/layers/skin.h"
#include "nacre/math/error.h"
#include "nacre/optics/media.h"
#include "nacre/realtime/moved_light.h"
#include "nacre/scene/load.h"
#include "nacre/scene/subsurface.h"
#include "nacre/scene/xml/write_nodes.h"

namespace nacre::viewer {
namespace {

constexpr std::string_view matter[] = {"material", "sigma_s",       "sigma_a", "sigma_t",
                                       "albedo",   "surface_color", "radius",  "scale"};

bool is_matter(const SceneValue& v) {
    return std::ranges::find(matter, v.name) != std::end(matter);
}

void put_rgb(SceneNode& node, const char* name, const Vec3f& rgb) {
    ColorValue color;
    color.rgb = rgb;
    put(node, name, "rgb", color);
}

/// The parameters of a <medium> or <subsurface>. Coefficients are per millimetre there, too.
void put_matter(SceneNode& node, const MaterialEdit& m) {
    std::erase_if(node.values, is_matter);
    switch (m.kind) {
        case MaterialEdit::Kind::scene:
            break;
        case MaterialEdit::Kind::measured:
            put(node, "material", "string", m.name);
            break;
        case MaterialEdit::Kind::coefficients:
            put_rgb(node, "sigma_s", m.sigma_s);
            put_rgb(node, "sigma_a", m.sigma_a);
            break;
        case MaterialEdit::Kind::artist:
            put_rgb(node, "surface_color", m.color);
            put_rgb(node, "radius", m.radius);
            break;
    }
}

bool is_skin(const MaterialEdit& m) {
    return m.kind == MaterialEdit::Kind::measured && !translucent_material(m.name);
}

double eta_of(const MaterialEdit& m) {
    if (m.kind != MaterialEdit::Kind::measured) return m.eta;
    const MeasuredMedium* measured = translucent_material(m.name);
    return measured ? measured->eta : SkinParameters{}.epidermis.eta;
}

NodePtr medium_of(const MaterialEdit& m) {
    NodePtr medium = make_node("medium", is_skin(m) ? "skin" : "homogeneous");
    if (!is_skin(m)) put_matter(*medium, m);
    add(medium, make_node("phase", "isotropic"));
    return medium;
}

/// Materials of this kind are behind a boundary of their own index, as smooth as before.
SceneNodePtr shape_of(const SceneNode& old, const MaterialEdit& m) {
    auto shape = std::make_shared<SceneNode>(old);
    bool has_boundary = false;
    for (SceneNode::Child& child : shape->children) {
        if (child.name == "interior") child.node = medium_of(m);
        if (child.node->tag != "bsdf") continue;
        has_boundary = true;
        if (child.node->type != "dielectric" && child.node->type != "roughdielectric") continue;
        auto boundary = std::make_shared<SceneNode>(*child.node);
        put(*boundary, "int_ior", "float", eta_of(m));
        child.node = boundary;
    }
    for (SceneNode::Child& child : shape->children) {
        if (child.node->tag != "subsurface") continue;
        auto subsurface = std::make_shared<SceneNode>(*child.node);
        if (is_skin(m))
            throw InputError(
                "material 'skin' is a medium by wavelength, which <subsurface> cannot hold; "
                "choose skin1 or skin2");
        put_matter(*subsurface, m);
        // A phase function of the old matter does not fit reduced coefficients.
        std::erase_if(subsurface->children,
                      [](const SceneNode::Child& c) { return c.node->tag == "phase"; });
        if (!has_boundary) put(*subsurface, "int_ior", "float", eta_of(m));
        child.node = subsurface;
    }
    return shape;
}

ColorValue brighter(ColorValue c, double factor) {
    const float f = float(factor);
    c.rgb = c.rgb * f;
    c.value *= f;
    for (float& v : c.values) v *= f;
    return c;
}

/// An emitter that shines `factor` times as bright.
SceneNodePtr brighter(const SceneNode& emitter, double factor) {
    auto node = std::make_shared<SceneNode>(emitter);
    const char* name = emitter.type == "envmap"                            ? "scale"
                       : emitter.type == "point" || emitter.type == "spot" ? "intensity"
                       : emitter.type == "directional"                     ? "irradiance"
                                                                           : "radiance";
    for (SceneValue& v : node->values) {
        if (v.name != name) continue;
        if (double* number = std::get_if<double>(&v.value)) *number *= factor;
        if (auto* whole = std::get_if<std::int64_t>(&v.value)) v.value = double(*whole) * factor;
        if (auto* color = std::get_if<ColorValue>(&v.value)) *color = brighter(*color, factor);
        return node;
    }
    if (emitter.child(name))
        throw InputError(fmt::format("{}: its {} is a picture, whose brightness stays as it is",
                                     emitter.describe(), name));
    put(*node, name, "float", factor);  // it was left out, and is 1
    return node;
}

/// The object turned about the middle.
SceneNodePtr turned(const SceneNode& old, const Transform& turn) {
    auto node = std::make_shared<SceneNode>(old);
    for (SceneValue& v : node->values) {
        Vec3d* vector = std::get_if<Vec3d>(&v.value);
        if (!vector || node->tag == "shape") continue;
        if (v.name == "position") *vector = turn.map_point(*vector);
        if (v.name == "direction") *vector = turn.map_vector(*vector);
        if (v.name == "position" || v.name == "direction") return node;
    }
    put(*node, "to_world", "transform", turn * old.get_transform("to_world"));
    return node;
}

std::shared_ptr<Mesh> turned(const Mesh& old, const Transform& turn) {
    auto mesh = std::make_shared<Mesh>(old);
    mesh->positions.reserve(mesh->positions.size() + 1);
    for (Point3f& p : mesh->positions) p = turn.point(p);
    for (Vec3f& n : mesh->normals) n = normalize(turn.normal(n));
    return mesh;
}

Transform about(const Vec3d& middle, const Transform& turn) {
    return Transform::translate(middle) * turn * Transform::translate(middle * -1.);
}

/// Whether nothing opaque but lamps stands in that direction: no wall behind which a lamp would go.
bool is_free(const Scene& scene, const Vec3d& middle, const Vec3d& direction) {
    Ray ray{Point3f(middle), Vec3f(direction)};
    for (int step = 0; step < 64; ++step) {
        const auto hit = scene.rays.intersect(ray);
        if (!hit) return true;
        const ShapeBinding& shape = scene.shapes[hit->shape];
        if (!shape.light && !is_translucent(shape)) return false;
        ray.o = scene.rays.surface_point(ray, *hit).spawn(ray.d);
    }
    return true;
}

bool is_turned(const SceneLight& light, const LightEdit& edit) {
    return light.turns && (edit.azimuth != light.azimuth || edit.elevation != light.elevation);
}

/// From where a light stands to where the edit asks for.
Transform turn_of(const Scene& scene, const SceneLight& light, const LightEdit& edit,
                  const Compass& compass, const Vec3d& middle) {
    // Down to the floor, about, and up again.
    const Vec3d side = cross(compass.direction(light.azimuth, 0), compass.up);
    Transform turn = Transform::rotate(compass.up, edit.azimuth - light.azimuth) *
                     Transform::rotate(side, edit.elevation - light.elevation);
    if (light.behind > 1 && is_free(scene, middle, compass.direction(edit.azimuth, edit.elevation)))
        turn = turn * Transform::scale({light.behind, light.behind, light.behind});
    return about(middle, turn);
}

}  // namespace

void check(const MaterialEdit& m) {
    if (m.kind == MaterialEdit::Kind::measured) translucent_material(m.name);
    const auto refuse = [](const char* what, const char* range, const Vec3f& v) {
        throw InputError(fmt::format("{} ({:g}, {:g}, {:g}) must {}", what, v.x, v.y, v.z, range));
    };
    for (int i = 0; i < 3; ++i) {
        if (m.kind == MaterialEdit::Kind::coefficients) {
            if (!(m.sigma_s[i] >= 0 && m.sigma_s[i] < 1e6f))
                refuse("sigma_s", "lie within [0, 1e6)", m.sigma_s);
            if (!(m.sigma_a[i] >= 0 && m.sigma_a[i] < 1e6f))
                refuse("sigma_a", "lie within [0, 1e6)", m.sigma_a);
        }
        if (m.kind != MaterialEdit::Kind::artist) continue;
        if (!(m.color[i] >= 0 && m.color[i] <= 1))
            refuse("the colour", "lie within [0, 1]", m.color);
        if (!(m.radius[i] > 0 && m.radius[i] < 1e6f))
            refuse("the radius", "lie within (0, 1e6)", m.radius);
    }
    if (!(m.eta >= 1 && m.eta <= 4))
        throw InputError(fmt::format("the index of refraction {:g} must lie within [1, 4]", m.eta));
}

std::vector<SceneLight> lights_of(const Scene& scene, const OrbitCamera& camera) {
    const Compass& compass = camera.compass();
    const Vec3d middle = camera.middle();
    std::vector<SceneLight> lights;
    // Those of shapes come first in the scene, then the others in their order.
    std::size_t next = std::size_t(std::ranges::count_if(
        scene.shapes, [](const ShapeBinding& s) { return s.light != nullptr; }));
    const auto describe = [&](SceneLight light, const Vec3d& to) {
        if (light.turns && length(to) > 0)
            std::tie(light.azimuth, light.elevation) = compass.angles(to);
        if (light.shape < scene.shapes.size()) {
            for (const LightPtr& l : scene.lights)
                if (l.get() == scene.shapes[light.shape].light) light.light = l;
        } else if (next < scene.lights.size()) {
            light.light = scene.lights[next++];
        }
        lights.push_back(std::move(light));
    };
    std::size_t shape = 0;
    for (std::size_t i = 0; i < scene.root->children.size(); ++i) {
        const SceneNode& node = *scene.root->children[i].node;
        if (node.tag == "shape") {
            const Box3f box = scene.rays.bounds(std::uint32_t(shape));
            for (std::size_t k = 0; k < node.children.size(); ++k)
                if (node.children[k].node->tag == "emitter") {
                    const Vec3d to = Vec3d(box.center()) - middle;
                    const double nearest = length(to) - 0.5 * double(length(box.diagonal())),
                                 clear = 1.1 * length(camera.eye() - middle);
                    SceneLight lamp{fmt::format("lamp ({})", node.type), {i, k}, shape, true};
                    if (nearest > 0 && nearest < clear) lamp.behind = clear / nearest;
                    describe(std::move(lamp), to);
                }
            ++shape;
        }
        if (node.tag != "emitter") continue;
        if (node.type == "directional") {
            const Vec3d d = node.has("direction")
                                ? node.get_vector("direction", {})
                                : node.get_transform("to_world").map_vector({0, 0, 1});
            describe({"directional", {i}, ~std::size_t{0}, true}, d * -1.);
        } else if (node.type == "constant") {
            describe({"sky", {i}}, {});
        } else {
            // Surroundings turn from where they are.
            const Vec3d at = node.type == "envmap" ? middle + compass.front
                             : node.has("position")
                                 ? node.get_vector("position", {})
                                 : node.get_transform("to_world").map_point({0, 0, 0});
            describe(
                {node.type == "envmap" ? "surroundings" : node.type, {i}, ~std::size_t{0}, true},
                at - middle);
        }
    }
    return lights;
}

std::vector<LightPtr> moved_lights(const Scene& scene, const std::vector<SceneLight>& lights,
                                   const std::vector<LightEdit>& edits, const Compass& compass,
                                   const Vec3d& middle) {
    std::vector<LightPtr> result = scene.lights;
    for (std::size_t i = 0; i < std::min(lights.size(), edits.size()); ++i) {
        const bool turned = is_turned(lights[i], edits[i]);
        if (!turned && edits[i].brightness == 1) continue;
        const Transform to =
            turned ? turn_of(scene, lights[i], edits[i], compass, middle) : Transform();
        for (LightPtr& light : result)
            if (light == lights[i].light)
                light = std::make_shared<MovedLight>(light, scene, to, edits[i].brightness);
    }
    return result;
}

SceneParts edited(const Scene& scene, const SceneParts& from, const MaterialEdit& material,
                  const std::vector<SceneLight>& lights, const std::vector<LightEdit>& edits,
                  const Compass& compass, const Vec3d& middle) {
    check(material);
    SceneParts result = from;
    auto root = std::make_shared<SceneNode>(*from.root);
    std::size_t shape = 0;
    for (SceneNode::Child& child : root->children)
        if (child.node->tag == "shape" && is_translucent(scene.shapes[shape++]) &&
            material.kind != MaterialEdit::Kind::scene)
            child.node = shape_of(*child.node, material);
    for (std::size_t i = 0; i < std::min(lights.size(), edits.size()); ++i) {
        const SceneLight& light = lights[i];
        const LightEdit& edit = edits[i];
        SceneNodePtr& outer = root->children[light.place[0]].node;
        if (edit.brightness != 1) {
            if (light.place.size() == 1) {
                outer = brighter(*outer, edit.brightness);
            } else {
                auto lamp = std::make_shared<SceneNode>(*outer);
                SceneNodePtr& emitter = lamp->children[light.place[1]].node;
                emitter = brighter(*emitter, edit.brightness);
                outer = lamp;
            }
        }
        if (!is_turned(light, edit)) continue;
        const Transform turn = turn_of(scene, light, edit, compass, middle);
        outer = turned(*outer, turn);
        if (light.shape < result.meshes.size() && result.meshes[light.shape])
            result.meshes[light.shape] = turned(*result.meshes[light.shape], turn);
    }
    result.root = root;
    return result;
}

}  // namespace nacre::viewer
