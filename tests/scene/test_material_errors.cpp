// What users get to read when a material's parameters are wrong.
#include "nacre/reflectance/registry.h"
#include "tests/scene/material_fixture.h"

namespace nacre {
namespace {

using test::bsdf;
using test::child;
using test::flag;
using test::number;
using test::rgb;
using test::tabulated;
using test::text;

struct WrongMaterial {
    SceneNodePtr node;
    std::string message;
};

std::vector<std::string_view> model_names() {
    std::vector<std::string_view> names;
    for (const ModelDescription* m : models()) names.push_back(m->name);
    return names;
}

TEST(MaterialErrors, SayWhatIsWrongWhereAndHowToMendIt) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto diffuse = bsdf("diffuse");
    const WrongMaterial wrong[] = {
        {bsdf("difuse"), "test.xml:1:1: unknown bsdf type 'difuse'; did you mean 'diffuse'?"},
        {bsdf("xyzzy"),
         fmt::format(
             "test.xml:1:1: unknown bsdf type 'xyzzy'; known are: blendbsdf, conductor, "
             "dielectric, difftrans, diffuse, hk, mask, measured, null, plastic, roughconductor, "
             "roughdielectric, "
             "roughplastic, sumbsdf, thindielectric, twosided, {}",
             fmt::join(model_names(), ", "))},
        {bsdf("diffuse", {number("reflectence", 0.5)}),
         "test.xml:2:5: <bsdf type=\"diffuse\"> has no parameter 'reflectence'; did you mean "
         "'reflectance'?"},
        {bsdf("null", {number("alpha", 0.5)}),
         "test.xml:2:5: <bsdf type=\"null\"> has no parameter 'alpha'"},
        {bsdf("diffuse", {number("reflectance", 1.5)}),
         "test.xml:2:5: 'reflectance' of <bsdf type=\"diffuse\"> must lie within [0, 1], lest "
         "energy appear from nowhere; got 1.5"},
        {bsdf("diffuse", {rgb("reflectance", {0.5f, -0.25f, 0.5f})}),
         "test.xml:2:5: 'reflectance' of <bsdf type=\"diffuse\"> must lie within [0, 1], lest "
         "energy appear from nowhere; got -0.25"},
        {bsdf("diffuse", {rgb("reflectance", {0.5f, 0.5f, nan})}),
         "test.xml:2:5: 'reflectance' of <bsdf type=\"diffuse\"> must lie within [0, 1], lest "
         "energy appear from nowhere; got nan"},
        {bsdf("plastic", {tabulated("diffuse_reflectance", {400.f, 700.f}, {0.5f, 2.f})}),
         "test.xml:2:5: 'diffuse_reflectance' of <bsdf type=\"plastic\"> must lie within [0, 1], "
         "lest energy appear from nowhere; got 2"},
        {bsdf("mask", {number("opacity", 1.25)}, {child(diffuse)}),
         "test.xml:2:5: 'opacity' of <bsdf type=\"mask\"> must lie within [0, 1], lest energy "
         "appear from nowhere; got 1.25"},
        {bsdf("roughconductor", {number("alpha", 0.)}),
         "test.xml:2:5: 'alpha' of <bsdf type=\"roughconductor\"> must be positive; got 0; without "
         "roughness, use the smooth material of the same kind"},
        {bsdf("roughdielectric", {number("alpha_u", 0.1), number("alpha_v", -0.5)}),
         "test.xml:2:5: 'alpha_v' of <bsdf type=\"roughdielectric\"> must be positive; got -0.5; "
         "without roughness, use the smooth material of the same kind"},
        {bsdf("roughconductor", {number("alpha_u", 0.1)}),
         "test.xml:1:1: <bsdf type=\"roughconductor\"> has 'alpha_u' but not 'alpha_v'; give both"},
        {bsdf("roughconductor",
              {number("alpha", 0.1), number("alpha_u", 0.1), number("alpha_v", 0.1)}),
         "test.xml:1:1: <bsdf type=\"roughconductor\"> takes either 'alpha' or 'alpha_u' and "
         "'alpha_v', not both"},
        {bsdf("roughplastic", {number("alpha_u", 0.1), number("alpha_v", 0.2)}),
         "test.xml:2:5: <bsdf type=\"roughplastic\"> is isotropic; give 'alpha'"},
        {bsdf("roughplastic", {text("distribution", "gggx")}),
         "test.xml:2:5: 'distribution' of <bsdf type=\"roughplastic\"> cannot be 'gggx'; did you "
         "mean 'ggx'?"},
        {bsdf("dielectric", {number("int_ior", 0.)}),
         "test.xml:2:5: 'int_ior' of <bsdf type=\"dielectric\">: index of refraction: n = 0 must "
         "be positive"},
        {bsdf("plastic", {number("ext_ior", -1.)}),
         "test.xml:2:5: 'ext_ior' of <bsdf type=\"plastic\">: index of refraction: n = -1 must be "
         "positive"},
        {bsdf("dielectric", {flag("int_ior", true)}),
         "test.xml:2:5: 'int_ior' of <bsdf type=\"dielectric\"> is a boolean, but a float was "
         "expected"},
        {bsdf("dielectric", {text("int_ior", "cauchy 1.5")}),
         "test.xml:2:5: 'int_ior' of <bsdf type=\"dielectric\">: a dispersion formula is written "
         "'cauchy a b [c]'"},
        {bsdf("dielectric", {text("int_ior", "sellmeier 1 2 x")}),
         "test.xml:2:5: 'int_ior' of <bsdf type=\"dielectric\">: a dispersion formula is written "
         "'sellmeier b1 b2 b3 c1 c2 c3'"},
        {bsdf("dielectric", {rgb("int_ior", {1.f, 1.f, 1.f})}),
         "test.xml:2:5: 'int_ior' of <bsdf type=\"dielectric\">: an index of refraction is a "
         "number, a name or a tabulated spectrum"},
        {bsdf("plastic", {text("int_ior", "dispersive bk7")}),
         "test.xml:1:1: <bsdf type=\"plastic\"> takes one index of refraction for all "
         "wavelengths; only smooth dielectrics disperse light"},
        {bsdf("roughdielectric", {text("int_ior", "air")}),
         "test.xml:1:1: 'int_ior' and 'ext_ior' of <bsdf type=\"roughdielectric\"> are equal, so "
         "there is no boundary; use <bsdf type=\"null\">"},
        {bsdf("conductor", {text("material", "Cu"), number("k", 2.)}),
         "test.xml:2:5: <bsdf type=\"conductor\"> takes either 'material' or 'eta' and 'k', not "
         "both"},
        {bsdf("twosided"),
         "test.xml:1:1: <bsdf type=\"twosided\"> takes 1 or 2 nested <bsdf>, but 0 are given"},
        {bsdf("twosided", {}, {child(diffuse), child(diffuse), child(diffuse)}),
         "test.xml:1:1: <bsdf type=\"twosided\"> takes 1 or 2 nested <bsdf>, but 3 are given"},
        {bsdf("twosided", {}, {child(bsdf("dielectric"))}),
         "test.xml:1:1: <bsdf type=\"dielectric\"> lets light through and so has two sides "
         "already; it cannot be nested in <bsdf type=\"twosided\">"},
        {bsdf("twosided", {}, {child(diffuse), child(bsdf("mask", {}, {child(diffuse)}))}),
         "test.xml:1:1: <bsdf type=\"mask\"> lets light through and so has two sides already; it "
         "cannot be nested in <bsdf type=\"twosided\">"},
        {bsdf("mask", {}, {child(diffuse), child(diffuse)}),
         "test.xml:1:1: <bsdf type=\"mask\"> takes 1 nested <bsdf>, but 2 are given"},
        {bsdf("mask", {number("cutoff", 1.5)}, {child(diffuse)}),
         "test.xml:2:5: 'cutoff' of <bsdf type=\"mask\"> must lie within [0, 1]; got 1.5"},
        {bsdf("blendbsdf", {}, {child(diffuse)}),
         "test.xml:1:1: <bsdf type=\"blendbsdf\"> takes 2 nested <bsdf>, but 1 is given"},
        {bsdf("sumbsdf", {}, {child(diffuse)}),
         "test.xml:1:1: <bsdf type=\"sumbsdf\"> takes 2 to 9 nested <bsdf>, but 1 is given"},
        {bsdf("sumbsdf", {number("weight2", 1.5)}, {child(diffuse), child(diffuse)}),
         "test.xml:2:5: 'weight2' of <bsdf type=\"sumbsdf\"> must lie within [0, 1], lest energy "
         "appear from nowhere; got 1.5"},
        {bsdf("sumbsdf", {number("weight3", 0.5)}, {child(diffuse), child(diffuse)}),
         "test.xml:2:5: <bsdf type=\"sumbsdf\"> has no parameter 'weight3'; did you mean "
         "'weight1'?"},
        {bsdf("blendbsdf", {number("weight", 2)}, {child(diffuse), child(diffuse)}),
         "test.xml:2:5: 'weight' of <bsdf type=\"blendbsdf\"> must lie within [0, 1], lest energy "
         "appear from nowhere; got 2"},
        {bsdf("difftrans", {}, {child(bsdf("dielectric"))}),
         "test.xml:1:1: <bsdf type=\"dielectric\"> lets light through by itself; <bsdf "
         "type=\"difftrans\"> takes a reflection"},
        {bsdf("difftrans", {number("f0", 1)}),
         "test.xml:2:5: 'f0' of <bsdf type=\"difftrans\"> must lie within [0, 0.99]; got 1"},
        {bsdf("hk", {number("thickness", 0.)}),
         "test.xml:2:5: 'thickness' of <bsdf type=\"hk\"> must be positive; got 0"},
        {bsdf("hk", {number("thickness", nan)}),
         "test.xml:2:5: 'thickness' of <bsdf type=\"hk\"> must be positive; got nan"},
        {bsdf("hk", {number("sigma_s", -1.), number("sigma_a", 1.)}),
         "test.xml:2:5: 'sigma_s' must be finite and at least 0, but has the value -1"},
        {bsdf("hk", {number("sigma_s", 1.)}), "test.xml:2:5: 'sigma_s' needs 'sigma_a' as well"},
        {bsdf("hk", {number("sigma_s", 1.), number("sigma_a", 1.), number("albedo", 0.5)}),
         "test.xml:2:5: give either 'sigma_t' and 'albedo' or 'sigma_s' and 'sigma_a', not a "
         "mixture"},
        {bsdf("hk", {number("albedo", 1.5)}),
         "test.xml:2:5: 'albedo' must lie within [0, 1], but has the value 1.5"},
        {bsdf("hk", {text("material", "marble"), number("sigma_t", 1.)}),
         "test.xml:2:5: give either 'material' or 'sigma_t', not both"},
        {bsdf("hk", {flag("sigma_t", true)}),
         "test.xml:2:5: 'sigma_t' of <bsdf type=\"hk\"> is a boolean, but a colour was expected"},
        {bsdf("hk", {number("material", 2.)}),
         "test.xml:2:5: 'material' of <bsdf type=\"hk\"> is a float, but a string was expected"},
        {bsdf("hk", {number("sigmas", 1.)}),
         "test.xml:2:5: <bsdf type=\"hk\"> has no parameter 'sigmas'; did you mean 'sigma_s'?"},
        {bsdf("hk", {number("int_ior", -1.)}),
         "test.xml:2:5: 'int_ior' of <bsdf type=\"hk\">: index of refraction: n = -1 must be "
         "positive"},
        {bsdf("hk", {text("int_ior", "dispersive bk7")}),
         "test.xml:1:1: <bsdf type=\"hk\"> takes one index of refraction for all wavelengths; only "
         "smooth dielectrics disperse light"},
        {bsdf("hk", {}, {child(test::node("phase", "hgg"))}),
         "test.xml:1:1: unknown phase function 'hgg'; did you mean 'hg'?"},
        {bsdf("hk", {}, {child(test::node("phase", "hg")), child(test::node("phase", "hg"))}),
         "test.xml:3:7: a medium has only one phase function"},
        {bsdf("hk", {}, {child(diffuse)}),
         "test.xml:3:7: <bsdf type=\"hk\"> cannot hold <bsdf type=\"diffuse\">"},
        {bsdf("diffuse", {}, {child(diffuse)}),
         "test.xml:3:7: <bsdf type=\"diffuse\"> cannot hold <bsdf type=\"diffuse\">"},
    };
    for (const WrongMaterial& w : wrong) EXPECT_EQ(test::error_of(w.node), w.message);
}

TEST(MaterialErrors, SuggestNamesOfKnownSubstances) {
    EXPECT_EQ(test::error_of(bsdf("dielectric", {text("int_ior", "diamnd")})),
              "test.xml:2:5: 'int_ior' of <bsdf type=\"dielectric\">: unknown dielectric 'diamnd'; "
              "did you mean 'diamond'?");
    const std::string metal = test::error_of(bsdf("conductor", {text("material", "Auu")}));
    EXPECT_TRUE(metal.starts_with("test.xml:2:5: 'material' of <bsdf type=\"conductor\">: "))
        << metal;
    EXPECT_NE(metal.find("Au"), std::string::npos) << metal;
    const std::string prism =
        test::error_of(bsdf("dielectric", {text("int_ior", "dispersive unobtainium")}));
    EXPECT_NE(prism.find("fused quartz"), std::string::npos) << prism;
}

}  // namespace
}  // namespace nacre
