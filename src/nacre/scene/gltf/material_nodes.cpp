#include "nacre/scene/gltf/material_nodes.h"

namespace nacre {
namespace {

// Below this roughness a boundary is as good as smooth: alpha = 0.001 blurs by 0.1 degrees.
constexpr float least_roughness = 0.0316f;

class Converter {
  public:
    Converter(const GltfObject& object, GltfMaterial& material, BuildContext& context)
        : m_(material), fields_(object, material, context) {
        const float r = (m_.ior - 1.f) / (m_.ior + 1.f);
        f0_ = r * r;
    }

    NodePtr material() {
        const auto transmission = fields_.range(through);
        NodePtr node;
        if (transmission.low >= 1.f) {
            node = glass();
        } else {
            // The metal's share of what is not glass.
            node = surface([](const GltfTexel& t) {
                const float rest = 1.f - through(t);
                return rest > 0.f ? std::min(t.metallic / rest, 1.f) : 0.f;
            });
            if (transmission.high > 0.f) node = blend(node, glass(), through);
        }
        if (m_.alpha_mode == GltfMaterial::Alpha::opaque) return node;
        const GltfFields::Number alpha = [](const GltfTexel& t) { return t.alpha; };
        const bool cut = m_.alpha_mode == GltfMaterial::Alpha::mask;
        // Above 1 nothing is left of the surface.
        if (fields_.range(alpha).low >= (cut ? m_.alpha_cutoff : 1.f)) return node;
        auto mask = make_node("bsdf", "mask");
        if (cut && m_.alpha_cutoff > 1.f) {
            set(mask, "opacity", "float", 0.0);
        } else {
            fields_.put(mask, "opacity", alpha);
            if (cut) set(mask, "cutoff", "float", double(m_.alpha_cutoff));
        }
        add(mask, node);
        return mask;
    }

    NodePtr light() {
        if (m_.emissive == Vec3f{}) return {};
        auto emitter = make_node("emitter", "area");
        fields_.put(emitter, "radiance",
                    GltfFields::Color([](const GltfTexel& t) { return t.emissive; }));
        return emitter;
    }

    /// sigma_t = -ln(color)/distance; with scattering the single albedo by C. Kulla, A. Conty 2017,
    /// as KHR_materials_volume_scatter has it.
    NodePtr medium(double unit) const {
        const bool lets_through = m_.transmission > 0.f || m_.diffuse_transmission > 0.f;
        if (!m_.thick || !lets_through || !(m_.attenuation_distance > 0.f)) return {};
        // Black would be opaque at any distance; this is opaque enough (exp(-14)).
        constexpr float darkest = 1e-6f;
        Vec3f sigma_t, albedo{};
        for (int i = 0; i < 3; ++i) {
            const float c = std::clamp(m_.attenuation_color[i], darkest, 1.f);
            sigma_t[i] = float(-std::log(double(c)) / m_.attenuation_distance * unit);
            const double ms = m_.multiscatter_color[i];
            const double s =
                4.09712 + 4.20863 * ms - std::sqrt(9.59217 + ms * (41.6808 + 17.7126 * ms));
            // The rounded constants give 1e-6 for black.
            if (ms > 0.) albedo[i] = float(std::clamp(1. - s * s, 0., 1.));
        }
        if (sigma_t == Vec3f{}) return {};
        auto node = make_node("medium", "homogeneous");
        set_rgb(node, "sigma_t", sigma_t);
        // A plain 0 where nothing scatters: black as a colour is a spectrum a little above it.
        if (albedo == Vec3f{})
            set(node, "albedo", "float", 0.0);
        else
            set_rgb(node, "albedo", albedo);
        auto phase = make_node("phase", m_.scatter_anisotropy == 0.f ? "isotropic" : "hg");
        if (m_.scatter_anisotropy != 0.f) set(phase, "g", "float", double(m_.scatter_anisotropy));
        add(node, phase);
        return node;
    }

  private:
    static float through(const GltfTexel& t) { return (1.f - t.metallic) * t.transmission; }

