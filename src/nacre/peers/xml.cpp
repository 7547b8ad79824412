#include "nacre/peers/xml.h"

#include <fmt/format.h>

#include <numbers>
#include <sstream>

#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/peers/albedo.h"
#include "nacre/peers/mesh.h"
#include "nacre/peers/view.h"
#include "nacre/peers/xml_values.h"
#include "nacre/scene/materials/index.h"

namespace nacre {
namespace {

using Element = pugi::xml_node;

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

class Writer {
  public:
    Writer(const PeerRequest& request, Substitutions& substitutions)
        : request_(request), scene_(request.scene), substitutions_(substitutions) {
        context_.search_path = scene_.search_path;
        context_.mm_per_unit = scene_.mm_per_unit;
    }

    MitsubaScene write() {
        pugi::xml_document document;
        Element root = document.append_child("scene");
        root.append_attribute("version") = "3.0.0";
        if (scene_.root->has("mm_per_unit")) same_ = false;  // Mitsuba does not know it
        write_integrator(root);
        write_sensor(root);
        for (const SceneNode::Child* child : scene_.root->children_of("emitter"))
            copy(*child->node, root);
        write_environment(root);
        if (scene_.background) substitutions_.add("the background is what lights the scene");
        for (shape_ = 0; shape_ < scene_.shapes.size(); ++shape_) write_shape(root);
        std::ostringstream text;
        document.save(text, "    ", pugi::format_default | pugi::format_no_declaration);
        return {text.str(),
                same_ && substitutions_.sentences.empty() && !request_.scene_file.empty()};
    }

  private:
    void substitute(const std::string& sentence) {
        substitutions_.add(fmt::format("'{}': {}", scene_.shapes[shape_].name, sentence));
    }

