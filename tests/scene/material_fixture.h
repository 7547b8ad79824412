#pragma once
// Scene nodes and materials made in memory.
#include <gtest/gtest.h>

#include "nacre/scene/build.h"
#include "tests/support/bound.h"

namespace nacre::test {

inline SourceLocation at(int line, int column) {
    static const auto file = std::make_shared<const std::string>("test.xml");
    return {file, line, column};
}

inline SceneValue number(std::string name, double value) {
    return {std::move(name), "float", value, at(2, 5)};
}
inline SceneValue flag(std::string name, bool value) {
    return {std::move(name), "boolean", value, at(2, 5)};
}
inline SceneValue text(std::string name, std::string value) {
    return {std::move(name), "string", std::move(value), at(2, 5)};
}
inline SceneValue rgb(std::string name, Vec3f value) {
    ColorValue color;
    color.rgb = value;
    return {std::move(name), "rgb", color, at(2, 5)};
}
inline SceneValue tabulated(std::string name, std::vector<float> nm, std::vector<float> values) {
    ColorValue color;
    color.kind = ColorValue::Kind::tabulated;
    color.nm = std::move(nm);
    color.values = std::move(values);
    return {std::move(name), "spectrum", color, at(2, 5)};
}

/// <tag type="type"> with parameters and nested nodes.
inline std::shared_ptr<SceneNode> node(std::string tag, std::string type,
                                       std::vector<SceneValue> values = {},
                                       std::vector<SceneNode::Child> children = {}) {
    auto n = std::make_shared<SceneNode>();
    n->tag = std::move(tag);
    n->type = std::move(type);
    n->location = at(1, 1);
    n->values = std::move(values);
    n->children = std::move(children);
    return n;
}
inline std::shared_ptr<SceneNode> bsdf(std::string type, std::vector<SceneValue> values = {},
                                       std::vector<SceneNode::Child> children = {}) {
    return node("bsdf", std::move(type), std::move(values), std::move(children));
}
inline SceneNode::Child child(SceneNodePtr inner, std::string name = {}) {
    return {std::move(name), std::move(inner), at(3, 7)};
}

inline MaterialPtr material(const SceneNodePtr& n) {
    BuildContext context;
    return make_material(*n, context);
}

/// It at a point without texture coordinates, in RGB bands.
inline Bound bound(const SceneNodePtr& n) { return Bound(material(n)); }

/// Builds and returns the message of the error, empty if there is none.
inline std::string error_of(const SceneNodePtr& n) {
    BuildContext context;
    try {
        if (n->tag == "texture")
            make_texture(*n, ColorRole::reflectance, context);
        else
            make_material(*n, context);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

struct NamedMaterial {
    std::string name;
    MaterialPtr material;
    bool two_sides;   ///< something happens on the inside
    double eta = 1.;  ///< index inside over outside where light passes with a change of direction
};

/// All types of material with the parameters in which their code differs.
inline std::vector<NamedMaterial> all_materials() {
    const auto diffuse = bsdf("diffuse", {rgb("reflectance", {0.8f, 0.5f, 0.2f})});
    const auto ggx = text("distribution", "ggx");
    const auto metal = bsdf("roughconductor", {text("material", "Cu"), number("alpha", 0.3)});
    const double glass = 1.5046 / 1.000277;
    std::vector<NamedMaterial> list;
    const auto add = [&](std::string name, const SceneNodePtr& n, bool two_sides, double eta = 1.) {
        list.push_back({std::move(name), material(n), two_sides, eta});
    };
    add("diffuse", diffuse, false);
    add("null", bsdf("null"), true);
    add("dielectric", bsdf("dielectric"), true, glass);
    add("dielectric of water in glass",
        bsdf("dielectric", {text("int_ior", "water"), number("ext_ior", 1.6)}), true, 1.333 / 1.6);
    add("thindielectric", bsdf("thindielectric"), true);
    add("conductor", bsdf("conductor", {text("material", "Au")}), false);
    add("roughconductor", metal, false);
    add("brushed roughconductor",
        bsdf("roughconductor", {ggx, number("alpha_u", 0.12), number("alpha_v", 0.5),
                                number("eta", 0.2), number("k", 3.)}),
        false);
    add("roughconductor, all normals",
        bsdf("roughconductor", {number("alpha", 0.4), flag("sample_visible", false)}), false);
    add("roughdielectric", bsdf("roughdielectric", {number("alpha", 0.25)}), true, glass);
    add("brushed roughdielectric",
        bsdf("roughdielectric", {ggx, number("alpha_u", 0.2), number("alpha_v", 0.5),
                                 number("int_ior", 1.8), number("ext_ior", 1.2)}),
        true, 1.5);
    add("roughdielectric of air in water",
        bsdf("roughdielectric", {ggx, number("alpha", 0.3), text("int_ior", "air"),
                                 text("ext_ior", "water"), flag("sample_visible", false)}),
        true, 1.000277 / 1.333);
    add("plastic", bsdf("plastic"), false);
    add("nonlinear plastic",
        bsdf("plastic", {rgb("diffuse_reflectance", {0.9f, 0.4f, 0.1f}), flag("nonlinear", true),
                         number("int_ior", 1.9)}),
        false);
    add("roughplastic", bsdf("roughplastic"), false);
    add("nonlinear ggx roughplastic",
        bsdf("roughplastic", {ggx, number("alpha", 0.4), flag("nonlinear", true),
                              number("diffuse_reflectance", 0.9), number("int_ior", 1.7)}),
        false);
    add("twosided", bsdf("twosided", {}, {child(metal)}), true);
    add("twosided of two", bsdf("twosided", {}, {child(diffuse), child(bsdf("plastic"))}), true);
    add("mask", bsdf("mask", {number("opacity", 0.3)}, {child(diffuse)}), true);
    add("blendbsdf", bsdf("blendbsdf", {number("weight", 0.4)}, {child(diffuse), child(metal)}),
        false);
    add("blendbsdf of two sides",
        bsdf("blendbsdf", {number("weight", 0.3)},
             {child(bsdf("twosided", {}, {child(diffuse)})),
              child(bsdf("roughdielectric", {number("alpha", 0.25)}))}),
        true, glass);
    add("blendbsdf with a mirror",
        bsdf("blendbsdf", {number("weight", 0.5)}, {child(diffuse), child(bsdf("thindielectric"))}),
        true);
    add("sumbsdf",
        bsdf("sumbsdf", {rgb("weight1", {0.5f, 0.4f, 0.f}), number("weight3", 0.3)},
             {child(diffuse),
              child(bsdf("roughconductor",
                         {number("alpha", 0.2), rgb("specular_reflectance", {0.1f, 0.2f, 0.3f})})),
              child(metal)}),
        false);
    add("sumbsdf with a mirror",
        bsdf("sumbsdf", {number("weight1", 0.4), rgb("weight2", {0.1f, 0.5f, 0.6f})},
             {child(diffuse), child(bsdf("thindielectric"))}),
        true);
    add("difftrans", bsdf("difftrans", {rgb("transmittance", {0.7f, 0.4f, 0.1f})}), true);
    add("coated difftrans",
        bsdf("difftrans", {number("transmittance", 0.4), number("coat", 1)},
             {child(bsdf("metallic_roughness", {number("base_color", 0.5), number("roughness", 0.4),
                                                text("coupling", "shirley")}))}),
        true);
    const auto forward = node("phase", "hg", {number("g", 0.5)});
    const std::vector<SceneValue> matter = {rgb("sigma_s", {2.f, 1.f, 0.3f}),
                                            rgb("sigma_a", {0.1f, 0.3f, 0.6f}),
                                            number("thickness", 0.4)};
    add("hk", bsdf("hk", matter, {child(forward)}), true);
    std::vector<SceneValue> in_glass = matter;
    in_glass.push_back(number("int_ior", 1.5));
    add("hk in glass", bsdf("hk", in_glass, {child(forward)}), true);
    return list;
}

}  // namespace nacre::test
