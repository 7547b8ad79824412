// Materials and media of nacre as trees of Blender's closures.
#include <fmt/format.h>

#include "nacre/bssrdf/profile.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/peers/albedo.h"
#include "nacre/peers/cycles_scene.h"
#include "nacre/peers/mesh.h"
#include "nacre/scene/materials/index.h"
#include "nacre/scene/materials/microfacet.h"
#include "nacre/scene/subsurface.h"

namespace nacre {
namespace {

using nlohmann::json;

Vec3f bands(const Spectral& s) { return {s[0], s[1], s[2]}; }

json diffuse(json color) { return {{"type", "diffuse"}, {"color", std::move(color)}}; }
json mix(json factor, json a, json b) {
    return {
        {"type", "mix"}, {"factor", std::move(factor)}, {"a", std::move(a)}, {"b", std::move(b)}};
}
json transparent(const Vec3f& color) { return {{"type", "transparent"}, {"color", triple(color)}}; }
/// A shader on the outside, another (or nothing: black) on the inside.
json sides(json outside, json inside = nullptr) {
    return mix({{"backfacing", true}}, std::move(outside), std::move(inside));
}
json mirror(json color) {
    return {{"type", "glossy"}, {"distribution", "SHARP"}, {"color", std::move(color)}};
}

const SceneNode* child_of(const SceneNode& node, std::string_view tag) {
    const auto found = node.children_of(tag);
    return found.empty() ? nullptr : found[0]->node.get();
}

/// Whether a material looks by itself after what it is from the inside; others are black there.
bool has_two_sides(std::string_view type) {
    for (const char* known :
         {"dielectric", "roughdielectric", "thindielectric", "null", "mask", "twosided", "hk"})
        if (type == known) return true;
    return false;
}

}  // namespace

json color_and_strength(const Vec3f& rgb) {
    const float strength = std::max({rgb.x, rgb.y, rgb.z, 0.f});
    return {{"color", triple(strength > 0.f ? rgb * (1.f / strength) : Vec3f{1.f, 1.f, 1.f})},
            {"strength", strength}};
}

CyclesMaterials::CyclesMaterials(const Scene& scene, std::filesystem::path folder, bool random_walk,
                                 Substitutions& substitutions)
    : scene_(scene),
      folder_(std::move(folder)),
      random_walk_(random_walk),
      substitutions_(substitutions) {
    context_.search_path = scene.search_path;
    context_.mm_per_unit = scene.mm_per_unit;
}

void CyclesMaterials::substitute(const std::string& sentence) {
    substitutions_.add(fmt::format("'{}': {}", scene_.shapes[shape_].name, sentence));
}

json CyclesMaterials::bake(const Texture& texture) {
    constexpr int side = 1024;
    Image image(side, side);
    Vec2f low{1e30f, 1e30f}, high{-1e30f, -1e30f};
    for (const Vec2f& uv : mesh_->uvs) {
        low = {std::min(low.x, uv.x), std::min(low.y, uv.y)};
        high = {std::max(high.x, uv.x), std::max(high.y, uv.y)};
    }
    const Wavelengths w = Wavelengths::rgb_bands();
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float s = (float(x) + 0.5f) / side, t = 1.f - (float(y) + 0.5f) / side;
            const Vec3f rgb = bands(
                texture.eval({low.x + s * (high.x - low.x), low.y + t * (high.y - low.y)}, w));
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = rgb[std::size_t(c)];
        }
    const std::string name = fmt::format("texture_{:03}_{}.exr", shape_, images_++);
    write_image(image, folder_ / name);
    substitute(fmt::format("a texture is an image of {0} x {0} pixels", side));
    return {{"image", name}};
}

json CyclesMaterials::color(const SceneNode& node, const char* name, float otherwise,
                            ColorRole role) {
    if (node.child(name, "texture") && !mesh_->uvs.empty())
        return bake(*get_texture(node, name, role, otherwise, context_));
    return triple(mean_color(node, name, otherwise, role));
}

Vec3f CyclesMaterials::mean_color(const SceneNode& node, const char* name, float otherwise,
                                  ColorRole role) {
    const TexturePtr texture = get_texture(node, name, role, otherwise, context_);
    const Wavelengths w = Wavelengths::rgb_bands();
    if (!node.child(name, "texture")) return bands(texture->eval({}, w));
    constexpr int side = 64;
    Vec3f sum{};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            sum += bands(texture->eval({(float(x) + 0.5f) / side, (float(y) + 0.5f) / side}, w));
    substitute(fmt::format("the texture of '{}' is its mean", name));
    return sum * (1.f / (side * side));
}

