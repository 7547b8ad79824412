// Points, spots, directional and constant lights against closed forms.
#include "nacre/spectrum/color.h"
#include "tests/scene/light_fixture.h"

namespace nacre {
namespace {

TEST_F(Lights, PointFollowsTheInverseSquare) {
    const LightPtr made = light(
        "<emitter type=\"point\"><point name=\"position\" value=\"1, 2, 3\"/>"
        "<rgb name=\"intensity\" value=\"5, 10, 20\"/></emitter>");
    const LightSample s = made->sample({1.f, 2.f, -1.f}, {}, bands);
    EXPECT_TRUE(s.delta && made->is_delta());
    EXPECT_EQ(s.pdf, 1.f);
    EXPECT_EQ(s.wi, Vec3f(0.f, 0.f, 1.f));
    EXPECT_EQ(s.distance, 4.f);
    EXPECT_FLOAT_EQ(s.radiance[1], 10.f / 16.f);
    EXPECT_EQ(made->pdf({1.f, 2.f, -1.f}, s.wi, nullptr), 0.f);
    EXPECT_NEAR(made->power(), 4.0 * pi * luminance({5.f, 10.f, 20.f}), 1e-3);
    // Seen obliquely: E = I cos / d^2.
    expect_estimate(irradiance(*made, {1.f, -1.f, -1.f}, {0.f, 0.f, 1.f}, 1), 10.0 * 0.8 / 25.0);
}

TEST_F(Lights, PointStandsWhereItsTransformPutsIt) {
    const LightPtr made = light(
        "<emitter type=\"point\"><transform name=\"to_world\"><translate x=\"3\"/></transform>"
        "</emitter>");
    EXPECT_EQ(made->bounds().lower, Point3f(3.f, 0.f, 0.f));
    EXPECT_NEAR(made->sample({3.f, 0.f, 2.f}, {}, bands).radiance[0], 0.25f, 1e-6f);  // default 1
}

TEST_F(Lights, SpotFallsLinearlyInTheAngle) {
    const LightPtr made = light(
        "<emitter type=\"spot\"><rgb name=\"intensity\" value=\"8, 8, 8\"/>"
        "<float name=\"cutoff_angle\" value=\"30\"/><float name=\"beam_width\" value=\"10\"/>"
        "<transform name=\"to_world\"><lookat origin=\"0, 0, 0\" target=\"1, 0, 0\" "
        "up=\"0, 0, 1\"/></transform></emitter>");
    for (const auto& [degrees, factor] : {std::pair{0.0, 1.0},
                                          {9.9, 1.0},
                                          {15.0, 0.75},
                                          {20.0, 0.5},
                                          {29.0, 0.05},
                                          {30.1, 0.0},
                                          {150.0, 0.0}}) {
        const double a = degrees * pi / 180.0;
        const Point3f p(float(2.0 * std::cos(a)), 0.f, float(2.0 * std::sin(a)));
        EXPECT_NEAR(made->sample(p, {}, bands).radiance[0], 8.0 / 4.0 * factor, 1e-4) << degrees;
    }
    // Power: 2 pi times the integral of the falloff over the cosine; `power` may be rough.
    double power = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const double a = (i + 0.5) / 3000.0 * pi / 6.0;
        power += 8.0 * std::clamp((30.0 - a * 180.0 / pi) / 20.0, 0.0, 1.0) * 2.0 * pi *
                 std::sin(a) * pi / 6.0 / 3000.0;
    }
    EXPECT_NEAR(made->power() / power, 1.0, 0.2);
}

TEST_F(Lights, SpotHasMitsubasDefaults) {
    const LightPtr made = light("<emitter type=\"spot\"/>");  // 20 degrees, beam 15
    const auto at = [&](double degrees) {
        const double a = degrees * pi / 180.0;
        return made->sample({float(std::sin(a)), 0.f, float(std::cos(a))}, {}, bands).radiance[1];
    };
    EXPECT_NEAR(at(14.9), 1.0, 1e-5);
    EXPECT_NEAR(at(17.5), 0.5, 1e-4);
    EXPECT_EQ(at(20.1), 0.f);
}

TEST_F(Lights, DirectionalHasTheSameIrradianceEverywhere) {
    context_.scene_radius = 2.f;
    const LightPtr made = light(
        "<emitter type=\"directional\"><vector name=\"direction\" "
        "value=\"0, -3, -4\"/><rgb name=\"irradiance\" value=\"1, 5, 1\"/>"
        "</emitter>");
    expect_estimate(irradiance(*made, {9.f, 9.f, 9.f}, {0.f, 0.f, 1.f}, 1), 5.0 * 0.8);
    EXPECT_TRUE(made->bounds().empty());
    EXPECT_FALSE(made->is_infinite());
    EXPECT_NEAR(made->power(), 4.0 * pi * luminance({1.f, 5.f, 1.f}), 1e-3);
    // By a transform: along its z axis.
    const LightPtr other = light(
        "<emitter type=\"directional\"><transform name=\"to_world\"><lookat "
        "origin=\"0,0,0\" target=\"1,0,0\" up=\"0,1,0\"/></transform></emitter>");
    EXPECT_NEAR(other->sample({}, {}, bands).wi.x, -1.f, 1e-6f);
}

TEST_F(Lights, ConstantLightGivesPiL) {
    context_.scene_radius = 3.f;
    const LightPtr made =
        light("<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1, 2, 3\"/></emitter>");
    expect_estimate(irradiance(*made, {}, normalize(Vec3f(1.f, 2.f, -1.f))), 2.0 * pi);
    EXPECT_FLOAT_EQ(made->pdf({}, {0.f, 0.f, 1.f}, nullptr), float(1.0 / (4.0 * pi)));
    // Through the bounding sphere's cross section of pi 3^2, from 4 pi sr.
    EXPECT_NEAR(made->power(), 9.0 * pi * 4.0 * pi * luminance({1.f, 2.f, 3.f}), 0.01);
}

TEST_F(Lights, WrongInputIsExplained) {
    for (const auto& [xml, message] : {
             std::pair<std::string, std::string>{
                 "<emitter type=\"pont\"/>", "unknown emitter type 'pont'; did you mean 'point'?"},
             {"<emitter type=\"area\"/>",
              "an area light belongs to a shape: put <emitter "
              "type=\"area\"> inside a <shape>"},
             {"<emitter type=\"point\"><float name=\"intensty\" value=\"1\"/></emitter>",
              "<emitter type=\"point\"> has no parameter 'intensty'; did you mean 'intensity'?"},
             {"<emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"190\"/></emitter>",
              "cutoff_angle must lie between 0 and 180 degrees; got 190"},
             {"<emitter type=\"spot\"><float name=\"beam_width\" value=\"25\"/></emitter>",
              "beam_width must lie between 0 and 20 degrees; got 25"},
             {"<emitter type=\"directional\"><vector name=\"direction\" value=\"0, 0, "
              "0\"/></emitter>",
              "direction must be a vector of finite length greater than 0"},
             {"<emitter type=\"envmap\"/>", "<emitter type=\"envmap\"> needs a string 'filename'"},
         }) {
        const std::string error = error_of([&] { light(xml); });
        EXPECT_TRUE(error.starts_with("scene.xml:2:")) << error;
        EXPECT_EQ(error.substr(std::min(error.size(), error.find(' ') + 1)), message);
    }
}

}  // namespace
}  // namespace nacre
