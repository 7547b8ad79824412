// The environment map: where its pixels lie on the sphere, and that it is sampled as it says.

#include "nacre/math/random.h"
#include "nacre/scene/lights/types.h"
#include "nacre/spectrum/color.h"
#include "tests/scene/bands.h"
#include "tests/scene/scene_files.h"
#include "tests/support/constants.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

Image blank(int width, int height) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = {"R", "G", "B"};
    image.data.resize(std::size_t(width) * height * 3);
    return image;
}
void set(Image& image, int x, int y, const Vec3f& rgb) {
    for (int c = 0; c < 3; ++c) image.at(x, y, c) = rgb[c];
}
LightPtr environment(const Image& image, const Transform& to_world = {}, float scale = 1.f) {
    std::vector<std::string> warnings;
    return make_environment_map(image, {scale, to_world, 1.f}, "map", warnings);
}
Vec3f direction_of_texel(double u, double v) {
    return {float(std::sin(pi * v) * std::sin(2 * pi * u)), float(std::cos(pi * v)),
            float(-std::sin(pi * v) * std::cos(2 * pi * u))};
}
Image random_map(int width, int height) {
    Image image = blank(width, height);
    Random random(4);
    for (float& v : image.data) {
        const float u = random.next();
        v = u < 0.3f ? 0.f : 10.f * u * u * u;
    }
    return image;
}

TEST(EnvironmentMap, PixelsLieWhereMitsubaPutsThem) {
    // Four columns centred at azimuths of 45, 135, 225 and 315 degrees from -Z over +X; three rows
    // at the upper pole, the horizon and the lower pole.
    const float h = std::sqrt(0.5f);
    struct Case {
        int x, y;
        Vec3f direction;
    };
    for (const Case& c : {Case{0, 1, {h, 0.f, -h}},
                          {1, 1, {h, 0.f, h}},
                          {2, 1, {-h, 0.f, h}},
                          {3, 1, {-h, 0.f, -h}}}) {
        Image image = blank(4, 3);
        set(image, c.x, c.y, {1.f, 2.f, 3.f});
        const LightPtr light = environment(image);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(light->radiance(nullptr, c.direction, bands)[i], i + 1.f, 1e-5f);
        // Halfway to the neighbour across, and none opposite.
        const Vec3f beside = normalize(c.direction + Vec3f(-c.direction.z, 0.f, c.direction.x));
        EXPECT_NEAR(light->radiance(nullptr, beside, bands)[0], 0.5f, 1e-5f);
        EXPECT_NEAR(light->radiance(nullptr, -c.direction, bands)[0], 0.f, 1e-5f);
        // A quarter turn about y takes +Z to +X.
        const LightPtr turned = environment(image, Transform::rotate({0, 1, 0}, 90));
        const Vec3f there{c.direction.z, 0.f, -c.direction.x};
        EXPECT_NEAR(turned->radiance(nullptr, there, bands)[1], 2.f, 1e-5f);
    }
    Image poles = blank(4, 3);
    for (int x = 0; x < 4; ++x)
        set(poles, x, 0, {1.f, 1.f, 1.f}), set(poles, x, 2, {5.f, 5.f, 5.f});
    EXPECT_NEAR(environment(poles)->radiance(nullptr, {0.f, 1.f, 0.f}, bands)[0], 1.f, 1e-5f);
    EXPECT_NEAR(environment(poles)->radiance(nullptr, {0.f, -1.f, 0.f}, bands)[0], 5.f, 1e-5f);
    EXPECT_NEAR(environment(poles, Transform::rotate({1, 0, 0}, 90))
                    ->radiance(nullptr, {0.f, 0.f, 1.f}, bands)[0],
                1.f, 1e-5f);
}

TEST(EnvironmentMap, DensityIntegratesToOneAndIsThatOfTheSamples) {
    const int width = 12, height = 9;
    const LightPtr light = environment(random_map(width, height));
    // Midpoint quadrature that subdivides the cells, in which the density is constant.
    constexpr int fine = 10;
    const int columns = width, rows = height - 1;
    std::vector<double> expected(std::size_t(columns) * rows, 0.0), counts = expected;
    double integral = 0.0;
    for (int y = 0; y < rows * fine; ++y) {
        const double c0 = std::cos(pi * y / (rows * fine)),
                     c1 = std::cos(pi * (y + 1) / (rows * fine));
        const double omega = 2.0 * pi / (columns * fine) * (c0 - c1);
        for (int x = 0; x < columns * fine; ++x) {
            const Vec3f d = direction_of_texel((x + 0.5) / (columns * fine) + 0.5 / width,
                                               (y + 0.5) / (rows * fine));
            const double mass = light->pdf({}, d, nullptr) * omega;
            expected[std::size_t(y / fine) * columns + x / fine] += mass;
            integral += mass;
        }
    }
    EXPECT_NEAR(integral, 1.0, 1e-5);

    constexpr int n = 200000;
    Random random(8);
    for (int i = 0; i < n; ++i) {
        const LightSample s = light->sample({}, random.next2(), bands);
        ASSERT_GT(s.pdf, 0.f);
        EXPECT_EQ(s.pdf, light->pdf({}, s.wi, nullptr));
        EXPECT_EQ(s.radiance[0], light->radiance(nullptr, s.wi, bands)[0]);
        double u = std::atan2(s.wi.x, -s.wi.z) / (2 * pi) - 0.5 / width;
        u -= std::floor(u);
        const double v = std::acos(std::clamp(s.wi.y, -1.f, 1.f)) / pi;
        ++counts[std::size_t(std::min(int(v * rows), rows - 1)) * columns +
                 std::min(int(u * columns), columns - 1)];
    }
    for (double& e : expected) e *= n;
    EXPECT_TRUE(test::chi_square_passes(counts, expected));
}

