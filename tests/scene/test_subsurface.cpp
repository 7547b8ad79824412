// <subsurface> in scene files: what it makes of a shape.
#include "nacre/scene/subsurface.h"

#include <gtest/gtest.h>

#include "nacre/scene/load.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

class Subsurface : public SceneFiles {
  protected:
    Scene load_with(const std::string& shape, const std::string& version = "3.0.0") {
        return load_scene(
            write("scene.xml", "<scene version=\"" + version + "\">" + shape + "</scene>"));
    }
};

TEST_F(Subsurface, MakesAMediumAndABoundary) {
    const Scene s = load_with(R"(<shape type="sphere"><subsurface type="dipole">
        <string name="material" value="marble"/><float name="spacing" value="0.5"/>
        <string name="exit_fresnel" value="paper"/></subsurface></shape>)");
    const ShapeBinding& shape = s.shapes.at(0);
    ASSERT_TRUE(shape.interior && shape.subsurface);
    EXPECT_TRUE(is_translucent(shape));
    EXPECT_FLOAT_EQ(boundary_eta(shape), 1.5f / 1.000277f);
    const auto c = shape.interior->coefficients({}, Wavelengths::rgb_bands());
    EXPECT_NEAR(c.sigma_s[1], 2.62, 1e-5);
    EXPECT_NEAR(c.sigma_t[2], 3.0071, 1e-5);
    EXPECT_EQ(shape.subsurface->technique, "two_pass");
    EXPECT_EQ(shape.subsurface->profile, "dipole");
    ASSERT_EQ(shape.subsurface->options.size(), 2u);
    EXPECT_EQ(shape.subsurface->options[0].name, "spacing");
    EXPECT_EQ(shape.subsurface->options[0].value, "0.5");
    EXPECT_TRUE(shape.subsurface->options[0].where.ends_with("scene.xml:2:49"))
        << shape.subsurface->options[0].where;
    EXPECT_EQ(shape.subsurface->options[1].name, "exit_fresnel");
    EXPECT_EQ(shape.subsurface->options[1].value, "paper");
}

TEST_F(Subsurface, TakesTheNamesOfMitsuba06) {
    const Scene s = load_with(R"(<shape type="sphere"><subsurface type="dipole">
        <spectrum name="sigmaS" value="2"/><spectrum name="sigmaA" value="0.5"/>
        <float name="intIOR" value="1.3"/><float name="extIOR" value="1"/>
        <integer name="irrSamples" value="32"/><float name="scale" value="3"/></subsurface></shape>)",
                              "0.6.0");
    const ShapeBinding& shape = s.shapes.at(0);
    EXPECT_FLOAT_EQ(boundary_eta(shape), 1.3f);
    ASSERT_EQ(shape.subsurface->options.size(), 1u);
    EXPECT_EQ(shape.subsurface->options[0].name, "irr_samples");
    EXPECT_EQ(shape.subsurface->options[0].value, "32");
    EXPECT_NEAR(shape.interior->coefficients({}, Wavelengths::rgb_bands()).sigma_t[0], 7.5, 1e-5);
}

TEST_F(Subsurface, TechniquesTakeMediaBehindSmoothBoundaries) {
    const Scene s = load_with(R"(<shape type="sphere"><bsdf type="dielectric"/>
        <medium name="interior" type="homogeneous"><string name="material" value="skimmilk"/></medium>
        </shape><shape type="sphere"><bsdf type="null"/><medium name="interior" type="homogeneous"/>
        </shape><shape type="sphere"/>)");
    EXPECT_FALSE(s.shapes[0].subsurface);
    EXPECT_TRUE(is_translucent(s.shapes[0]) && is_translucent(s.shapes[1]));
    EXPECT_EQ(boundary_eta(s.shapes[1]), 1.f);
    EXPECT_FALSE(is_translucent(s.shapes[2]));
}

TEST_F(Subsurface, TheFiguresAreSolids) {
    const Scene s = load_with(R"(<shape type="figure"><string name="name" value="pot"/>
        <float name="resolution" value="3"/><transform name="to_world"><scale value="0.1"/></transform>
        </shape>)");
    EXPECT_NEAR(s.rays.bounds().upper.y, 14.0, 0.1);
}

}  // namespace
}  // namespace nacre
