// The integrator `legacy` shows what the formulas of the illumination models say.
#include "nacre/render/legacy.h"

#include "nacre/illumination/models.h"
#include "nacre/render/render.h"
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

using illumination::Description;

std::string text(const std::string& name, const std::string& value) {
    return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}
std::string legacy(const std::string& model, const std::string& inside = "") {
    return xml::integrator("legacy", text("model", model) + inside);
}
std::string point_light(const Vec3d& p, const Vec3d& intensity = {1, 1, 1}) {
    return fmt::format(
        "<emitter type=\"point\"><point name=\"position\" value=\"{}, {}, {}\"/>{}"
        "</emitter>",
        p.x, p.y, p.z, xml::rgb("intensity", intensity));
}
const std::string white = xml::bsdf("diffuse", xml::number("reflectance", 1));
const std::string pane = xml::bsdf("thindielectric");

/// A rectangle [-4, 4]^2 with normal +z at the height z.
std::string plate(double z, const std::string& material) {
    return xml::shape("rectangle", fmt::format("<transform name=\"to_world\"><scale value=\"4\"/>"
                                               "<translate z=\"{}\"/></transform>",
                                               z) +
                                       material);
}

class Legacy : public RenderTest {
  protected:
    Vec3d look(const Scene& s, const Point3f& from, const Vec3f& d, int pixels = 2) const {
        return estimate(s, fixed_ray(from, d), {.pixels = pixels}).mean;
    }
    Vec3d look(const std::string& body, const Point3f& from = {0.3f, 0.4f, 5.f},
               const Vec3f& d = {0, 0, -1}) {
        return look(scene(body), from, d);
    }
    static void expect_rgb(const Vec3d& value, const Vec3d& expected, const std::string& what,
                           double relative = 2e-5) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(value[c], expected[c], relative * std::abs(expected[c]) + 1e-12)
                << what << ", channel " << c;
    }
};

const Vec3d light_position{2, 3, 4}, light_color{20, 10, 5};

/// What a model with its defaults shows at the point p with normal n of the unit sphere, seen from
/// `eye`, in double precision.
double formula(const Description& model, const Vec3d& eye, const Vec3d& p, double light,
               double wavelength) {
    const Vec3d l = light_position - p, v = eye - p;
    const Frame<double> frame = Frame<double>::around(p);
    illumination::Lighting<double> at{.wi = frame.to_local(normalize(l)),
                                      .wo = frame.to_local(normalize(v)),
                                      .light = light,
                                      .ambient = 0.25,
                                      .light_distance = length(l),
                                      .viewer_distance = length(v),
                                      .solid_angle = 1. / dot(l, l),
                                      .wavelength = wavelength};
    if (model.number == 12) at.wi = at.wo;
    return illumination::intensity(model, illumination::Values<double>::defaults(model), at);
}

TEST_F(Legacy, EveryModelShowsItsFormula) {
    const Vec3d eye{0.3, 0.4, 5}, p{0.3, 0.4, std::sqrt(0.75)};
    for (const Description* model : illumination::models()) {
        if (model->part == illumination::Part::transparency) continue;
        const Vec3d seen =
            look(legacy(std::to_string(model->number), xml::number("ambient", 0.25)) +
                 xml::sphere({}, 1, white) + point_light(light_position, light_color));
        const double nm[] = {611.4, 549.1, 464.2};
        Vec3d expected;
        for (int c = 0; c < 3; ++c) expected[c] = formula(*model, eye, p, light_color[c], nm[c]);
        EXPECT_GT(expected.x, 0.) << model->name;
        expect_rgb(seen, expected, std::string(model->name), 1e-4);
    }
}

