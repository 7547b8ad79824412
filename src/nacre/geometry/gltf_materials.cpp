#include "nacre/geometry/gltf_materials.h"

#include "nacre/geometry/gltf_document.h"

namespace nacre {
namespace {

std::string number(double v) { return fmt::format("{:.6g}", v); }

std::string text_of(const tinygltf::Value& value) {
    if (value.IsNumber()) return number(value.GetNumberAsDouble());
    if (value.IsBool()) return value.Get<bool>() ? "true" : "false";
    if (value.IsString()) return value.Get<std::string>();
    std::string text;
    if (value.IsArray())
        for (int i = 0; i < static_cast<int>(value.ArrayLen()); ++i)
            text += (i ? ", " : "") + text_of(value.Get(i));
    return text;
}

std::string text_of(const std::vector<double>& values) {
    std::string text;
    for (const double v : values) text += (text.empty() ? "" : ", ") + number(v);
    return text;
}

GltfMaterial describe(const tinygltf::Material& m, std::size_t index) {
    GltfMaterial r;
    r.name = m.name.empty() ? fmt::format("material {}", index) : m.name;
    const auto say = [&](std::string what) { r.properties.push_back(std::move(what)); };
    const auto& pbr = m.pbrMetallicRoughness;
    if (pbr.baseColorFactor != std::vector<double>{1, 1, 1, 1})
        say("baseColorFactor " + text_of(pbr.baseColorFactor));
    if (pbr.baseColorTexture.index >= 0) say("baseColorTexture");
    // The format's defaults are a rough metal, so these are always worth telling.
    say("metallicFactor " + number(pbr.metallicFactor));
    say("roughnessFactor " + number(pbr.roughnessFactor));
    if (pbr.metallicRoughnessTexture.index >= 0) say("metallicRoughnessTexture");
    if (m.normalTexture.index >= 0) say("normalTexture");
    if (m.occlusionTexture.index >= 0) say("occlusionTexture");
    if (m.emissiveFactor.size() == 3 && m.emissiveFactor != std::vector<double>{0, 0, 0})
        say("emissiveFactor " + text_of(m.emissiveFactor));
    if (m.emissiveTexture.index >= 0) say("emissiveTexture");
    if (!m.alphaMode.empty() && m.alphaMode != "OPAQUE")
        say("alphaMode " + m.alphaMode +
            (m.alphaMode == "MASK" ? " at " + number(m.alphaCutoff) : std::string()));
    if (m.doubleSided) say("doubleSided");
    for (const auto& [name, extension] : m.extensions) {
        std::string text = name, sep = ": ";
        if (extension.IsObject())
            for (const std::string& key : extension.Keys()) {
                const std::string value = text_of(extension.Get(key));
                text += sep + key + (value.empty() ? "" : " " + value);
                sep = "; ";
            }
        say(text);
    }
    return r;
}

}  // namespace

bool has_gltf_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension == ".gltf" || extension == ".glb";
}

GltfSummary parse_gltf_summary(std::string_view bytes, const std::filesystem::path& path) {
    const tinygltf::Model model = parse_gltf({bytes, path});
    GltfSummary r;
    r.extensions_used = model.extensionsUsed;
    r.extensions_required = model.extensionsRequired;
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        r.materials.push_back(describe(model.materials[i], i));
    for (const auto& mesh : model.meshes)
        for (const auto& primitive : mesh.primitives)
            if (primitive.material >= 0 &&
                static_cast<std::size_t>(primitive.material) < r.materials.size())
                r.materials[static_cast<std::size_t>(primitive.material)].used = true;
    return r;
}

GltfSummary load_gltf_summary(const std::filesystem::path& path) {
    const std::string bytes = read_bytes(path);
    return parse_gltf_summary(bytes, path);
}

}  // namespace nacre
