#include "nacre/scene/materials/microfacet.h"

#include "nacre/optics/dispersion.h"

namespace nacre {
namespace {

TexturePtr get_alpha(const SceneNode& node, std::string_view name, BuildContext& context) {
    TexturePtr alpha = get_texture(node, name, ColorRole::unbounded, 0.1f, context);
    if (!(alpha->max() > 0.f && std::isfinite(alpha->max())))
        node.fail_at(name,
                     fmt::format("'{}' of {} must be positive; got {}; without roughness, use the "
                                 "smooth material of the same kind",
                                 name, node.describe(), alpha->max()));
    return alpha;
}

}  // namespace

Roughness get_roughness(const SceneNode& node, BuildContext& context) {
    Roughness roughness;
    roughness.ggx = node.get_choice("distribution", {"beckmann", "ggx"}) == "ggx";
    roughness.sampling =
        node.get_bool("sample_visible", true) ? NormalSampling::visible : NormalSampling::all;
    const bool u = node.has("alpha_u"), v = node.has("alpha_v"), both = node.has("alpha");
    if (both && (u || v))
        node.fail(fmt::format("{} takes either 'alpha' or 'alpha_u' and 'alpha_v', not both",
                              node.describe()));
    if (u != v)
        node.fail(fmt::format("{} has '{}' but not '{}'; give both", node.describe(),
                              u ? "alpha_u" : "alpha_v", u ? "alpha_v" : "alpha_u"));
    roughness.alpha_u = get_alpha(node, u ? "alpha_u" : "alpha", context);
    roughness.alpha_v = u ? get_alpha(node, "alpha_v", context) : roughness.alpha_u;
    return roughness;
}

MetalIndex get_metal(const SceneNode& node, BuildContext& context) {
    const std::string name = node.get_string("material", "none");
    if (node.has("eta") || node.has("k")) {
        if (name != "none")
            node.fail_at("material",
                         fmt::format("{} takes either 'material' or 'eta' and 'k', not both",
                                     node.describe()));
        return {get_texture(node, "eta", ColorRole::unbounded, 0.f, context),
                get_texture(node, "k", ColorRole::unbounded, 1.f, context)};
    }
    ConductorIndex index;
    try {
        index = conductor_index(name);
    } catch (const InputError& error) {
        node.fail_at("material",
                     fmt::format("'material' of {}: {}", node.describe(), error.what()));
    }
    if (index.perfect) return {make_constant_texture(0.f), make_constant_texture(1.f)};
    return {make_constant_texture(index.eta), make_constant_texture(index.k)};
}

}  // namespace nacre
