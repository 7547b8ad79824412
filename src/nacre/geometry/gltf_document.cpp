#include "nacre/geometry/gltf_document.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "nacre/math/error.h"

namespace nacre {
namespace {

// Extensions that a file may require and that are either read or change nothing that nacre takes
// from the file. What a material loses by one of them is told with the material.
constexpr std::string_view known_extensions[] = {
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_animation_pointer",
    "KHR_xmp_json_ld",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
};

bool is_compression(std::string_view extension) {
    return extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression" ||
           extension == "KHR_meshopt_compression";
}

[[noreturn]] void refuse(const MeshSource& source, std::string_view extension) {
    if (is_compression(extension))
        source.fail(fmt::format("needs {}; export it without compression", extension));
    if (extension == "EXT_mesh_gpu_instancing")
        source.fail(
            "needs EXT_mesh_gpu_instancing, which is not read; export every copy as a node of its "
            "own");
    source.fail(fmt::format("needs {}, which is not read; export it without", extension));
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
    return word;
}

/// The JSON of a .glb, whose container is checked on the way.
std::string_view json_of_glb(const MeshSource& source) {
    const std::string_view bytes = source.bytes;
    if (bytes.size() < 20)
        source.fail(fmt::format("is cut off: {} bytes are no glTF; copy it again", bytes.size()));
    if (const auto version = word_at(bytes, 4); version != 2)
        source.fail(fmt::format("is glTF of version {}; nacre reads 2.0", version));
    const std::size_t whole = word_at(bytes, 8), json = word_at(bytes, 12);
    if (whole > bytes.size())
        source.fail(
            fmt::format("is cut off: its header promises {} bytes, but there are {}; copy "
                        "it again",
                        whole, bytes.size()));
    if (bytes.substr(16, 4) != "JSON" || json > std::min(whole, bytes.size()) - 20 || whole < 20)
        source.fail(
            fmt::format("is damaged: its first chunk is not JSON of {} bytes inside the "
                        "file's {}; export it again",
                        json, whole));
    return bytes.substr(20, json);
}

/// Refuses indices that do not fit 31 bits: tinygltf would wrap them to others that exist.
void check_numbers(const MeshSource& source, const nlohmann::json& json, const std::string& name,
                   bool in_extension = false) {
    if (json.is_structured()) {
        for (const auto& [key, value] : json.items()) {
            const std::string& in = json.is_array() ? name : key;
            // Of extensions, the textures that they name.
            if (in == "extensions" || in_extension) {
                if (value.is_structured() || in == "index" || in == "texCoord")
                    check_numbers(source, value, in, true);
                continue;
            }
            // Sizes have 64 bits and are checked where they are used; the others are not read.
            constexpr std::string_view others[] = {
                "byteLength", "byteOffset", "byteStride", "count", "min", "max", "extras"};
            if (std::find(std::begin(others), std::end(others), in) == std::end(others))
                check_numbers(source, value, in);
        }
    } else if (json.is_number_integer() &&
               (json.is_number_unsigned() ? json.get<std::uint64_t>() > 0x7fffffffu
                                          : json.get<std::int64_t>() < -0x7fffffff)) {
        source.fail(fmt::format("has {} as '{}', which is out of range; export it again",
                                json.dump(), name));
    }
}

/// Refuses what nacre cannot read, by name, before tinygltf stumbles over what such files lack.
void check_extensions(const MeshSource& source, std::string_view text) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return;  // tinygltf says where it is wrong
    check_numbers(source, json, "");
    const auto list = [&](const nlohmann::json& from, const char* name) {
        const auto found = from.is_object() ? from.find(name) : from.end();
        return found != from.end() && found->is_array() ? *found : nlohmann::json::array();
    };
    for (const auto& extension : list(json, "extensionsRequired")) {
        if (!extension.is_string()) continue;
        const std::string name = extension.get<std::string>();
        if (std::find(std::begin(known_extensions), std::end(known_extensions), name) ==
            std::end(known_extensions))
            refuse(source, name);
    }
    // Said to be optional, but without the data to fall back on.
    const auto has = [](const nlohmann::json& object, const char* name) {
        return object.is_object() && object.contains(name);
    };
    const nlohmann::json accessors = list(json, "accessors");
    for (const auto& mesh : list(json, "meshes"))
        for (const auto& primitive : list(mesh, "primitives"))
            if (has(primitive, "extensions") &&
                has(primitive["extensions"], "KHR_draco_mesh_compression") &&
                has(primitive, "attributes") && has(primitive["attributes"], "POSITION")) {
                const auto& position = primitive["attributes"]["POSITION"];
                if (position.is_number_unsigned() && position.get<std::size_t>() < accessors.size())
                    if (const auto& a = accessors[position.get<std::size_t>()];
                        !has(a, "bufferView") && !has(a, "sparse"))
                        refuse(source, "KHR_draco_mesh_compression");
            }
    for (const auto& buffer : list(json, "buffers"))
        if (has(buffer, "extensions") && !has(buffer, "uri"))
            for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
                if (has(buffer["extensions"], name)) refuse(source, name);
}

bool is_image(std::string name) {
    for (char& c : name) c = static_cast<char>(c | 0x20);
    for (const char* ending : {".png", ".jpg", ".jpeg", ".webp", ".ktx2", ".dds", ".basis"})
        if (name.ends_with(ending)) return true;
    return false;
}

// Files beside the .gltf: buffers are read, pictures are as if they were not there.
tinygltf::FsCallbacks files_but_images() {
    tinygltf::FsCallbacks files{};
    files.FileExists = [](const std::string& name, void*) {
        std::error_code error;
        return !is_image(name) && std::filesystem::is_regular_file(name, error);
    };
    files.ExpandFilePath = [](const std::string& name, void*) { return name; };
    files.ReadWholeFile = [](std::vector<unsigned char>* to, std::string* problem,
                             const std::string& name, void*) {
        try {
            const std::string bytes = read_bytes(name);
            to->assign(bytes.begin(), bytes.end());
            return true;
        } catch (const InputError& error) {
            *problem += error.what();
            return false;
        }
    };
    files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                              void*) { return false; };
    return files;
}

