// Factors and textures of a material, by name, so that whatever nobody asked for is told.
#include "nacre/geometry/gltf_material_reader.h"

#include <cmath>
#include <limits>
#include <set>

namespace nacre {
namespace {

using tinygltf::Value;

std::string number(double v) { return fmt::format("{:.6g}", v); }

std::string text_of(const Value& value) {
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

/// Members of an extension; remembers which were asked for.
class Extension {
  public:
    Extension(const tinygltf::ExtensionMap& all, const char* name) {
        if (const auto found = all.find(name); found != all.end() && found->second.IsObject())
            value_ = &found->second;
    }
    bool present() const { return value_ != nullptr; }
    const Value* get(const char* name) {
        asked_.insert(name);
        return value_ && value_->Has(name) ? &value_->Get(name) : nullptr;
    }
    std::vector<std::string> not_asked() const {
        std::vector<std::string> names;
        if (value_)
            for (const std::string& key : value_->Keys())
                if (!asked_.contains(key)) names.push_back(key);
        return names;
    }

  private:
    const Value* value_ = nullptr;
    std::set<std::string, std::less<>> asked_;
};

class MaterialReader {
  public:
    MaterialReader(const MeshSource& source, const tinygltf::Model& model, std::size_t index)
        : source_(source), model_(model), m_(model.materials[index]) {
        r_.name = m_.name.empty() ? fmt::format("material {}", index) : m_.name;
    }

    GltfMaterial read() {
        describe();
        read_core();
        read_extensions();
        return std::move(r_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        source_.fail(fmt::format("material '{}': {}", r_.name, what));
    }

    float in_range(const char* name, double v, double low, double high) const {
        if (!(v >= low && v <= high))
            fail(std::isfinite(high)
                     ? fmt::format("{} is {}; it must lie within [{}, {}]", name, v, low, high)
                     : fmt::format("{} is {}; it must be finite and at least {}", name, v, low));
        return static_cast<float>(v);
    }
    static constexpr double largest = std::numeric_limits<float>::max();

    Vec3f color(const char* name, const std::vector<double>& v, double high) const {
        if (v.size() < 3) fail(fmt::format("{} has {} numbers; it needs 3", name, v.size()));
        return {in_range(name, v[0], 0, high), in_range(name, v[1], 0, high),
                in_range(name, v[2], 0, high)};
    }

    int index(const char* name, double v) const {
        if (!(v >= 0. && v <= 0x7fffffff))
            fail(fmt::format("{} names number {}; it must lie within [0, 2147483647]", name, v));
        return static_cast<int>(v);
    }

    /// The factor `name` of an extension.
    void get(Extension& e, const char* name, float& to, double low, double high) const {
        const Value* v = e.get(name);
        if (!v) return;
        if (!v->IsNumber()) fail(fmt::format("{} is not a number", name));
        to = in_range(name, v->GetNumberAsDouble(), low, high);
    }
    void get(Extension& e, const char* name, Vec3f& to, double high) const {
        const Value* v = e.get(name);
        if (!v) return;
        std::vector<double> numbers;
        if (v->IsArray())
            for (int i = 0; i < static_cast<int>(v->ArrayLen()); ++i)
                if (v->Get(i).IsNumber()) numbers.push_back(v->Get(i).GetNumberAsDouble());
        to = color(name, numbers, high);
    }
    void get(Extension& e, const char* name, GltfTexture& to) {
        const Value* v = e.get(name);
        if (!v || !v->IsObject()) return;
        const auto integer = [&](const char* key, int otherwise) {
            if (!v->Has(key) || !v->Get(key).IsNumber()) return otherwise;
            return index(name, v->Get(key).GetNumberAsDouble());
        };
        const Value extensions =
            v->Has("extensions") ? v->Get("extensions") : Value(Value::Object());
        tinygltf::ExtensionMap map;
        if (extensions.IsObject())
            for (const std::string& key : extensions.Keys()) map[key] = extensions.Get(key);
        to = texture(name, integer("index", -1), integer("texCoord", 0), map);
    }

    GltfTexture texture(const char* name, int index, int coordinates,
                        const tinygltf::ExtensionMap& extensions) {
        GltfTexture t;
        if (index < 0) return t;
        const tinygltf::Texture& from = entry(source_, model_.textures, index, "texture");
        if (from.source < 0) {
            // The picture is one of an extension alone, such as KHR_texture_basisu.
            std::string who = "no picture";
            if (!from.extensions.empty()) who = "a picture by " + from.extensions.begin()->first;
            r_.left_out.push_back(fmt::format("{} ({})", name, who));
            return t;
        }
        t.image = from.source;
        entry(source_, model_.images, t.image, "image");
        t.coordinates = coordinates;
        if (from.sampler >= 0) {
            const auto& sampler = entry(source_, model_.samplers, from.sampler, "sampler");
            t.wrap_u = wrap(sampler.wrapS);
            t.wrap_v = wrap(sampler.wrapT);
            t.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        Extension transform(extensions, "KHR_texture_transform");
        if (transform.present()) t.to_uv = to_uv(transform, t.coordinates);
        return t;
    }

    static GltfTexture::Wrap wrap(int mode) {
        return mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? GltfTexture::Wrap::clamp
               : mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? GltfTexture::Wrap::mirror
                                                               : GltfTexture::Wrap::repeat;
    }

    /// Scaled, then turned, then moved. The sense of the rotation is that of the extension's text
    /// and of its example (the lower left quadrant), counter-clockwise in a picture whose v points
    /// down; the GLSL printed beside them turns the other way.
    Transform to_uv(Extension& e, int& coordinates) const {
        const auto pair = [&](const char* name, double otherwise) {
            const Value* v = e.get(name);
            Vec2<double> p{otherwise, otherwise};
            if (v && v->IsArray() && v->ArrayLen() == 2 && v->Get(0).IsNumber() &&
                v->Get(1).IsNumber())
                p = {v->Get(0).GetNumberAsDouble(), v->Get(1).GetNumberAsDouble()};
            return p;
        };
        const auto offset = pair("offset", 0), scale = pair("scale", 1);
        const Value* turn = e.get("rotation");
        const double angle = turn && turn->IsNumber() ? turn->GetNumberAsDouble() : 0.;
        if (const Value* set = e.get("texCoord"); set && set->IsNumber())
            coordinates = index("KHR_texture_transform", set->GetNumberAsDouble());
        const double c = std::cos(angle), s = std::sin(angle);
        if (!(scale.x * scale.y != 0. &&
              std::isfinite(scale.x * scale.y + offset.x + offset.y + c)))
            fail("KHR_texture_transform must have finite numbers and a scale other than 0");
        return Transform(Transform::Matrix{c * scale.x, s * scale.y, 0, offset.x,   //
                                           -s * scale.x, c * scale.y, 0, offset.y,  //
                                           0, 0, 1, 0,                              //
                                           0, 0, 0, 1});
    }

    void read_core() {
        const auto& pbr = m_.pbrMetallicRoughness;
        if (pbr.baseColorFactor.size() == 4) {
            r_.base_color = color("baseColorFactor", pbr.baseColorFactor, 1);
            r_.alpha = in_range("the alpha of baseColorFactor", pbr.baseColorFactor[3], 0, 1);
        }
        r_.metallic = in_range("metallicFactor", pbr.metallicFactor, 0, 1);
        r_.roughness = in_range("roughnessFactor", pbr.roughnessFactor, 0, 1);
        const auto of = [&](const char* name, const tinygltf::TextureInfo& t) {
            return texture(name, t.index, t.texCoord, t.extensions);
        };
        r_.base_color_texture = of("baseColorTexture", pbr.baseColorTexture);
        r_.metallic_roughness_texture =
            of("metallicRoughnessTexture", pbr.metallicRoughnessTexture);
        r_.emissive_texture = of("emissiveTexture", m_.emissiveTexture);
        if (m_.emissiveFactor.size() == 3)
            r_.emissive = color("emissiveFactor", m_.emissiveFactor, largest);
        r_.alpha_cutoff = in_range("alphaCutoff", m_.alphaCutoff, 0, largest);
        if (m_.alphaMode == "MASK")
            r_.alpha_mode = GltfMaterial::Alpha::mask;
        else if (m_.alphaMode == "BLEND")
            r_.alpha_mode = GltfMaterial::Alpha::blend;
        else if (!m_.alphaMode.empty() && m_.alphaMode != "OPAQUE")
            fail(fmt::format("alphaMode '{}' is unknown; it is OPAQUE, MASK or BLEND",
                             m_.alphaMode));
        if (m_.normalTexture.index >= 0) r_.left_out.emplace_back("normalTexture");
        if (m_.occlusionTexture.index >= 0) r_.left_out.emplace_back("occlusionTexture");
    }

    void read_extensions() {
        Extension strength = open("KHR_materials_emissive_strength"),
                  ior = open("KHR_materials_ior"), specular = open("KHR_materials_specular"),
                  transmission = open("KHR_materials_transmission"),
                  diffuse = open("KHR_materials_diffuse_transmission"),
                  volume = open("KHR_materials_volume"),
                  scatter = open("KHR_materials_volume_scatter");
        float emissive_strength = 1.f, thickness = 0.f;
        get(strength, "emissiveStrength", emissive_strength, 0, largest);
        r_.emissive = r_.emissive * emissive_strength;
        // 0 stands for the reflectance 1 of materials of another kind, and is told.
        if (const Value* v = ior.get("ior"); v && v->IsNumber() && v->GetNumberAsDouble() == 0.)
            r_.left_out.emplace_back("KHR_materials_ior: ior 0");
        else
            get(ior, "ior", r_.ior, 1, 10);
        get(specular, "specularFactor", r_.specular, 0, 1);
        get(specular, "specularColorFactor", r_.specular_color, 100);
        get(transmission, "transmissionFactor", r_.transmission, 0, 1);
        get(transmission, "transmissionTexture", r_.transmission_texture);
        get(diffuse, "diffuseTransmissionFactor", r_.diffuse_transmission, 0, 1);
        get(diffuse, "diffuseTransmissionTexture", r_.diffuse_transmission_texture);
        get(diffuse, "diffuseTransmissionColorFactor", r_.diffuse_transmission_color, 1);
        get(diffuse, "diffuseTransmissionColorTexture", r_.diffuse_transmission_color_texture);
        // The thickness itself is for renderers that do not follow light through the mesh.
        get(volume, "thicknessFactor", thickness, 0, largest);
        volume.get("thicknessTexture");
        r_.thick = thickness > 0.f;
        get(volume, "attenuationDistance", r_.attenuation_distance, 0, largest);
        if (volume.get("attenuationDistance") && !(r_.attenuation_distance > 0.f))
            fail("attenuationDistance is 0; it must be positive");
        get(volume, "attenuationColor", r_.attenuation_color, 1);
        get(scatter, "multiscatterColor", r_.multiscatter_color, 1);
        get(scatter, "scatterAnisotropy", r_.scatter_anisotropy, -0.999, 0.999);
        for (const auto& [name, e] : {std::pair{"KHR_materials_specular", &specular},
                                      {"KHR_materials_transmission", &transmission},
                                      {"KHR_materials_diffuse_transmission", &diffuse},
                                      {"KHR_materials_volume", &volume},
                                      {"KHR_materials_volume_scatter", &scatter}})
            for (const std::string& key : e->not_asked())
                if (key != "extras" && key != "extensions")
                    r_.left_out.push_back(fmt::format("{}: {}", name, key));
        for (const auto& [name, value] : m_.extensions)
            if (!opened_.contains(name)) r_.left_out.push_back(name);
    }

    Extension open(const char* name) {
        opened_.insert(name);
        return {m_.extensions, name};
    }

    /// What the file says, for a list.
    void describe() {
        const auto say = [&](std::string what) { r_.properties.push_back(std::move(what)); };
        const auto& pbr = m_.pbrMetallicRoughness;
        if (pbr.baseColorFactor != std::vector<double>{1, 1, 1, 1})
            say("baseColorFactor " + text_of(pbr.baseColorFactor));
        if (pbr.baseColorTexture.index >= 0) say("baseColorTexture");
        // The format's defaults are a rough metal, so these are always worth telling.
        say("metallicFactor " + number(pbr.metallicFactor));
        say("roughnessFactor " + number(pbr.roughnessFactor));
        if (pbr.metallicRoughnessTexture.index >= 0) say("metallicRoughnessTexture");
        if (m_.normalTexture.index >= 0) say("normalTexture");
        if (m_.occlusionTexture.index >= 0) say("occlusionTexture");
        if (m_.emissiveFactor.size() == 3 && m_.emissiveFactor != std::vector<double>{0, 0, 0})
            say("emissiveFactor " + text_of(m_.emissiveFactor));
        if (m_.emissiveTexture.index >= 0) say("emissiveTexture");
        if (!m_.alphaMode.empty() && m_.alphaMode != "OPAQUE")
            say("alphaMode " + m_.alphaMode +
                (m_.alphaMode == "MASK" ? " at " + number(m_.alphaCutoff) : std::string()));
        if (m_.doubleSided) say("doubleSided");
        for (const auto& [name, extension] : m_.extensions) {
            std::string text = name, sep = ": ";
            if (extension.IsObject())
                for (const std::string& key : extension.Keys()) {
                    const std::string value = text_of(extension.Get(key));
                    text += sep + key + (value.empty() ? "" : " " + value);
                    sep = "; ";
                }
            say(text);
        }
    }

    const MeshSource& source_;
    const tinygltf::Model& model_;
    const tinygltf::Material& m_;
    GltfMaterial r_;
    std::set<std::string, std::less<>> opened_;
};

}  // namespace

GltfMaterial read_gltf_material(const MeshSource& source, const tinygltf::Model& model,
                                std::size_t index) {
    return MaterialReader(source, model, index).read();
}

}  // namespace nacre