void CyclesMaterials::add_roughness(json& shader, const SceneNode& bsdf) {
    const Roughness roughness = get_roughness(bsdf, context_);
    const float u = roughness.alpha_u->mean(), v = roughness.alpha_v->mean();
    if (u != v) substitute("an anisotropic roughness is isotropic, the geometric mean of both");
    if (bsdf.child("alpha", "texture") || bsdf.child("alpha_u", "texture") ||
        bsdf.child("alpha_v", "texture"))
        substitute("the texture of 'alpha' is its mean");
    shader["distribution"] = roughness.ggx ? "GGX" : "BECKMANN";
    shader["roughness"] = std::sqrt(std::sqrt(u * v));  // Blender squares it
}

json CyclesMaterials::metal(const SceneNode& bsdf) {
    const MetalIndex index = get_metal(bsdf, context_);
    const Wavelengths w = Wavelengths::rgb_bands();
    const Vec3f n = bands(index.eta->eval({}, w)), k = bands(index.k->eval({}, w)),
                tint = mean_color(bsdf, "specular_reflectance", 1.f);
    Vec3f straight;
    bool same = true;
    for (std::size_t c = 0; c < 3; ++c) {
        straight[c] = fresnel_conductor(1.f, n[c], k[c]);
        same &= std::abs(fresnel_conductor(0.1f, n[c], k[c]) - straight[c]) < 1e-4f;
        straight[c] *= tint[c];
    }
    if (!same) substitute("a metal reflects in all directions what it reflects straight on");
    json shader = mirror(triple(straight));
    if (bsdf.type == "roughconductor") add_roughness(shader, bsdf);
    return shader;
}

json CyclesMaterials::glass(const SceneNode& bsdf) {
    const RelativeIndex index(bsdf, "bk7");
    if (index.is_dispersive()) substitute("the index of refraction is that of yellow light");
    const Vec3f reflected = mean_color(bsdf, "specular_reflectance", 1.f),
                transmitted = mean_color(bsdf, "specular_transmittance", 1.f);
    const json thin = {{"thin_fresnel", index.nominal()}};
    if (bsdf.type == "thindielectric")
        return mix(thin, transparent(transmitted), mirror(triple(reflected)));
    if (reflected != transmitted)
        substitute("'specular_reflectance' is as 'specular_transmittance'");
    json shader = {{"type", "glass"},
                   {"distribution", "SHARP"},
                   {"ior", index.nominal()},
                   {"color", triple(transmitted)}};
    if (bsdf.type == "roughdielectric") add_roughness(shader, bsdf);
    return shader;
}

/// The base below Fresnel's reflection: with this albedo it reflects, from every direction of view,
/// as much uniform light as nacre's.
json CyclesMaterials::plastic(const SceneNode& bsdf) {
    const float eta = get_relative_index(bsdf, "polypropylene");
    const auto inside = float(diffuse_reflectance_internal(eta));
    Vec3f base = mean_color(bsdf, "diffuse_reflectance", 0.5f);
    if (bsdf.get_bool("nonlinear", false))
        for (std::size_t c = 0; c < 3; ++c) base[c] *= (1.f - inside) / (1.f - base[c] * inside);
    json coat = mirror(triple(mean_color(bsdf, "specular_reflectance", 1.f)));
    if (bsdf.type == "roughplastic") add_roughness(coat, bsdf);
    substitute(fmt::format("{} is a diffuse base below Fresnel's reflection", bsdf.type));
    return mix({{"fresnel", eta}}, diffuse(triple(base)), std::move(coat));
}

json CyclesMaterials::reflecting(const SceneNode& bsdf) {
    if (bsdf.type == "diffuse") return diffuse(color(bsdf, "reflectance", 0.5f));
    if (bsdf.type == "conductor" || bsdf.type == "roughconductor") return metal(bsdf);
    if (bsdf.type == "plastic" || bsdf.type == "roughplastic") return plastic(bsdf);
    const Vec3f albedo = mean_albedo(*make_material(bsdf, context_));
    substitute(fmt::format("{} is diffuse of its albedo ({:.4g}, {:.4g}, {:.4g})", bsdf.type,
                           albedo.x, albedo.y, albedo.z));
    return diffuse(triple(albedo));
}

json CyclesMaterials::surface(const SceneNode& bsdf) {
    if (bsdf.type == "dielectric" || bsdf.type == "roughdielectric" ||
        bsdf.type == "thindielectric")
        return glass(bsdf);
    if (bsdf.type == "null") return transparent({1.f, 1.f, 1.f});
    const auto nested = bsdf.children_of("bsdf");
    if (bsdf.type == "mask")
        return mix(color(bsdf, "opacity", 0.5f), transparent({1.f, 1.f, 1.f}),
                   surface(*nested[0]->node));
    if (bsdf.type == "twosided") {
        json front = reflecting(*nested[0]->node);
        // Blender's closures look the same from both sides.
        return nested.size() == 1 ? front : sides(front, reflecting(*nested[1]->node));
    }
    return has_two_sides(bsdf.type) ? reflecting(bsdf) : sides(reflecting(bsdf));
}