TEST_F(Legacy, APixelOfAPictureShowsTheFormula) {
    // A pixel is 2/801 wide, over which the shading changes by less than the tolerance.
    const Scene s = scene(
        legacy("phong + 3 + bouknight_ambient",
               xml::number("ka", 0.5) + xml::number("kd", 0.75) + xml::number("ambient", 0.25)) +
        xml::sphere({}, 1, white) + point_light(light_position, light_color) +
        "<sensor type=\"orthographic\"><transform name=\"to_world\"><lookat origin=\"0, 0, 5\" "
        "target=\"0, 0, 0\" up=\"0, 1, 0\"/></transform><film type=\"hdrfilm\"><integer "
        "name=\"width\" value=\"801\"/><integer name=\"height\" value=\"801\"/><integer "
        "name=\"crop_offset_x\" value=\"520\"/><integer name=\"crop_offset_y\" value=\"240\"/>"
        "<integer name=\"crop_width\" value=\"1\"/><integer name=\"crop_height\" value=\"1\"/>"
        "<rfilter type=\"box\"/></film></sensor>");
    const RenderResult result = render(s, {});
    const double x = 120 * 2 / 801., y = 160 * 2 / 801.;
    const Vec3d p{x, y, std::sqrt(1 - x * x - y * y)}, eye{x, y, 5};
    const auto& models = illumination::models();
    for (int c = 0; c < 3; ++c) {
        const double expected = 0.5 * 0.25 +
                                0.75 * formula(models.find("3"), eye, p, light_color[c], 0) +
                                formula(models.find("13"), eye, p, light_color[c], 0);
        EXPECT_NEAR(result.film.mean(0, 0)[c], expected, 4e-3 * expected) << c;
    }
}

TEST_F(Legacy, LightsAddUp) {
    const std::string lights[] = {
        point_light(light_position, light_color),
        "<emitter type=\"directional\"><vector name=\"direction\" value=\"-1, 0, -1\"/></emitter>",
        "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"0, 3, 5\" "
        "target=\"0, 0, 0\" up=\"1, 0, 0\"/></transform></emitter>"};
    for (const std::string model : {"7+17", "3+18", "11+20"}) {
        const std::string stage = legacy(model) + xml::sphere({}, 1, white);
        Vec3d sum;
        for (const std::string& light : lights) {
            const Vec3d one = look(stage + light);
            EXPECT_GT(one.x, 0.);
            sum += one;
        }
        expect_rgb(look(stage + lights[0] + lights[1] + lights[2]), sum, model);
    }
}

// In the pi convention and with the inverse square law Bouknight's diffuse reflection is Lambert's.
TEST_F(Legacy, DiffuseReflectionAgreesWithPathTracing) {
    const std::string grey = xml::bsdf("diffuse", xml::rgb("reflectance", {0.8, 0.5, 0.2}));
    const std::string lights[] = {
        point_light(light_position, light_color),
        "<emitter type=\"directional\"><vector name=\"direction\" value=\"-1, 0, -1\"/></emitter>",
        xml::sphere(light_position, 0.7, xml::area_light({3, 2, 1})), xml::constant_light()};
    const double deviations = sidak_deviations(12);
    for (const std::string& light : lights) {
        const std::string stage = xml::sphere({}, 1, grey) + light;
        const RayMaker ray = fixed_ray({0.3f, 0.4f, 2.f}, {0, 0, -1});
        const EstimateOptions many{.pixels = 4000};
        const auto path = estimate(
            scene(xml::integrator("path", xml::integer("max_depth", 2)) + stage), ray, many);
        for (const std::string model : {"3", "6", "7"})
            expect_agreement(
                path,
                estimate(scene(legacy(model, text("light_convention", "pi") +
                                                 text("light_falloff", "inverse_square") +
                                                 xml::flag("shadows", true)) +
                               stage),
                         ray, {.pixels = 4000, .seed = 2}),
                deviations, "model " + model);
    }
}

TEST_F(Legacy, LightFromInfinityIsTheLimitOfFarLights) {
    const std::string sun =
        "<emitter type=\"directional\"><vector name=\"direction\" value=\"0, 0, -1\"/></emitter>";
    const double cosine = std::sqrt(0.75);
    const std::map<std::string, double> expected = {{"3", cosine},
                                                    {"6", cosine},
                                                    {"7", cosine},
                                                    {"8", cosine},
                                                    {"9", cosine / std::pow(5 - cosine, 2)},
                                                    {"11", cosine / 1.25}};
    for (const auto& [model, value] : expected) {
        const std::string c = model == "11" ? xml::number("c1", 1.25) + xml::number("c3", 2) : "";
        expect_rgb(look(legacy(model, c) + xml::sphere({}, 1, white) + sun), {value, value, value},
                   model);
    }
}