    void write_integrator(Element root) {
        const auto nodes = scene_.root->children_of("integrator");
        const SceneNode* node = nodes.empty() ? nullptr : nodes[0]->node.get();
        const bool media =
            scene_.camera_medium || std::ranges::any_of(scene_.shapes, [](const ShapeBinding& s) {
                return s.interior || s.exterior;
            });
        const std::string type = media ? "volpath" : "path";
        const bool simulates = node && is_one_of(node->type, {"volpath", "volpathmis"});
        if (!node || !(node->type == type || simulates) || node->has("distance_grid") ||
            node->has("guided_exits"))
            same_ = false;
        Element integrator = append_object(root, "integrator", simulates ? node->type : type);
        append_value(integrator, "integer", "max_depth",
                     std::to_string(scene_.integrator.max_depth));
        // Mitsuba's roulette ends one path in twenty at every scattering, however bright: of the
        // hundreds in a medium little would be left but rare, glaring paths. Unless the scene asks
        // for it there is none.
        const bool asked = node && node->has("rr_depth");
        if (media && !asked) same_ = false;
        append_value(integrator, "integer", "rr_depth",
                     std::to_string(media && !asked ? 100'000 : scene_.integrator.rr_depth));
        if (scene_.integrator.hide_emitters)
            append_value(integrator, "boolean", "hide_emitters", "true");
    }

    void write_sensor(Element root) {
        const auto nodes = scene_.root->children_of("sensor");
        const SceneNode* node = nodes.empty() ? nullptr : nodes[0]->node.get();
        Element sensor = append_object(root, "sensor", node ? node->type : "perspective");
        if (node) {
            copy_values(*node, sensor);
        } else {
            same_ = false;
            const PeerView view = view_of(*scene_.camera);
            append_value(sensor, "float", "fov",
                         fmt::format("{}", 360 / std::numbers::pi * std::atan(view.half_width)));
            append_value(sensor, "float", "near_clip", fmt::format("{}", view.near));
            append_value(sensor, "float", "far_clip", fmt::format("{}", view.far));
            const Vec3d left = view.right * -1.0, &up = view.up, &z = view.forward,
                        &o = view.origin;
            append_transform(sensor, "to_world",
                             Transform({left.x, up.x, z.x, o.x, left.y, up.y, z.y, o.y, left.z,
                                        up.z, z.z, o.z, 0, 0, 0, 1}));
        }
        // Nacre's other samplers exist there not at all, or only for certain numbers of samples.
        if (scene_.sampler.type != "independent") same_ = false;
        append_value(append_object(sensor, "sampler", "independent"), "integer", "sample_count",
                     std::to_string(request_.samples));
        write_film(sensor, node);
        if (scene_.camera_medium)
            write_medium(node->children_of("medium")[0]->node.get(), *scene_.camera_medium, sensor,
                         "");
    }

    void write_film(Element sensor, const SceneNode* sensor_node) {
        const FilmSettings& f = scene_.film;
        const auto nodes =
            sensor_node ? sensor_node->children_of("film") : std::vector<const SceneNode::Child*>();
        const auto size = [&](const char* name, std::int64_t otherwise) {
            return nodes.empty() ? otherwise : nodes[0]->node->get_int(name, otherwise);
        };
        const bool crop =
            f.crop_width > 0 && (f.crop_width != f.width || f.crop_height != f.height);
        if (size("width", 768) != f.width || size("height", 576) != f.height ||
            (crop && size("crop_width", 0) != f.crop_width) ||
            (!crop && !nodes.empty() && nodes[0]->node->has("crop_width")))
            same_ = false;
        Element film = append_object(sensor, "film", "hdrfilm");
        const auto integer = [&](const char* name, int value) {
            append_value(film, "integer", name, std::to_string(value));
        };
        integer("width", f.width);
        integer("height", f.height);
        if (crop) {
            integer("crop_offset_x", f.crop_x);
            integer("crop_offset_y", f.crop_y);
            integer("crop_width", f.crop_width);
            integer("crop_height", f.crop_height);
        }
        append_value(film, "string", "pixel_format", "rgb");
        append_value(film, "string", "component_format", "float32");
        Element filter = append_object(film, "rfilter", f.filter.type);
        const auto number = [&](const char* name, float value) {
            append_value(filter, "float", name, fmt::format("{}", value));
        };
        if (f.filter.radius > 0) number("radius", f.filter.radius);
        if (f.filter.type == "gaussian") number("stddev", f.filter.stddev);
        if (f.filter.type == "mitchell") number("A", f.filter.b), number("B", f.filter.c);
    }

    /// An environment that was made in memory, as the picture that its nodes lack.
    void write_environment(Element root) {
        if (!scene_.environment) return;
        for (const SceneNode::Child* child : scene_.root->children_of("emitter"))
            if (is_one_of(child->node->type, {"constant", "envmap"})) return;
        same_ = false;
        constexpr int width = 1024, height = 513;
        Image image(width, height);
        const Wavelengths w = Wavelengths::rgb_bands();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double phi = 2 * std::numbers::pi * (x + 0.5) / width,
                             theta = std::numbers::pi * y / (height - 1);
                const Vec3d d{std::sin(theta) * std::sin(phi), std::cos(theta),
                              -std::sin(theta) * std::cos(phi)};
                const Spectral radiance = scene_.environment->radiance(nullptr, Vec3f(d), w);
                for (int c = 0; c < 3; ++c) image.at(x, y, c) = radiance[c];
            }
        const std::filesystem::path file = request_.folder / "environment_mitsuba.exr";
        write_image(image, file);
        append_value(append_object(root, "emitter", "envmap"), "string", "filename",
                     std::filesystem::absolute(file).string());
        substitutions_.add(
            fmt::format("the environment, made in memory, is an image of {} x {} "
                        "pixels",
                        width, height));
    }

    void write_shape(Element root) {
        const SceneNode& node = shape_node(scene_, shape_);
        const ShapeBinding& binding = scene_.shapes[shape_];
        Element shape;
        if (scene_.rays.primitive(shape_) || is_one_of(node.type, {"rectangle", "cube"})) {
            shape = append_object(root, "shape", node.type);
            copy_values(node, shape);
        } else {
            if (!is_one_of(node.type, {"obj", "ply", "serialized"}) || !node.has("filename"))
                same_ = false;
            shape = append_object(root, "shape", "ply");
            const Mesh mesh = peer_mesh(scene_, shape_);
            const std::filesystem::path file =
                request_.folder / fmt::format("mesh_{:03}.ply", shape_);
            write_ply(mesh, file);
            append_value(shape, "string", "filename", std::filesystem::absolute(file).string());
            if (mesh.normals.empty()) append_value(shape, "boolean", "face_normals", "true");
        }
        bool has_bsdf = false;
        const SceneNode *interior = nullptr, *exterior = nullptr;
        for (const SceneNode::Child& child : node.children) {
            if (child.node->tag == "bsdf") write_bsdf(*child.node, shape), has_bsdf = true;
            if (child.node->tag == "emitter") copy(*child.node, shape);
            if (child.name == "interior") interior = child.node.get();
            if (child.name == "exterior") exterior = child.node.get();
            if (child.node->tag == "subsurface") same_ = false;
        }
        if (const float eta = binding.material->smooth_boundary_eta(); !has_bsdf && eta > 0.f) {
            Element boundary = append_object(shape, "bsdf", "dielectric");
            append_value(boundary, "float", "int_ior", fmt::format("{}", eta));
            append_value(boundary, "float", "ext_ior", "1");
        }
        if (binding.interior) write_medium(interior, *binding.interior, shape, "interior");
        if (binding.exterior) write_medium(exterior, *binding.exterior, shape, "exterior");
    }

    void write_bsdf(const SceneNode& node, Element parent) {
        if (is_one_of(node.type, {"conductor", "dielectric", "diffuse", "mask", "null", "plastic",
                                  "roughconductor", "roughdielectric", "roughplastic",
                                  "thindielectric", "twosided"})) {
            copy(node, parent);
            return;
        }
        const Vec3f albedo = mean_albedo(*make_material(node, context_));
        substitute(fmt::format("{} is diffuse of its albedo ({:.4g}, {:.4g}, {:.4g})", node.type,
                               albedo.x, albedo.y, albedo.z));
        append_rgb(append_object(parent, "bsdf", "diffuse"), "reflectance", albedo);
    }

    /// `node` may be null (<subsurface>, scenes in memory).
    void write_medium(const SceneNode* node, const Medium& medium, Element parent,
                      std::string_view name) {
        const bool known = node && is_one_of(node->type, {"homogeneous", "heterogeneous"}) &&
                           std::ranges::none_of(node->values, [](const SceneValue& v) {
                               // Mitsuba 3.9 takes RGB in media for reflectances.
                               const auto* color = std::get_if<ColorValue>(&v.value);
                               if (color && color->kind == ColorValue::Kind::rgb &&
                                   std::max({color->rgb.x, color->rgb.y, color->rgb.z}) > 1.f)
                                   return true;
                               return is_one_of(v.name, {"material", "sigma_s", "sigma_a",
                                                         "surface_color", "radius"});
                           });
        const double unit = scene_.mm_per_unit;
        if (known && (unit == 1 || !medium.homogeneous())) {
            Element element = append_object(parent, "medium", node->type, name);
            for (const SceneValue& v : node->values)
                if (v.name != "scale") append_value(element, v);
            append_value(element, "float", "scale", fmt::format("{}", medium.scale));
            for (const SceneNode::Child& child : node->children)
                if (child.node->tag == "volume") copy(*child.node, element, child.name);
            write_phase(medium.phase, element);
            return;
        }
        same_ = false;
        Element element = append_object(parent, "medium", "homogeneous", name);
        write_coefficients(medium, element);
        write_phase(medium.phase, element);
    }

    /// Per scene unit, as they were built.
    void write_coefficients(const Medium& medium, Element element) {
        const auto albedo = [](const MediumCoefficients& c, int i) {
            return c.sigma_t[i] > 0.f ? c.sigma_s[i] / c.sigma_t[i] : 0.f;
        };
        if (scene_.mode == ColorMode::spectral && medium.is_spectral()) {
            std::string extinction, scattered;
            for (float nm = visible_min; nm <= visible_max; nm += 5.f) {
                const auto c = medium.coefficients({}, Wavelengths::at(Spectral(nm)));
                const char* comma = extinction.empty() ? "" : ", ";
                extinction += fmt::format("{}{}:{}", comma, nm, c.sigma_t[0]);
                scattered += fmt::format("{}{}:{}", comma, nm, albedo(c, 0));
            }
            append_value(element, "spectrum", "sigma_t", extinction);
            append_value(element, "spectrum", "albedo", scattered);
            return;
        }
        const auto c = medium.coefficients({}, Wavelengths::rgb_bands());
        const float most = std::max({c.sigma_t[0], c.sigma_t[1], c.sigma_t[2], 1e-30f});
        append_rgb(element, "sigma_t", Vec3f{c.sigma_t[0], c.sigma_t[1], c.sigma_t[2]} / most);
        append_value(element, "float", "scale", fmt::format("{}", most));
        append_rgb(element, "albedo", {albedo(c, 0), albedo(c, 1), albedo(c, 2)});
    }

    void write_phase(const PhaseFunction& phase, Element medium) {
        using Kind = PhaseFunction::Kind;
        const Kind kind = phase.kind();
        if (kind == Kind::isotropic || kind == Kind::rayleigh) {
            append_object(medium, "phase", phase.name());
            return;
        }
        if (kind != Kind::hg) {
            same_ = false;
            substitute(
                fmt::format("phase function {} is Henyey and Greenstein's of mean cosine {:.4g}",
                            phase.name(), phase.mean_cosine()));
        }
        append_value(append_object(medium, "phase", "hg"), "float", "g",
                     fmt::format("{}", phase.mean_cosine()));
    }

    /// The parameters of a node; files by their full path, indices of refraction as numbers.
    void copy_values(const SceneNode& node, Element element) {
        for (const SceneValue& v : node.values) {
            if (v.name == "filename") {
                const std::filesystem::path file = context_.file(node, "filename");
                if (file.extension() == ".vdb")
                    throw InputError(
                        fmt::format("{}: Mitsuba 3 cannot read OpenVDB; give the volume as .vol",
                                    file.string()));
                append_value(element, "string", v.name, std::filesystem::absolute(file).string());
            } else if (v.name == "int_ior" || v.name == "ext_ior") {
                const DielectricIndex index = get_index(node, v.name, "air");
                if (index.is_dispersive())
                    substitute("the index of refraction is that of yellow light");
                append_value(element, "float", v.name, fmt::format("{}", index.at(sodium_d)));
            } else {
                append_value(element, v);
            }
        }
    }

    void copy(const SceneNode& node, Element parent, std::string_view name = {}) {
        Element element = append_object(parent, node.tag, node.type, name);
        copy_values(node, element);
        for (const SceneNode::Child& child : node.children)
            if (child.node->tag == "bsdf")
                write_bsdf(*child.node, element);
            else
                copy(*child.node, element, child.name);
    }

    const PeerRequest& request_;
    const Scene& scene_;
    Substitutions& substitutions_;
    BuildContext context_;
    std::uint32_t shape_ = 0;  ///< at work
    bool same_ = true;
};

}  // namespace

MitsubaScene mitsuba_scene(const PeerRequest& request, Substitutions& substitutions) {
    if (!request.scene.root)
        throw RunError("the scene does not know what it was built from, so no peer can render it");
    return Writer(request, substitutions).write();
}

}  // namespace nacre
