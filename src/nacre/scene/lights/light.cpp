#include "nacre/scene/light.h"

#include "nacre/scene/lights/types.h"
#include "nacre/text/names.h"

namespace nacre {

namespace {

using Factory = LightPtr (*)(const SceneNode&, BuildContext&);
constexpr std::pair<std::string_view, Factory> factories[] = {
    {"point", make_point_light},
    {"spot", make_spot_light},
    {"directional", make_directional_light},
    {"constant", make_constant_light},
    {"envmap", make_environment_map},
};

}  // namespace

SpectrumPtr default_emission() { return make_rgb_illuminant({1.f, 1.f, 1.f}); }

LightPtr make_light(const SceneNode& node, BuildContext& context) {
    if (node.type == "area")
        node.fail("an area light belongs to a shape: put <emitter type=\"area\"> inside a <shape>");
    std::vector<std::string> known;
    for (const auto& [name, factory] : factories) {
        if (name == node.type) {
            LightPtr light = factory(node, context);
            node.check_all_used();
            return light;
        }
        known.emplace_back(name);
    }
    node.fail(unknown_name("emitter type", node.type, known));
}

}  // namespace nacre
