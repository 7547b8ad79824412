#include "nacre/scene/gltf/fields.h"

#include <fmt/format.h>

#include "nacre/scene/content_key.h"

namespace nacre {
namespace {

const char* word(GltfTexture::Wrap wrap) {
    switch (wrap) {
        case GltfTexture::Wrap::mirror:
            return "mirror";
        case GltfTexture::Wrap::clamp:
            return "clamp";
        case GltfTexture::Wrap::repeat:
            break;
    }
    return "repeat";
}

}  // namespace

GltfFields::GltfFields(const GltfObject& object, GltfMaterial& material, BuildContext& context)
    : object_(object), m_(material), context_(context) {
    read_textures();
}

void GltfFields::read_textures() {
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const auto [name, texture, color] = m_.textures()[i];
        if (texture->image < 0) continue;
        if (layout_ && !texture->laid_on_as(*layout_)) {
            m_.left_out.push_back(fmt::format("{} (laid on otherwise than others)", name));
            *texture = {};
            continue;
        }
        if (!layout_) layout_ = texture;
        pixels_[i] = &pixels(texture->image, !color);
        width_ = std::max(width_, pixels_[i]->width);
        height_ = std::max(height_, pixels_[i]->height);
    }
}

const Image& GltfFields::pixels(int index, bool raw) {
    Layer& layer = layers_[index];
    std::shared_ptr<const Image>& image = raw ? layer.raw : layer.linear;
    if (!image) {
        const GltfImage& from = object_.images[std::size_t(index)];
        if (context_.files && !from.path.empty()) context_.files->push_back(from.path);
        image = std::make_shared<Image>(parse_image(from.bytes(), from.name, {.raw = raw}));
    }
    return *image;
}

/// Red, green, blue and alpha at a texel of the common size; ones without a picture.
std::array<float, 4> GltfFields::sample(const Image* image, int x, int y) const {
    if (!image) return {1.f, 1.f, 1.f, 1.f};
    const int alpha = image->channel("A");
    const auto at = [&](int i, int j) -> std::array<float, 4> {
        const auto wrapped = [&](int k, int n, GltfTexture::Wrap wrap) {
            if (k >= 0 && k < n) return k;
            return wrap == GltfTexture::Wrap::repeat ? (k + n) % n : std::clamp(k, 0, n - 1);
        };
        i = wrapped(i, image->width, layout_->wrap_u);
        j = wrapped(j, image->height, layout_->wrap_v);
        const Vec3f c = image->rgb(i, j);
        return {c.x, c.y, c.z, alpha < 0 ? 1.f : image->at(i, j, alpha)};
    };
    if (image->width == width_ && image->height == height_) return at(x, y);
    // A smaller picture beside a larger one: mixed as the renderer would mix it.
    const float u = (float(x) + 0.5f) / float(width_) * float(image->width) - 0.5f,
                v = (float(y) + 0.5f) / float(height_) * float(image->height) - 0.5f;
    const int i = int(std::floor(u)), j = int(std::floor(v));
    if (layout_->nearest) return at(int(std::floor(u + 0.5f)), int(std::floor(v + 0.5f)));
    const float a = u - float(i), b = v - float(j);
    const auto p = at(i, j), q = at(i + 1, j), r = at(i, j + 1), s = at(i + 1, j + 1);
    std::array<float, 4> mixed;
    for (std::size_t c = 0; c < 4; ++c)
        mixed[c] = (1 - b) * ((1 - a) * p[c] + a * q[c]) + b * ((1 - a) * r[c] + a * s[c]);
    return mixed;
}

GltfTexel GltfFields::texel(int x, int y) const {
    const auto at = [&](std::size_t i) { return sample(pixels_[i], x, y); };
    // In the order of GltfMaterial::textures.
    const auto base = at(0), mr = at(1), e = at(2), t = at(3), d = at(4), dc = at(5);
    const auto product = [](const Vec3f& f, const std::array<float, 4>& c) {
        return Vec3f{f.x * c[0], f.y * c[1], f.z * c[2]};
    };
    return {product(m_.base_color, base),
            product(m_.emissive, e),
            product(m_.diffuse_transmission_color, dc),
            m_.alpha * base[3],
            m_.metallic * mr[2],
            m_.roughness * mr[1],
            m_.transmission * t[0],
            m_.diffuse_transmission * d[3]};
}

template <class F>
bool GltfFields::varies(const F& of) const {
    const auto first = of(texel(0, 0));
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            if (!(of(texel(x, y)) == first)) return true;
    return false;
}

GltfFields::Range GltfFields::range(const Number& of) const {
    Range r{of(texel(0, 0)), of(texel(0, 0))};
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const float v = of(texel(x, y));
            r.low = std::min(r.low, v);
            r.high = std::max(r.high, v);
        }
    return r;
}

void GltfFields::put(const NodePtr& node, const char* name, const Color& of) {
    if (!varies(of)) return set_rgb(node, name, of(texel(0, 0)));
    auto image = std::make_shared<Image>(width_, height_);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const Vec3f c = of(texel(x, y));
            for (int i = 0; i < 3; ++i) image->at(x, y, i) = c[i];
        }
    put_bitmap(node, name, std::move(image));
}

void GltfFields::put(const NodePtr& node, const char* name, const Number& of) {
    if (!varies(of)) return set(node, name, "float", double(of(texel(0, 0))));
    auto image = std::make_shared<Image>(width_, height_, std::vector<std::string>{"Y"});
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) image->at(x, y, 0) = of(texel(x, y));
    put_bitmap(node, name, std::move(image));
}

void GltfFields::put_bitmap(const NodePtr& node, const char* name,
                            std::shared_ptr<const Image> image) {
    auto texture = make_node("texture", "bitmap");
    set(texture, "wrap_mode", "string", std::string(word(layout_->wrap_u)));
    set(texture, "wrap_mode_v", "string", std::string(word(layout_->wrap_v)));
    if (layout_->nearest) set(texture, "filter_type", "string", std::string("nearest"));
    set(texture, "to_uv", "transform", layout_->to_uv);
    const auto* bytes = reinterpret_cast<const char*>(image->data.data());
    set(texture, "picture", "string",
        fmt::format("{} x {}, {:016x}", image->width, image->height,
                    hash_bytes({bytes, image->data.size() * sizeof(float)})));
    context_.images[texture.get()] = std::move(image);
    add(node, texture, name);
}

}  // namespace nacre
