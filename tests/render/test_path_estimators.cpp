// Light samples, material samples and both together estimate the same radiance, for every kind of
// material and light; and volpath sees the same as path where there is no medium.
#include "nacre/render/path_tracer.h"
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

class PathEstimators : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        sky_ = two_skies({2, 1, 0.5}, {0.2, 0.3, 0.6});
        // Large enough to be found by chance.
        lights_ = {
            {"rectangle", xml::shape("rectangle",
                                     "<transform name=\"to_world\"><scale value=\"1.5\"/>"
                                     "<rotate x=\"1\" angle=\"90\"/><translate y=\"2.5\"/>"
                                     "</transform>" +
                                         xml::area_light({3, 2, 1}))},
            {"sphere", xml::sphere({1.5, 2, 1}, 0.8, xml::area_light({3, 2, 1}))},
            {"constant", xml::constant_light()},
            {"envmap", sky_},
            {"two lights", xml::sphere({1.5, 2, 1}, 0.8, xml::area_light({3, 2, 1})) + sky_}};
        const std::string twosided =
            xml::bsdf("twosided", xml::bsdf("diffuse", xml::rgb("reflectance", {0.8, 0.5, 0.2})));
        materials_ = {
            {"diffuse", xml::bsdf("diffuse", xml::rgb("reflectance", {0.8, 0.5, 0.2}))},
            {"roughconductor",
             xml::bsdf("roughconductor",
                       xml::number("alpha", 0.3) + "<string name=\"material\" value=\"Au\"/>")},
            {"plastic", xml::bsdf("plastic", xml::rgb("diffuse_reflectance", {0.8, 0.5, 0.2}))},
            {"roughplastic", xml::bsdf("roughplastic", xml::number("alpha", 0.3))},
            {"roughdielectric", xml::bsdf("roughdielectric", xml::number("alpha", 0.4))},
            {"mask", xml::bsdf("mask", xml::number("opacity", 0.6) + twosided)},
            {"pane",
             xml::bsdf("thindielectric", xml::rgb("specular_transmittance", {0.9, 0.5, 0.1}))},
        };
    }
    /// A sphere of the material on a diffuse floor.
    std::string stage(const std::string& material) const {
        return xml::sphere({}, 1, material) +
               xml::shape("rectangle",
                          "<transform name=\"to_world\"><scale value=\"4\"/>"
                          "<rotate x=\"1\" angle=\"-90\"/><translate y=\"-1.2\"/></transform>" +
                              xml::bsdf("diffuse", xml::number("reflectance", 0.6)));
    }
    void check(int pixels, double largest_error) {
        const double deviations =
            sidak_deviations(9 * static_cast<int>(materials_.size() * lights_.size()));
        const RayMaker rays = ray_bundle({0.5f, 2.5f, 4.f}, {-0.12f, -0.6f, -1.f}, 1.3f);
        for (const auto& [material, material_text] : materials_)
            for (const auto& [light, light_text] : lights_) {
                const std::string what = material + ", " + light;
                const auto make = [&](const std::string& type) {
                    return scene(xml::integrator(type, xml::integer("max_depth", 7)) +
                                 stage(material_text) + light_text);
                };
                const Scene s = make("path");
                using E = PathTracer::Estimators;
                std::vector<RadianceEstimate> e;
                std::uint64_t seed = 1;
                for (const E which : {E::both, E::material_only, E::light_only})
                    e.push_back(estimate(s, PathTracer(s, false, which), rays,
                                         {.pixels = pixels, .seed = seed++}));
                expect_agreement(e[0], e[1], deviations, what + ", both and material");
                expect_agreement(e[0], e[2], deviations, what + ", both and light");
                expect_agreement(e[0],
                                 estimate(make("volpath"), rays, {.pixels = pixels, .seed = seed}),
                                 deviations, what + ", path and volpath");
                EXPECT_LT(e[0].error[1], largest_error * e[0].mean[1]) << what;
            }
    }
    std::string sky_;
    std::map<std::string, std::string> lights_, materials_;
};

TEST_F(PathEstimators, AgreeForEveryMaterialAndLight) { check(1000, 0.03); }

using LongPathEstimators = PathEstimators;
TEST_F(LongPathEstimators, AgreeForEveryMaterialAndLight) { check(30000, 0.006); }

}  // namespace
}  // namespace nacre