    NodePtr blend(NodePtr first, NodePtr second, const GltfFields::Number& weight) {
        auto node = make_node("bsdf", "blendbsdf");
        fields_.put(node, "weight", weight);
        add(node, std::move(first));
        add(node, std::move(second));
        return node;
    }

    /// What does not refract: the metal, and the matt dielectric that may pass light on.
    NodePtr surface(const GltfFields::Number& metallic) {
        if (!(fields_.range([](const GltfTexel& t) { return t.diffuse_transmission; }).high > 0.f))
            return both_sides(
                reflection([](const GltfTexel& t) { return t.base_color; }, metallic));
        auto leaf = make_node("bsdf", "difftrans");
        fields_.put(leaf, "transmittance", GltfFields::Color([](const GltfTexel& t) {
                        return t.diffuse_transmission_color * t.diffuse_transmission;
                    }));
        set(leaf, "coat", "float", double(m_.specular));
        set(leaf, "f0", "float", double(f0_));
        add(leaf,
            reflection(
                [](const GltfTexel& t) { return t.base_color * (1.f - t.diffuse_transmission); },
                [](const GltfTexel&) { return 0.f; }));
        if (!(fields_.range(metallic).high > 0.f)) return leaf;
        return blend(leaf,
                     both_sides(reflection([](const GltfTexel& t) { return t.base_color; },
                                           [](const GltfTexel&) { return 1.f; })),
                     metallic);
    }

    static NodePtr both_sides(NodePtr reflection) {
        auto node = make_node("bsdf", "twosided");
        add(node, std::move(reflection));
        return node;
    }

    NodePtr reflection(const GltfFields::Color& base, const GltfFields::Number& metallic) {
        auto node = make_node("bsdf", "metallic_roughness");
        set(node, "coupling", "string", std::string("shirley"));
        fields_.put(node, "base_color", base);
        fields_.put(node, "metallic", metallic);
        fields_.put(node, "roughness", roughness);
        set(node, "ior", "float", double(m_.ior));
        set(node, "specular", "float", double(m_.specular));
        set_rgb(node, "specular_color", m_.specular_color);
        return node;
    }

    /// What refracts, or, if it encloses nothing, lets light pass straight on.
    NodePtr glass() {
        const auto rough = fields_.range(roughness);
        const bool smooth = rough.high < least_roughness;
        const bool boundary = m_.thick && m_.ior != 1.f;
        if (m_.specular != 1.f || m_.specular_color != Vec3f{1.f, 1.f, 1.f})
            m_.left_out.emplace_back("KHR_materials_specular of what is transmitted");
        if (!smooth && !boundary)
            m_.left_out.emplace_back(
                "the blur of what is transmitted (light passes a thin wall straight on)");
        auto node = make_node("bsdf", !boundary ? "thindielectric"
                                      : smooth  ? "dielectric"
                                                : "roughdielectric");
        set(node, "int_ior", "float", double(m_.ior));
        set(node, "ext_ior", "float", 1.0);
        if (boundary && !smooth) {
            set(node, "distribution", "string", std::string("ggx"));
            fields_.put(node, "alpha", GltfFields::Number([](const GltfTexel& t) {
                            return std::max(t.roughness * t.roughness, 1e-3f);
                        }));
        }
        fields_.put(node, "specular_transmittance",
                    GltfFields::Color([](const GltfTexel& t) { return t.base_color; }));
        return node;
    }

    static float roughness(const GltfTexel& t) { return t.roughness; }

    GltfMaterial& m_;
    GltfFields fields_;
    float f0_;
};

}  // namespace

void add_gltf_material(const NodePtr& shape, const GltfObject& object, GltfMaterial& material,
                       double unit, BuildContext& context) {
    Converter converter(object, material, context);
    add(shape, converter.material());
    if (NodePtr medium = converter.medium(unit)) add(shape, medium, "interior");
    if (NodePtr light = converter.light()) add(shape, light);
}

}  // namespace nacre