/// Where an element type's bytes lie inside their buffer, checked.
struct Bytes {
    const unsigned char* data;
    std::size_t stride;
};

Bytes locate(const MeshSource& source, const tinygltf::Model& model, int view_index,
             std::size_t offset, std::size_t count, std::size_t element, int accessor,
             const char* what) {
    const auto& view = entry(source, model.bufferViews, view_index, "bufferView");
    const auto& buffer = entry(source, model.buffers, view.buffer, "buffer");
    const std::size_t stride = view.byteStride ? view.byteStride : element;
    // Written so that no sum can overflow.
    const std::size_t have = buffer.data.size();
    const bool inside = view.byteOffset <= have && view.byteLength <= have - view.byteOffset &&
                        offset <= view.byteLength;
    const std::size_t room = inside ? view.byteLength - offset : 0;
    if (count > 0 && (room < element || stride == 0 || stride > 252 + element ||
                      (count - 1) > (room - element) / stride))
        source.fail(
            fmt::format("accessor {} ({}) wants {} elements of {} bytes, but its buffer "
                        "view holds {} bytes of a buffer of {}; export it again",
                        accessor, what, count, element, room, have));
    return {buffer.data.data() + (inside ? view.byteOffset + offset : 0), stride};
}

template <class T>
double scaled(const unsigned char* at, bool normalized, double one) {
    T v;
    std::memcpy(&v, at, sizeof v);
    return normalized ? std::max(double(v) / one, -1.0) : double(v);
}

}  // namespace

GltfElements::GltfElements(const MeshSource& source, const tinygltf::Model& model, int accessor,
                           int width, const char* what)
    : width_(width) {
    const auto& a = entry(source, model.accessors, accessor, "accessor");
    const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type));
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.componentType));
    if (components != width || size <= 0)
        source.fail(fmt::format("accessor {} ({}) has {} components of {} bytes; it needs {}",
                                accessor, what, components, size, width));
    type_ = a.componentType;
    normalized_ = a.normalized;
    size_ = static_cast<std::size_t>(size);
    count_ = a.count;
    const std::size_t element = size_ * static_cast<std::size_t>(width);
    if (a.bufferView >= 0 || !a.sparse.isSparse) {
        const Bytes bytes =
            locate(source, model, a.bufferView, a.byteOffset, count_, element, accessor, what);
        data_ = bytes.data;
        stride_ = bytes.stride;
    }
    if (a.sparse.isSparse) replace_sparse(source, model, a, accessor, what);
}

