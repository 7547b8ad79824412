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
    EXPECT_EQ(shape.subsurface->spacing, 0.5);
    EXPECT_EQ(shape.subsurface->exit, "paper");
}

TEST_F(Subsurface, TakesTheNamesOfMitsuba06) {
    const Scene s = load_with(R"(<shape type="sphere"><subsurface type="dipole">
        <spectrum name="sigmaS" value="2"/><spectrum name="sigmaA" value="0.5"/>
        <float name="intIOR" value="1.3"/><float name="extIOR" value="1"/>
        <integer name="irrSamples" value="32"/><float name="scale" value="3"/></subsurface></shape>)",
                              "0.6.0");
    const ShapeBinding& shape = s.shapes.at(0);
    EXPECT_FLOAT_EQ(boundary_eta(shape), 1.3f);
    EXPECT_EQ(shape.subsurface->irradiance_samples, 32);
    EXPECT_NEAR(shape.interior->coefficients({}, Wavelengths::rgb_bands()).sigma_t[0], 7.5, 1e-5);
}

TEST_F(Subsurface, TechniquesTakeMediaBehindSmoothBoundaries) {
    Scene s = load_with(R"(<shape type="sphere"><bsdf type="dielectric"/>
        <medium name="interior" type="homogeneous"><string name="material" value="skimmilk"/></medium>
        </shape><shape type="sphere"><bsdf type="null"/><medium name="interior" type="homogeneous"/>
        </shape><shape type="sphere"/>)");
    EXPECT_FALSE(s.shapes[0].subsurface);
    const auto surface = [](SubsurfaceSettings& settings) { settings.technique = "surface"; };
    use_technique(s, surface);
    ASSERT_TRUE(s.shapes[0].subsurface && s.shapes[1].subsurface);
    EXPECT_EQ(s.shapes[0].subsurface->technique, "surface");
    EXPECT_EQ(boundary_eta(s.shapes[1]), 1.f);
    EXPECT_FALSE(s.shapes[2].subsurface);
    EXPECT_EQ(s.integrator.type, "path");
    // What the scene says otherwise stays.
    use_technique(s, [](SubsurfaceSettings& settings) { settings.spacing = 2.; });
    EXPECT_EQ(s.shapes[0].subsurface->technique, "surface");

    Scene opaque = load_with(R"(<shape type="sphere"/>)");
    try {
        use_technique(opaque, surface);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "technique 'surface' has nothing to do: no shape has a homogeneous medium "
                     "inside behind a dielectric boundary, smooth or equally rough everywhere, "
                     "without dispersion or tint");
    }
}

TEST_F(Subsurface, OptionsOfTheCommandLine) {
    SubsurfaceSettings settings;
    set_option(settings, "spacing", "2.5");
    set_option(settings, "irradiance_samples", "64");
    set_option(settings, "points", "repulsion");
    EXPECT_EQ(settings.spacing, 2.5);
    EXPECT_EQ(settings.irradiance_samples, 64);
    set_option(settings, "free_path", "diffuse");
    EXPECT_EQ(settings.points, "repulsion");
    EXPECT_EQ(settings.free_path, "diffuse");
    const std::vector<std::array<const char*, 3>> wrong = {
        {"spaceing", "1", "unknown option 'spaceing'; did you mean 'spacing'?"},
        {"spacing", "much", "option 'spacing' = much must be a number within [0.01, 100]"},
        {"error", "-1", "option 'error' = -1 must be a number within [0, 10]"},
        {"irradiance_samples", "1.5",
         "option 'irradiance_samples' = 1.5 must be a whole number within [1, 65536]"},
        {"exit_fresnel", "normalized",
         "option 'exit_fresnel' has no value 'normalized'; did you mean 'normalised'?"}};
    for (const auto& [name, value, message] : wrong) try {
            set_option(settings, name, value);
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_STREQ(error.what(), message);
        }
}

TEST_F(Subsurface, TheFiguresAreSolids) {
    const Scene s = load_with(R"(<shape type="figure"><string name="name" value="pot"/>
        <float name="resolution" value="3"/><transform name="to_world"><scale value="0.1"/></transform>
        </shape>)");
    EXPECT_NEAR(s.rays.bounds().upper.y, 14.0, 0.1);
}

}  // namespace
}  // namespace nacre