TEST_F(Legacy, UnitOfLength) {
    const std::string stage = xml::sphere({}, 1, white) + point_light(light_position, light_color);
    const Vec3d one = look(legacy("5") + stage);
    expect_rgb(look(legacy("5", xml::number("length_unit", 2)) + stage), one * 16., "Romney");
    // What is an irradiance does not depend on it.
    expect_rgb(look(legacy("7", xml::number("length_unit", 2)) + stage), look(legacy("7") + stage),
               "inverse square");
}

TEST_F(Legacy, ShadowsAreCastOnRequestOnly) {
    const std::string stage =
        plate(0, white) + point_light({0, 0, 4}) + xml::sphere({0, 0, 2}, 0.3, white);
    const auto floor = [&](const std::string& inside) {
        return look(legacy("3", inside) + stage, {3, 0, 3}, {-3, 0, -3}).x;
    };
    EXPECT_NEAR(floor(""), 1., 1e-5);
    EXPECT_EQ(floor(xml::flag("shadows", true)), 0.);
    // A transparent blocker lets its share pass, once on each side.
    const std::string glass =
        plate(0, white) + point_light({0, 0, 4}) + xml::sphere({0, 0, 2}, 0.3, pane);
    EXPECT_NEAR(look(legacy("3+21", xml::flag("shadows", true) + xml::number("kt", 0.6)) + glass,
                     {3, 0, 3}, {-3, 0, -3})
                    .x,
                0.36, 1e-5);
}

TEST_F(Legacy, SurfacesFromBehindAreShadedAsFronts) {
    const std::string stage = plate(0, white) + point_light({0, 0, -2});
    EXPECT_NEAR(look(legacy("3") + stage, {0, 0, -3}, {0, 0, 1}).x, 1., 1e-5);
    EXPECT_EQ(look(legacy("3") + stage, {0, 0, 3}, {0, 0, -1}).x, 0.);
}

TEST_F(Legacy, SurfaceColorsScaleDiffuseReflectionAndNotHighlights) {
    const std::string red = xml::bsdf("diffuse", xml::rgb("reflectance", {0.9, 0.3, 0.1}));
    const auto seen = [&](const std::string& model, const std::string& inside = "") {
        return look(legacy(model, inside) + plate(0, red) + point_light({0, 0, 4}), {0, 0, 3});
    };
    expect_rgb(seen("3"), {0.9, 0.3, 0.1}, "diffuse");
    expect_rgb(seen("1"), {0.9, 0.3, 0.1}, "ambient");
    expect_rgb(seen("13"), {1, 1, 1}, "highlight");
    expect_rgb(seen("3", xml::flag("surface_color", false)), {1, 1, 1}, "without");
    expect_rgb(seen("3", xml::rgb("kd", {0.5, 0.2, 1})), {0.45, 0.06, 0.1}, "times kd");
}

// At the foot of a wall half of the sky is free, whatever weight the cosine gives.
TEST_F(Legacy, AmbientLightIsBlocked) {
    const std::string wall =
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"1000\"/>"
        "<rotate y=\"1\" angle=\"90\"/></transform></shape>";
    const auto seen = [&](const std::string& inside, int pixels) {
        return estimate(
            scene(legacy("2", xml::number("ka", 0.8) + inside) + plate(0, white) + wall),
            fixed_ray({3, 0, 3}, {-2.999f, 0, -3}), {.pixels = pixels});
    };
    expect_radiance(seen("", 4000), {0.4, 0.4, 0.4}, 0.003, "wall");
    expect_radiance(seen(xml::number("f", 0.3), 2), {0.24, 0.24, 0.24}, 1e-6, "given");
}