void GltfElements::replace_sparse(const MeshSource& source, const tinygltf::Model& model,
                                  const tinygltf::Accessor& accessor, int index, const char* what) {
    const auto& sparse = accessor.sparse;
    const std::size_t element = size_ * static_cast<std::size_t>(width_);
    // Without a buffer view no bytes of the file vouch for the count.
    constexpr std::size_t most = 100'000'000;
    if (!data_ && count_ > most)
        source.fail(
            fmt::format("accessor {} ({}) wants {} elements that no buffer holds; export "
                        "it again",
                        index, what, count_));
    if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > count_)
        source.fail(fmt::format("accessor {} ({}) replaces {} of its {} elements; export it again",
                                index, what, sparse.count, count_));
    const auto replaced = static_cast<std::size_t>(sparse.count);
    own_.resize(count_ * element);
    if (data_)
        for (std::size_t i = 0; i < count_; ++i)
            std::memcpy(own_.data() + i * element, data_ + i * stride_, element);
    const int type = sparse.indices.componentType;
    const std::size_t index_size = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 1
                                   : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2
                                   : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT   ? 4
                                                                                    : 0;
    if (index_size == 0)
        source.fail(fmt::format("accessor {} ({}) has sparse indices of type {}; export it again",
                                index, what, type));
    const Bytes indices =
        locate(source, model, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset),
               replaced, index_size, index, what);
    const Bytes values =
        locate(source, model, sparse.values.bufferView, std::size_t(sparse.values.byteOffset),
               replaced, element, index, what);
    for (std::size_t i = 0; i < replaced; ++i) {
        std::uint32_t at = 0;  // little endian, as this machine
        std::memcpy(&at, indices.data + i * indices.stride, index_size);
        if (at >= count_)
            source.fail(
                fmt::format("accessor {} ({}) replaces element {}, but it has {} (counted "
                            "from 0); export it again",
                            index, what, at, count_));
        std::memcpy(own_.data() + at * element, values.data + i * values.stride, element);
    }
    data_ = own_.data();
    stride_ = element;
}

double GltfElements::value(std::size_t i, int component) const {
    const unsigned char* at = data_ + i * stride_ + static_cast<std::size_t>(component) * size_;
    switch (type_) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled<std::int8_t>(at, normalized_, 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled<std::uint8_t>(at, normalized_, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled<std::int16_t>(at, normalized_, 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled<std::uint16_t>(at, normalized_, 65535);
        case TINYGLTF_COMPONENT_TYPE_INT:
            return scaled<std::int32_t>(at, normalized_, 1);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return scaled<std::uint32_t>(at, normalized_, 1);
        case TINYGLTF_COMPONENT_TYPE_DOUBLE:
            return scaled<double>(at, normalized_, 1);
        default:
            return scaled<float>(at, normalized_, 1);
    }
}

tinygltf::Model parse_gltf(const MeshSource& given, bool keep_pictures) {
    MeshSource source = given;
    if (source.bytes.starts_with("\xef\xbb\xbf")) source.bytes.remove_prefix(3);
    if (source.bytes.size() > 0xffffffffu) source.fail("is larger than glTF's limit of 4 GiB");
    check_extensions(source, source.bytes.starts_with("glTF") ? json_of_glb(source) : source.bytes);
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(files_but_images());
    loader.SetImageLoader(
        [](tinygltf::Image* image, const int, std::string*, std::string*, int, int,
           const unsigned char* bytes, int size, void* keep) {
            if (*static_cast<bool*>(keep) && size > 0) image->image.assign(bytes, bytes + size);
            return true;
        },
        &keep_pictures);
    tinygltf::Model model;
    std::string error, warning;
    bool read = false;
    const auto size = static_cast<unsigned int>(source.bytes.size());
    const std::string folder = source.path.parent_path().string();
    try {
        read = source.bytes.starts_with("glTF")
                   ? loader.LoadBinaryFromMemory(
                         &model, &error, &warning,
                         reinterpret_cast<const unsigned char*>(source.bytes.data()), size, folder)
                   : loader.LoadASCIIFromString(&model, &error, &warning, source.bytes.data(), size,
                                                folder);
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!read) {
        const std::string first_line = error.substr(0, error.find('\n'));
        source.fail(fmt::format("is not valid glTF ({}); check it with a glTF validator",
                                first_line.empty() ? "no reason given" : first_line));
    }
    return model;
}

}  // namespace nacre
