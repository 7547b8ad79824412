// The scene reader: from XML to a tree of nodes, with includes, references and parameters resolved.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "nacre/scene/load.h"
#include "nacre/scene/xml/find_file.h"
#include "nacre/scene/xml/values.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> object_tags = {
    "integrator", "sensor", "film",  "rfilter", "sampler", "emitter",   "shape",
    "bsdf",       "medium", "phase", "volume",  "texture", "subsurface"};
const std::vector<std::string> structure_tags = {"ref", "alias", "include", "default", "path"};
const std::vector<std::string> step_tags = {"translate", "scale", "rotate", "lookat", "matrix"};

bool contains(const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

class XmlReader {
  public:
    XmlReader(const std::map<std::string, std::string>& defines, std::vector<fs::path>& search_path)
        : parameters_(defines), search_path_(search_path) {}

    SceneNodePtr read(const fs::path& file) {
        search_path_ = {file.parent_path()};
        XmlSource& source = open(file);
        const pugi::xml_node root = source.root();
        const XmlElement element(source, root, parameters_);
        if (element.tag != "scene")
            element.fail(fmt::format("a scene file holds one <scene>, not <{}>", element.tag));
        element.check_attributes({"version"});
        source.version = version_of(element);
        auto scene = std::make_shared<SceneNode>();
        scene->tag = "scene";
        scene->location = element.location;
        including_ = {file};
        read_children(source, root, *scene);
        parameters_.check_all_used();
        return scene;
    }

  private:
    struct Known {
        SceneNodePtr node;
        SourceLocation location;
    };

    XmlSource& open(const fs::path& file) {
        sources_.push_back(std::make_unique<XmlSource>(file));
        return *sources_.back();
    }

    static int version_of(const XmlElement& element) {
        const std::string text = element.get("version");
        int major = -1;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), major);
        const bool digits = text.find_first_not_of("0123456789.", 0) == text.npos;
        if (error != std::errc() || !digits || (*end != '.' && *end != '\0') || text.back() == '.')
            element.fail(fmt::format("'{}' is not a version such as 3.0.0", text));
        if (major > 3)
            element.fail(fmt::format("version {} is not known; nacre reads 0.x to 3.x", text));
        return major;
    }

    void read_children(const XmlSource& source, const pugi::xml_node& parent, SceneNode& into) {
        for (const pugi::xml_node& child : parent.children()) {
            if (child.type() != pugi::node_element)
                throw InputError(fmt::format("{}: text cannot stand here: '{}'",
                                             source.locate(child).str(),
                                             std::string(child.value()).substr(0, 40)));
            read_child(source, child, into);
        }
    }

    void read_child(const XmlSource& source, const pugi::xml_node& child, SceneNode& into) {
        const XmlElement element(source, child, parameters_);
        if (contains(object_tags, element.tag)) {
            add(read_object(source, element), element.get("name"), element.location, into);
        } else if (is_value_tag(element.tag)) {
            SceneValue value = element.tag == "spectrum" && element.has("type")
                                   ? read_typed_spectrum(source, element)
                                   : read_value(element, {source, parameters_, search_path_});
            check_new(value.name, element, into);
            into.values.push_back(std::move(value));
        } else if (element.tag == "ref") {
            element.check_attributes({"id"}, {"name"});
            add(find(source, element), element.get("name"), element.location, into);
        } else if (contains(structure_tags, element.tag)) {
            if (into.tag != "scene")
                element.fail(fmt::format("<{}> must stand directly in <scene>", element.tag));
            read_structure(source, element, into);
        } else if (contains(step_tags, element.tag)) {
            element.fail(fmt::format("<{}> must stand in a <transform>", element.tag));
        } else {
            std::vector<std::string> known = object_tags;
            known.insert(known.end(), value_tags().begin(), value_tags().end());
            known.insert(known.end(), structure_tags.begin(), structure_tags.end());
            const std::string near = nearest_name(element.tag, known);
            element.fail(fmt::format(
                "unknown element <{}>{}", element.tag,
                near.empty() ? std::string() : fmt::format("; did you mean <{}>?", near)));
        }
    }

    static void check_new(const std::string& name, const XmlElement& element,
                          const SceneNode& into) {
        for (const SceneValue& v : into.values)
            if (v.name == name)
                element.fail(
                    fmt::format("'{}' is given twice; first at {}", name, v.location.str()));
        for (const SceneNode::Child& c : into.children)
            if (!name.empty() && c.name == name)
                element.fail(
                    fmt::format("'{}' is given twice; first at {}", name, c.location.str()));
    }

    void add(SceneNodePtr node, const std::string& name, const SourceLocation& location,
             SceneNode& into) {
        for (const SceneNode::Child& c : into.children)
            if (!name.empty() && c.name == name)
                throw InputError(fmt::format("{}: '{}' is given twice; first at {}", location.str(),
                                             name, c.location.str()));
        for (const SceneValue& v : into.values)
            if (!name.empty() && v.name == name)
                throw InputError(fmt::format("{}: '{}' is given twice; first at {}", location.str(),
                                             name, v.location.str()));
        into.children.push_back({name, std::move(node), location});
    }

    SceneNodePtr read_object(const XmlSource& source, const XmlElement& element) {
        element.check_attributes({"type"}, {"id", "name"});
        auto node = std::make_shared<SceneNode>();
        node->tag = element.tag;
        node->type = element.get("type");
        node->id = element.get("id");
        node->location = element.location;
        if (++depth_ > 32) element.fail("objects are nested more than 32 deep");
        read_children(source, element.node, *node);
        --depth_;
        if (source.version < 2) upgrade(*node);
        if (!node->id.empty()) define(node->id, node, element);
        return node;
    }

    /// `<spectrum type="...">` with its parameters as children, as Mitsuba 3 writes black bodies.
    SceneValue read_typed_spectrum(const XmlSource& source, const XmlElement& element) {
        element.check_attributes({"name", "type"});
        SceneNode node;
        node.tag = "spectrum";
        node.type = element.get("type");
        node.location = element.location;
        read_children(source, element.node, node);
        ColorValue color;
        color.location = element.location;
        if (node.type == "uniform") {
            color.kind = ColorValue::Kind::constant;
            color.value = static_cast<float>(node.get_float("value", 1.0));
        } else if (node.type == "blackbody") {
            color.kind = ColorValue::Kind::blackbody;
            color.kelvin = static_cast<float>(node.get_float("temperature"));
            color.value = static_cast<float>(node.get_float("scale", 1.0));
            if (!(color.kelvin > 0.f)) node.fail_at("temperature", "must be positive");
            if (!(color.value >= 0.f)) node.fail_at("scale", "cannot be negative");
        } else if (node.type == "d65") {
            const auto scale = static_cast<float>(node.get_float("scale", 1.0));
            color.rgb = {scale, scale, scale};  // the white of linear RGB is D65
        } else {
            node.fail(unknown_name("spectrum type", node.type, {"uniform", "blackbody", "d65"}));
        }
        node.check_all_used();
        return {element.get("name"), "spectrum", color, element.location};
    }

    void define(const std::string& id, SceneNodePtr node, const XmlElement& element) {
        const auto [at, inserted] = known_.emplace(id, Known{std::move(node), element.location});
        if (!inserted)
            element.fail(fmt::format("the id '{}' is taken; it was given at {}", id,
                                     at->second.location.str()));
    }

    SceneNodePtr find(const XmlSource& source, const XmlElement& element) const {
        const std::string id = element.get("id");
        if (const auto at = known_.find(id); at != known_.end()) return at->second.node;
        if (const SourceLocation later = source.find_id(id); later.line > 0)
            element.fail(
                fmt::format("'{}' is defined only later, at {}; move it up", id, later.str()));
        std::vector<std::string> ids;
        for (const auto& entry : known_) ids.push_back(entry.first);
        element.fail(fmt::format("no object has the id '{}'{}", id, suggestion(id, ids)));
    }

    void read_structure(const XmlSource& source, const XmlElement& element, SceneNode& scene) {
        if (element.tag == "default") {
            element.check_attributes({"name"}, {"value"});
            parameters_.set_default(element.get("name"), element.get("value"));
        } else if (element.tag == "path") {
            element.check_attributes({"value"});
            // A folder that is not there is no error: files may all be found elsewhere.
            search_path_.push_back(source.path().parent_path() / element.get("value"));
        } else if (element.tag == "alias") {
            element.check_attributes({"id", "as"});
            define(element.get("as"), find(source, element), element);
        } else {
            element.check_attributes({"filename"});
            include(source, element, scene);
        }
        if (element.node.first_child())
            element.fail(fmt::format("<{}> cannot hold anything", element.tag));
    }

    void include(const XmlSource& from, const XmlElement& element, SceneNode& scene) {
        std::vector<fs::path> folders = search_path_;
        // Beside the file that asks, too, though the scene's own folder goes first.
        if (const fs::path beside = from.path().parent_path(); beside != folders.front())
            folders.insert(folders.begin() + 1, beside);
        const fs::path file = find_file(element.get("filename"), folders, element.location.str());
        std::string chain;
        for (const fs::path& open : including_) {
            if (!chain.empty() || fs::equivalent(open, file))
                chain += fmt::format("{} includes ", open.string());
        }
        if (!chain.empty()) element.fail(fmt::format("cyclic include: {}{}", chain, file.string()));

        XmlSource& source = open(file);
        source.version = from.version;
        including_.push_back(file);
        const pugi::xml_node root = source.root();
        const XmlElement top(source, root, parameters_);
        if (top.tag == "scene") {
            top.check_attributes({}, {"version"});
            if (top.has("version")) source.version = version_of(top);
            read_children(source, root, scene);
        } else {
            read_child(source, root, scene);
        }
        including_.pop_back();
    }

    /// What Mitsuba 0.x meant and says differently today, beyond the case of names.
    static void upgrade(SceneNode& node) {
        auto& values = node.values;
        const auto drop = [&](std::string_view name) {
            std::erase_if(values, [&](const SceneValue& v) { return v.name == name; });
        };
        if (node.tag == "bsdf" && node.type == "diffuse")
            for (SceneValue& v : values)
                if (v.name == "diffuse_reflectance") v.name = "reflectance";
        if (node.tag == "film") drop("banner");         // a logo in the corner
        if (node.tag == "integrator") drop("version");  // lajolla's homework number
        if (node.tag == "texture") upgrade_uv(node);
        // A boundary without a material let light pass unchanged.
        const bool media = std::any_of(node.children.begin(), node.children.end(), [](auto& c) {
            return c.name == "interior" || c.name == "exterior";
        });
        const bool bsdf = std::any_of(node.children.begin(), node.children.end(),
                                      [](auto& c) { return c.node->tag == "bsdf"; });
        if (node.tag == "shape" && media && !bsdf) {
            auto null = std::make_shared<SceneNode>();
            null->tag = "bsdf";
            null->type = "null";
            null->location = node.location;
            node.children.push_back({"", null, node.location});
        }
    }

    /// uscale, vscale, uoffset, voffset: scaled, then moved.
    static void upgrade_uv(SceneNode& node) {
        Vec3d scale{1, 1, 1}, offset{};
        SourceLocation location;
        for (const SceneValue& v : node.values) {
            const double* number = std::get_if<double>(&v.value);
            double* slot = v.name == "uscale"    ? &scale.x
                           : v.name == "vscale"  ? &scale.y
                           : v.name == "uoffset" ? &offset.x
                           : v.name == "voffset" ? &offset.y
                                                 : nullptr;
            if (!slot || !number) continue;
            *slot = *number;
            location = v.location;
        }
        if (!location.file) return;
        std::erase_if(node.values, [](const SceneValue& v) {
            return v.name == "uscale" || v.name == "vscale" || v.name == "uoffset" ||
                   v.name == "voffset";
        });
        node.values.push_back({"to_uv", "transform",
                               Transform::translate(offset) * Transform::scale(scale), location});
    }

    XmlParameters parameters_;
    std::vector<fs::path>& search_path_;
    std::vector<std::unique_ptr<XmlSource>> sources_;
    std::vector<fs::path> including_;
    std::map<std::string, Known> known_;
    int depth_ = 0;
};

}  // namespace

SceneNodePtr read_scene_xml(const std::filesystem::path& file,
                            const std::map<std::string, std::string>& defines,
                            std::vector<std::filesystem::path>& search_path) {
    return XmlReader(defines, search_path).read(file);
}

}  // namespace nacre