TEST_F(Legacy, TransparentSurfacesShowWhatLiesBehind) {
    const std::string stage = plate(0, pane) + plate(-1, white) + point_light({0, 0, 4});
    const auto seen = [&](const std::string& model, const std::string& inside, const Vec3f& d) {
        return look(legacy(model, inside) + stage, Point3f{0, 0, 0} - d, d).x;
    };
    // Straight down both surfaces have I_d = 1 + 1/2 of ambient light; seen at 60 degrees, the pane
    // at the origin still has, and the plate behind, where the ray meets it, has less.
    const std::string ambient = xml::number("ambient", 0.5) + xml::number("ka", 1);
    EXPECT_NEAR(seen("1+3+21", ambient + xml::number("kt", 0.3), {0, 0, -1}), 1.5, 1e-5);
    const double slant = 0.5 + 5 / std::sqrt(25 + 3.);
    EXPECT_NEAR(seen("1+3+21", ambient + xml::number("kt", 0.3), {std::sqrt(3.f), 0, -1}),
                0.7 * 1.5 + 0.3 * slant, 1e-5);
    const double crow = (0.9 - 0.1) * (1 - std::pow(0.5, 2.5)) + 0.1;
    EXPECT_NEAR(seen("1+3+22", ambient, {std::sqrt(3.f), 0, -1}), (1 - crow) * 1.5 + crow * slant,
                1e-5);
    const double hall = 3 / 3.25;
    EXPECT_NEAR(seen("1+3+23", ambient, {std::sqrt(3.f), 0, -1}), (1 - hall) * 1.5 + hall * slant,
                1e-5);
    // Without a transparency model a pane is as opaque as all else.
    EXPECT_NEAR(seen("1+3", ambient, {std::sqrt(3.f), 0, -1}), 1.5, 1e-5);
}

// A slab of thickness 1 shifts a ray at 45 degrees sideways by tan(45) - tan(asin(sin 45 / n)), and
// absorbs along the way inside.
TEST_F(Legacy, RefractionBendsAndAbsorbs) {
    const double sin_t = std::sqrt(0.5) / 1.5, cos_t = std::sqrt(1 - sin_t * sin_t);
    const double kt = 3 / 3.25;
    const std::string slab =
        "<shape type=\"cube\"><transform name=\"to_world\"><scale x=\"10\" y=\"10\" z=\"0.5\"/>"
        "<translate z=\"-0.5\"/></transform>" +
        pane + "</shape>";
    const auto lamp = [](double x) {
        return xml::sphere({x, 0, -2}, 0.02, xml::area_light({1, 1, 1}));
    };
    const std::string sigma = xml::number("absorption", 0.4);
    const auto seen = [&](const std::string& inside, double x) {
        return look(legacy("3+23", inside) + slab + lamp(x), {-1, 0, 1}, {1, 0, -1}).x;
    };
    const std::string refraction = xml::flag("refraction", true);
    EXPECT_NEAR(seen("", 2), kt * kt, 1e-5);
    EXPECT_EQ(seen(refraction, 2), 0.);
    const double bent = 1 + sin_t / cos_t;
    EXPECT_NEAR(seen(refraction, bent), kt * kt, 1e-5);
    EXPECT_NEAR(seen(refraction + sigma, bent), kt * kt * std::exp(-0.4 / cos_t), 1e-5);
}

TEST_F(Legacy, LightsThemselvesAreSeenUnlessHidden) {
    const std::string lamp = xml::sphere({}, 1, xml::area_light({3, 2, 1}));
    expect_rgb(look(legacy("3") + lamp), {3, 2, 1}, "lamp");
    EXPECT_EQ(look(legacy("3", xml::flag("hide_emitters", true)) + lamp).x, 0.);
}

// Each wavelength by itself: grey light on a grey sphere is grey, and He's surface is redder than
// it is blue where it is rough beside blue light only.
TEST_F(Legacy, WavelengthsAreSeparate) {
    const std::string stage = xml::sphere({}, 1, white) + point_light(light_position);
    const auto both = [&](const std::string& model, ColorMode mode) {
        return estimate(scene(legacy(model) + stage, mode), fixed_ray({0.3f, 0.4f, 5}, {0, 0, -1}),
                        {.pixels = 4000});
    };
    const Vec3d grey = both("3", ColorMode::rgb_bands).mean;
    expect_radiance(both("3", ColorMode::spectral), grey, 0.01, "grey");
    // In the mirror direction of the light, where the cone keeps exp(-g).
    const std::string mirror = legacy("20", xml::number("ksd", 0) + xml::number("sigma0", 0.05) +
                                                xml::number("gamma", 20)) +
                               plate(0, white) + point_light({2, 0, 2});
    const Vec3d he = look(mirror, {-2, 0, 2}, {1, 0, -1});
    EXPECT_GT(he.x, 1.2 * he.z);
}

