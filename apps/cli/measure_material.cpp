#include "apps/cli/measure_material.h"

#include <filesystem>

#include "apps/cli/measured_page.h"
#include "nacre/goniometer/patch_material.h"
#include "nacre/math/error.h"
#include "nacre/reflectance/registry.h"
#include "nacre/scene/build.h"
#include "nacre/scene/content_key.h"
#include "nacre/scene/xml/find_file.h"
#include "nacre/scene/xml/write_nodes.h"
#include "nacre/text/names.h"
#include "nacre/text/split_words.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

bool is_file(const std::string& name) {
    std::error_code none;
    return fs::is_regular_file(name, none);
}
/// A measured file, or a folder of factors that has the name of no material.
bool is_data(const std::string& name) {
    std::error_code none;
    return is_file(name) || (fs::is_directory(name, none) && !models().look(name) &&
                             find_name(name, material_types()) < 0);
}

void add_file_fact(const std::string& name, std::map<std::string, std::string>& facts) {
    for (const fs::path& file : files_in(name))
        if (const auto bytes = read_whole_file(file))
            facts["file " + file.string()] = fmt::format("{:016x}", hash_bytes(*bytes));
}

constexpr std::string_view place = "--material";

/// A parameter of the kind that its text looks like.
SceneValue parameter(const Setting& setting) {
    SceneValue v{setting.name, "string", {}, {}};
    if (const auto* number = std::get_if<double>(&setting.value)) {
        v.tag = "float";
        v.value = *number;
    } else if (const auto* rgb = std::get_if<Vec3f>(&setting.value)) {
        v.tag = "rgb";
        ColorValue color;
        color.rgb = *rgb;
        v.value = color;
    } else if (const auto& s = std::get<std::string>(setting.value); s == "true" || s == "false") {
        v.tag = "boolean";
        v.value = s == "true";
    } else {
        v.value = s;
    }
    return v;
}

NodePtr material_node(const std::string& type, const Settings& settings) {
    const NodePtr node = make_node("bsdf", type.c_str());
    node->location.file = std::make_shared<const std::string>(place);
    for (const Setting& setting : settings) {
        node->values.push_back(parameter(setting));
        node->values.back().location = node->location;
    }
    return node;
}

SurfaceBsdf scene_material(const NodePtr& node, const Wavelengths& wavelengths) {
    BuildContext context;
    context.search_path = {""};
    MaterialPtr material;
    try {
        material = make_material(*node, context);
        node->check_all_used();
    } catch (const InputError& e) {  // there is no line and no column
        const std::string message = e.what(), nowhere = node->location.str();
        throw InputError(message.starts_with(nowhere)
                             ? std::string(place) + message.substr(nowhere.size())
                             : message);
    }
    if (material->is_spectral() && wavelengths.mode == ColorMode::rgb_bands)
        throw InputError("--material: it depends on the wavelength: say which, --lambda nm");
    // The node lives as long: textures and the like may refer to it.
    return [material, node](const SurfacePoint& at, const Wavelengths& w,
                            BsdfScratch& scratch) -> const Bsdf& {
        return material->at(at, w, scratch);
    };
}

}  // namespace

void add_file_facts(const std::string& text, std::map<std::string, std::string>& facts) {
    if (is_file(text)) return add_file_fact(text, facts);
    for (const std::string_view word : split_words(text, " ")) {
        const std::size_t equals = word.find('=');
        if (equals == word.npos) continue;
        const std::string name(word.substr(equals + 1));
        if (is_file(name)) add_file_fact(name, facts);
    }
}

SurfaceBsdf generated_material(const std::string& text, const Wavelengths& wavelengths,
                               std::map<std::string, std::string>& facts) {
    facts["material"] = text;
    if (is_data(text)) {
        add_file_fact(text, facts);
        return scene_material(material_node("measured", {{"filename", text}}), wavelengths);
    }
    add_file_facts(text, facts);
    const std::string_view all = text;
    const std::size_t begin = std::min(all.find_first_not_of(" \t"), all.size());
    const std::size_t end = std::min(all.find_first_of(" \t", begin), all.size());
    const std::string name(all.substr(begin, end - begin));
    if (name == "mirror" || models().look(name)) return surface_bsdf(text, wavelengths);
    std::vector<std::string> known = material_types();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
        if (has_measured_extension(text))
            throw InputError(fmt::format("--material: cannot find the file '{}'", text));
        known.emplace_back("mirror");
        throw InputError(unknown_name("material", name, known));
    }
    return scene_material(material_node(name, parse_settings(all.substr(end))), wavelengths);
}

}  // namespace nacre::cli