TEST(EnvironmentMap, SamplesGiveTheIrradianceOfTheMap) {
    const Transform turn = Transform::rotate({1, 2, 3}, 50);
    const LightPtr light = environment(random_map(16, 9), turn, 2.f);
    const Vec3f n = normalize(Vec3f(1.f, -1.f, 2.f));
    double truth = 0.0;  // uniform directions by quadrature of the bilinear map
    constexpr int rows = 400, columns = 800;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const Vec3f d = turn.vector(direction_of_texel((x + 0.5) / columns, (y + 0.5) / rows));
            const double omega =
                2 * pi / columns * (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows));
            truth += light->radiance(nullptr, d, bands)[1] * std::max(0.f, dot(d, n)) * omega;
        }
    Random random(2);
    double sum = 0.0, sum2 = 0.0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        const LightSample s = light->sample({}, random.next2(), bands);
        const double e = s.radiance[1] * std::max(0.f, dot(s.wi, n)) / s.pdf;
        sum += e;
        sum2 += e * e;
    }
    const double mean = sum / count, error = std::sqrt((sum2 / count - mean * mean) / count);
    EXPECT_NEAR(mean, truth, 4 * error + 1e-4 * truth);
    EXPECT_LT(error, 0.01 * truth);
}

TEST(EnvironmentMap, AUniformMapIsAConstantLight) {
    Image image = blank(8, 5);
    const Vec3f color{0.2f, 1.5f, 0.7f};
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 8; ++x) set(image, x, y, color);
    const LightPtr light = environment(image);
    EXPECT_NEAR(light->power(), 4 * pi * pi * luminance(color), 1e-4);
    EXPECT_TRUE(light->is_infinite());
    EXPECT_TRUE(light->bounds().empty());
    Random random(1);
    const Wavelengths nm = Wavelengths::at({420.f, 500.f, 580.f, 660.f});
    const Spectral spectrum = make_rgb_illuminant(color)->eval(nm);
    for (int i = 0; i < 200; ++i) {
        const LightSample s = light->sample({}, random.next2(), bands);
        EXPECT_NEAR(s.pdf, 1.0 / (4 * pi), 1e-6);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.radiance[c], color[c], 1e-6f);
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(light->radiance(nullptr, s.wi, nm)[c], spectrum[c], 1e-4f * spectrum[c]);
    }
}

TEST(EnvironmentMap, ABlackMapShinesNowhere) {
    const LightPtr light = environment(blank(4, 4));
    EXPECT_EQ(light->power(), 0.f);
    EXPECT_EQ(light->sample({}, {0.3f, 0.4f}, bands).pdf, 0.f);
    EXPECT_EQ(light->pdf({}, {0.f, 1.f, 0.f}, nullptr), 0.f);
}

TEST(EnvironmentMap, WrongImagesAreExplained) {
    const auto error = [](const Image& image, const Transform& to_world = {}) -> std::string {
        try {
            environment(image, to_world);
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    EXPECT_EQ(error(blank(1, 3)),
              "map: an environment map needs at least 2 x 3 pixels; this has 1 x 3");
    EXPECT_EQ(error(blank(4, 4), Transform::scale({1, 2, 1})),
              "map: to_world of an environment map must be a rotation; it shears or stretches");
    Image image = blank(4, 4);
    set(image, 2, 1, {0.f, std::numeric_limits<float>::infinity(), 0.f});
    EXPECT_EQ(error(image), "map: pixel (2, 1) is inf; an environment map must be finite");

    set(image, 2, 1, {-1.f, 1.f, -2.f});
    std::vector<std::string> warnings;
    const LightPtr light = make_environment_map(image, {}, "map", warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "map: 2 negative values were set to 0: no light is negative");
    EXPECT_GE(light->radiance(nullptr, direction_of_texel(2.5 / 4, 1.0 / 3), bands)[0], 0.f);
}

using EnvironmentMapFile = SceneFiles;

TEST_F(EnvironmentMapFile, IsReadWithItsScaleAndTransform) {
    Image image = blank(4, 3);
    set(image, 1, 1, {1.f, 2.f, 3.f});
    write_image(image, folder_ / "sky.exr");
    const SceneNodePtr root = read(
        "<emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/>"
        "<float name=\"scale\" value=\"2\"/><boolean name=\"mis_compensation\" value=\"true\"/>"
        "<transform name=\"to_world\"><rotate y=\"1\" angle=\"90\"/></transform></emitter>");
    BuildContext context;
    context.search_path = {folder_};
    const LightPtr light = make_light(*root->children.at(0).node, context);
    const float h = std::sqrt(0.5f);
    EXPECT_NEAR(light->radiance(nullptr, {h, 0.f, -h}, bands)[1], 4.f, 1e-4f);
}

}  // namespace
}  // namespace nacre