TEST_F(Legacy, WrongParametersAreRefusedWithTheirPlace) {
    const struct {
        std::string inside, message;
    } cases[] = {
        {"", "<integrator type=\"legacy\"> needs a string 'model'"},
        {text("model", ""), "'model' is empty; name one, such as '3+13'"},
        {text("model", "24"), fmt::format("unknown illumination model '24'; known are: {}",
                                          fmt::join(illumination::models().names(), ", "))},
        {text("model", "13+15"), "models 13 and 15 are of the same kind; name one of them"},
        {text("model", "13") + xml::number("ks", 2),
         "phong: ks = 2 is out of range: must lie within [0, 1]"},
        {text("model", "3") + xml::rgb("kd", {0.5, 1.5, 0}),
         "bouknight_diffuse: kd = 1.5 is out of range: must lie within [0, 1]"},
        {text("model", "10") + xml::number("dk", 0),
         "foley_van_dam_diffuse: dk = 0 is out of range: must lie within (0, inf)"},
        {text("model", "18") + text("distribution", "ggx"),
         "blinn_torrance_sparrow: unknown distribution 'ggx'; known are: phong, torrance_sparrow, "
         "trowbridge_reitz"},
        {text("model", "3") + xml::number("ks", 1),
         "<integrator type=\"legacy\"> has no parameter 'ks'"},
        {text("model", "3+21") + xml::flag("refraction", true),
         "'refraction' needs model 23 (hall_transparency), which has an index"},
        {text("model", "3+23") + xml::number("absorption", 1),
         "'absorption' needs 'refraction', which knows what is inside"},
        {text("model", "3") + xml::number("length_unit", 0),
         "'length_unit' of <integrator type=\"legacy\"> must be positive; got 0"},
        {text("model", "3") + text("light_convention", "pie"),
         "'light_convention' of <integrator type=\"legacy\"> cannot be 'pie'; did you mean 'pi'?"},
    };
    for (const auto& c : cases) {
        const std::string error =
            error_of([&] { scene(xml::integrator("legacy", c.inside) + xml::sphere({}, 1, "")); });
        EXPECT_TRUE(error.starts_with("scene.xml:2:")) << error;
        EXPECT_NE(error.find(": " + c.message), error.npos)
            << error << "\n instead of " << c.message;
    }
}

TEST_F(Legacy, NeedsAModel) {
    Scene s = scene(xml::sphere({}, 1, white));
    s.integrator.type = "legacy";
    EXPECT_EQ(error_of([&] { make_integrator(s); }),
              "integrator 'legacy' needs to know the illumination model: give the scene an "
              "<integrator type=\"legacy\"> with a <string name=\"model\">, such as \"3+13\"");
}

// The gallery's scenes are named after the model that they show; all of the stage is lit.
TEST_F(Legacy, TheGalleryShowsEveryModel) {
    for (const Description* model : illumination::models()) {
        const std::string name = fmt::format("{:02}_{}.xml", model->number, model->name);
        const Scene s = load_scene(NACRE_SOURCE_DIR "/gallery/illumination/" + name);
        ASSERT_TRUE(s.integrator.legacy) << name;
        const LegacyModel* shown = s.integrator.legacy->find(model->part);
        ASSERT_TRUE(shown) << name;
        EXPECT_EQ(shown->model, model) << name;
        EXPECT_TRUE(s.warnings.empty()) << name << ": " << s.warnings.front();
        const Vec3d ball = look(s, {0, 2.4f, 6}, {0.1f, -1.4f, -6});
        EXPECT_TRUE(ball.x > 0.02 && ball.x < 20) << name << " " << ball.x;
    }
}

}  // namespace
}  // namespace nacre
