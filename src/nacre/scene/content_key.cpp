#include "nacre/scene/content_key.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "nacre/math/random.h"
#include "nacre/scene/xml/find_file.h"
#include "nacre/scene/xml/scene_node.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

class Hash {
  public:
    void add(std::uint64_t v) { state_ = mix_bits(state_ ^ mix_bits(v + 0x9e3779b97f4a7c15ull)); }
    void add(double v) { add(std::bit_cast<std::uint64_t>(v)); }
    void add_bytes(const void* data, std::size_t size) {
        add(std::uint64_t(size));
        const char* at = static_cast<const char*>(data);
        for (; size >= 8; at += 8, size -= 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, at, 8);
            add(word);
        }
        std::uint64_t rest = 0;
        std::memcpy(&rest, at, size);
        add(rest);
    }
    void add(std::string_view text) { add_bytes(text.data(), text.size()); }
    template <class T>
    void add_all(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add_bytes(values.data(), values.size() * sizeof(T));
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0;
};

void add_file(Hash& hash, const std::string& name,
              const std::vector<std::filesystem::path>& search_path) {
    hash.add(name);
    for (const std::filesystem::path& folder : search_path) {
        std::error_code error;
        if (!std::filesystem::exists(folder / name, error)) continue;
        for (const std::filesystem::path& file : files_in(folder / name)) {
            const auto bytes = read_whole_file(file);
            if (!bytes)
                throw RunError(
                    fmt::format("{}: cannot be read; check its permissions", file.string()));
            hash.add(*bytes);
        }
        return;
    }
}

void add_color(Hash& hash, const ColorValue& c) {
    hash.add(std::uint64_t(c.kind));
    for (float v : {c.rgb.x, c.rgb.y, c.rgb.z, c.value, c.kelvin}) hash.add(double(v));
    hash.add_all(c.nm);
    hash.add_all(c.values);
}

using LeftOut = std::initializer_list<std::string_view>;

bool is_in(LeftOut names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

void add_values(Hash& hash, const SceneNode& node,
                const std::vector<std::filesystem::path>& search_path) {
    hash.add(node.tag);
    hash.add(node.type);
    hash.add(std::uint64_t(node.values.size()));
    for (const SceneValue& v : node.values) {
        hash.add(v.name);
        hash.add(std::uint64_t(v.value.index()));
        if (const auto* number = std::get_if<double>(&v.value)) hash.add(*number);
        if (const auto* whole = std::get_if<std::int64_t>(&v.value))
            hash.add(std::uint64_t(*whole));
        if (const auto* flag = std::get_if<bool>(&v.value)) hash.add(std::uint64_t(*flag));
        if (const auto* text = std::get_if<std::string>(&v.value))
            v.name == "filename" ? add_file(hash, *text, search_path) : hash.add(*text);
        if (const auto* vector = std::get_if<Vec3d>(&v.value))
            for (int i = 0; i < 3; ++i) hash.add((*vector)[i]);
        if (const auto* transform = std::get_if<Transform>(&v.value))
            for (double m : transform->matrix()) hash.add(m);
        if (const auto* color = std::get_if<ColorValue>(&v.value)) add_color(hash, *color);
    }
}

void add_node(Hash& hash, const SceneNode& node,
              const std::vector<std::filesystem::path>& search_path, LeftOut left_out) {
    add_values(hash, node, search_path);
    for (const SceneNode::Child& child : node.children) {
        if (is_in(left_out, child.node->tag)) continue;
        hash.add(child.name);
        add_node(hash, *child.node, search_path, left_out);
    }
    hash.add(std::string_view("end"));
}

/// Meshes that came from no file are part of no node.
void add_meshes(Hash& hash, const Scene& scene) {
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i)
        if (const Mesh* mesh = scene.rays.mesh(i)) {
            hash.add_all(mesh->positions);
            hash.add_all(mesh->triangles);
            hash.add_all(mesh->normals);
            hash.add_all(mesh->uvs);
        }
}

const SceneNode& root_of(const Scene& scene) {
    if (!scene.root)
        throw InputError("the scene was put together by hand: there is nothing to make a key of");
    return *scene.root;
}

std::string text(const Hash& hash) { return fmt::format("{:016x}", hash.value()); }

void add_film(Hash& hash, const FilmSettings& film) {
    for (int v : {film.width, film.height, film.crop_x, film.crop_y, film.crop_width,
                  film.crop_height, int(film.quantity)})
        hash.add(std::uint64_t(v));
}

void add_background(Hash& hash, const Scene& scene) {
    if (!scene.background) return;
    for (int i = 0; i < 3; ++i)
        hash.add(scene.background->radiance(nullptr, {0, 0, 1}, Wavelengths::rgb_bands())[i]);
}

}  // namespace

std::uint64_t hash_bytes(std::string_view bytes) {
    Hash hash;
    hash.add(bytes);
    return hash.value();
}

std::string content_key(const Scene& scene) {
    const SceneNode& root = root_of(scene);
    Hash hash;
    hash.add(std::string_view("nacre scene 1"));
    add_node(hash, root, scene.search_path, {"sampler", "integrator"});
    add_meshes(hash, scene);
    add_film(hash, scene.film);
    hash.add(std::uint64_t(scene.mode));
    hash.add(std::uint64_t(std::int64_t(scene.integrator.max_depth)));
    hash.add(std::uint64_t(scene.integrator.hide_emitters));
    add_background(hash, scene);
    return text(hash);
}

std::map<std::string, std::string> content_keys_by_part(const Scene& scene) {
    const SceneNode& root = root_of(scene);
    std::map<std::string, Hash> parts;
    add_values(parts["scene"], root, scene.search_path);
    parts["scene"].add(scene.mm_per_unit);
    add_background(parts["scene"], scene);
    for (const SceneNode::Child& child : root.children)
        add_node(parts[child.node->tag], *child.node, scene.search_path, {"sampler", "film"});
    add_meshes(parts["mesh"], scene);
    std::map<std::string, std::string> keys;
    for (const auto& [name, hash] : parts) keys[name] = text(hash);
    return keys;
}

}  // namespace nacre