json CyclesMaterials::emission(const SceneNode& emitter) {
    json shader = {{"type", "emission"}};
    const json radiance = color(emitter, "radiance", 1.f, ColorRole::illuminant);
    if (radiance.is_array()) {
        shader.update(color_and_strength({radiance[0], radiance[1], radiance[2]}));
    } else {
        shader["color"] = radiance;
        shader["strength"] = 1.f;
    }
    return sides(std::move(shader));
}

json CyclesMaterials::volume(const Medium& medium) {
    const MediumCoefficients c = medium.coefficients({}, Wavelengths::rgb_bands());
    if (medium.phase.kind() != PhaseFunction::Kind::isotropic &&
        medium.phase.kind() != PhaseFunction::Kind::hg)
        substitute(fmt::format("phase function {} is Henyey and Greenstein's of mean cosine {:.4g}",
                               medium.phase.name(), medium.phase.mean_cosine()));
    const Spectral absorbed = c.sigma_t - c.sigma_s;
    Vec3f a = bands(absorbed);
    for (std::size_t i = 0; i < 3; ++i) a[i] = std::max(a[i], 0.f);
    return {{"sigma_s", triple(bands(c.sigma_s))},
            {"sigma_a", triple(a)},
            {"anisotropy", medium.phase.mean_cosine()}};
}

json CyclesMaterials::subsurface(const ShapeBinding& shape) {
    const float eta = boundary_eta(shape);
    const double enters = 1. - (eta == 1.f ? 0. : diffuse_reflectance_external(eta));
    const MediumCoefficients c = shape.interior->coefficients({}, Wavelengths::rgb_bands());
    const double g = shape.interior->phase.mean_cosine();
    Vec3f albedo, radius;
    for (int i = 0; i < 3; ++i) {
        const ProfileMedium matter{c.sigma_s[i], std::max(c.sigma_t[i] - c.sigma_s[i], 0.f), g,
                                   eta};
        const auto profile = make_profile("better_dipole", matter);
        albedo[std::size_t(i)] = float(enters * profile->total());
        radius[std::size_t(i)] = float(1. / std::max(profile->sigma_tr(), 1e-6));
    }
    substitute(
        fmt::format("the medium is Blender's subsurface scattering by random walk, of the "
                    "diffuse reflectance ({:.4g}, {:.4g}, {:.4g}) and diffusion length "
                    "({:.4g}, {:.4g}, {:.4g})",
                    albedo.x, albedo.y, albedo.z, radius.x, radius.y, radius.z));
    const double straight = std::pow((eta - 1.) / (eta + 1.), 2);
    return {{"type", "subsurface"},     {"color", triple(albedo)},
            {"radius", triple(radius)}, {"ior", eta},
            {"anisotropy", g},          {"specular", straight / 0.08}};  // Blender's unit of it
}

void CyclesMaterials::add_to(json& spec, std::uint32_t shape, Mesh& mesh) {
    shape_ = shape;
    mesh_ = &mesh;
    const ShapeBinding& binding = scene_.shapes[shape];
    const SceneNode& node = shape_node(scene_, shape);
    const SceneNode *bsdf = child_of(node, "bsdf"), *emitter = child_of(node, "emitter");
    json shader = nullptr;
    const bool walks = random_walk_ && is_translucent(binding);
    if (walks)
        shader = subsurface(binding);
    else if (bsdf && bsdf->type == "null" && binding.interior)
        shader = nullptr;  // no closure at all: Blender then has the volume alone
    else if (bsdf)
        shader = surface(*bsdf);
    else if (const float eta = binding.material->smooth_boundary_eta(); eta > 0.f)
        shader = {{"type", "glass"},
                  {"distribution", "SHARP"},
                  {"ior", eta},
                  {"color", triple({1.f, 1.f, 1.f})}};  // of <subsurface>
    else if (!emitter)
        shader = sides(diffuse(triple({0.5f, 0.5f, 0.5f})));
    if (emitter) shader = {{"type", "add"}, {"a", std::move(shader)}, {"b", emission(*emitter)}};
    spec["shader"] = std::move(shader);
    if (binding.interior && !binding.interior->homogeneous())
        substitute("a medium that varies in space is left out");
    else if (binding.interior && !walks)
        spec["volume"] = volume(*binding.interior);
    if (binding.exterior) substitute("the medium outside is left out");

    if (mesh.uvs.empty()) return;
    Vec2f low = mesh.uvs[0], high = low;
    for (const Vec2f& uv : mesh.uvs) {
        low = {std::min(low.x, uv.x), std::min(low.y, uv.y)};
        high = {std::max(high.x, uv.x), std::max(high.y, uv.y)};
    }
    const Vec2f size{std::max(high.x - low.x, 1e-20f), std::max(high.y - low.y, 1e-20f)};
    for (Vec2f& uv : mesh.uvs) uv = {(uv.x - low.x) / size.x, (uv.y - low.y) / size.y};
}

}  // namespace nacre
