#include <unistd.h>

#include <filesystem>

#include "nacre/image/image.h"
#include "nacre/scene/materials/types.h"
#include "nacre/spectrum/color.h"
#include "tests/scene/bands.h"
#include "tests/scene/material_fixture.h"

namespace nacre {
namespace {

using test::bsdf;
using test::child;
using test::flag;
using test::node;
using test::number;
using test::rgb;
using test::text;

/// A folder with image files, gone when the test ends.
class Textures : public testing::Test {
  protected:
    Textures() {
        folder_ = std::filesystem::temp_directory_path() /
                  ("nacre_textures_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    ~Textures() override { std::filesystem::remove_all(folder_); }

    /// Writes pixels (row by row from the top) and returns the node of a bitmap of them.
    std::shared_ptr<SceneNode> bitmap(const std::string& file, int width,
                                      const std::vector<Vec3f>& pixels,
                                      std::vector<SceneValue> values = {}) {
        Image image;
        image.width = width;
        image.height = static_cast<int>(pixels.size()) / width;
        image.channels = {"R", "G", "B"};
        for (const Vec3f& p : pixels) image.data.insert(image.data.end(), {p.x, p.y, p.z});
        write_image(image, folder_ / file);
        values.push_back(text("filename", file));
        return node("texture", "bitmap", std::move(values));
    }
    /// What is built is remembered by its node, so each test of a temporary node starts anew.
    BuildContext context() const {
        BuildContext fresh;
        fresh.search_path = {folder_};
        return fresh;
    }
    TexturePtr texture(const SceneNodePtr& n, ColorRole role = ColorRole::reflectance) const {
        BuildContext fresh = context();
        return make_texture(*n, role, fresh);
    }
    MaterialPtr material(const SceneNodePtr& n) const {
        BuildContext fresh = context();
        return make_material(*n, fresh);
    }
    std::string error_of(const SceneNodePtr& n) {
        try {
            n->tag == "bsdf" ? void(material(n)) : void(texture(n));
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }

    std::filesystem::path folder_;
};

constexpr Vec3f grey(float v) { return {v, v, v}; }

TEST_F(Textures, AreConstantWhereNothingElseIsSaid) {
    const TexturePtr number = make_constant_texture(0.3f);
    EXPECT_EQ(number->eval_scalar({0.7f, 9.f}), 0.3f);
    EXPECT_EQ(number->eval({}, bands)[1], 0.3f);
    EXPECT_EQ(number->max(), 0.3f);
    EXPECT_EQ(number->mean(), 0.3f);
    const TexturePtr red = make_constant_texture(make_rgb_reflectance({1.f, 0.f, 0.f}));
    EXPECT_NEAR(red->eval_scalar({}), 0.2126f, 1e-3f);  // luminance of the red primary, BT.709
}

TEST_F(Textures, BitmapsHaveTheirFirstRowAtTheOrigin) {
    const auto t = texture(bitmap("a.exr", 2, {grey(0.1f), grey(0.2f), grey(0.3f), grey(0.4f)},
                                  {text("filter_type", "nearest")}));
    EXPECT_FLOAT_EQ(t->eval_scalar({0.25f, 0.25f}), 0.1f);
    EXPECT_FLOAT_EQ(t->eval_scalar({0.75f, 0.25f}), 0.2f);
    EXPECT_FLOAT_EQ(t->eval_scalar({0.25f, 0.75f}), 0.3f);
    EXPECT_FLOAT_EQ(t->eval_scalar({0.75f, 0.75f}), 0.4f);
    EXPECT_FLOAT_EQ(t->mean(), 0.25f);
    EXPECT_FLOAT_EQ(t->max(), 0.4f);
}

TEST_F(Textures, BitmapsAreMixedBetweenTexelCentres) {
    const auto t = texture(bitmap("b.exr", 2, {grey(0.1f), grey(0.2f), grey(0.3f), grey(0.4f)}));
    EXPECT_FLOAT_EQ(t->eval_scalar({0.25f, 0.25f}), 0.1f);
    EXPECT_FLOAT_EQ(t->eval_scalar({0.5f, 0.25f}), 0.15f);
    EXPECT_FLOAT_EQ(t->eval_scalar({0.5f, 0.5f}), 0.25f);
    EXPECT_FLOAT_EQ(t->eval_scalar({0.375f, 0.75f}), 0.325f);
    // The left edge lies between the first texel and its neighbour round the corner.
    EXPECT_FLOAT_EQ(t->eval_scalar({0.f, 0.25f}), 0.15f);
}

TEST_F(Textures, BitmapsContinueAsAsked) {
    const std::vector<Vec3f> row = {grey(0.1f), grey(0.2f), grey(0.4f)};
    const struct {
        const char* wrap;
        float values[9];  // at u = -2.5 / 3, ..., 5.5 / 3
    } cases[] = {{"repeat", {0.1f, 0.2f, 0.4f, 0.1f, 0.2f, 0.4f, 0.1f, 0.2f, 0.4f}},
                 {"mirror", {0.4f, 0.2f, 0.1f, 0.1f, 0.2f, 0.4f, 0.4f, 0.2f, 0.1f}},
                 {"clamp", {0.1f, 0.1f, 0.1f, 0.1f, 0.2f, 0.4f, 0.4f, 0.4f, 0.4f}}};
    for (const auto& c : cases)
        for (const char* filter : {"nearest", "bilinear"}) {
            const auto t = texture(
                bitmap("c.exr", 3, row, {text("wrap_mode", c.wrap), text("filter_type", filter)}));
            for (int i = 0; i < 9; ++i)
                EXPECT_NEAR(t->eval_scalar({(float(i) - 2.5f) / 3.f, 0.5f}), c.values[i], 1e-6f)
                    << c.wrap << " " << filter << " " << i;
        }
    // Far out and not at all on the surface, still a value of the picture.
    const auto t = texture(bitmap("c.exr", 3, row));
    for (float u : {1e20f, -1e20f, std::numeric_limits<float>::infinity()})
        EXPECT_NEAR(t->eval_scalar({u, 0.f}), 0.25f, 0.16f);
}

TEST_F(Textures, EightBitColoursAreDecoded) {
    // 0.5 encoded is 0.2140 linear (IEC 61966-2-1); the PNG stores encoded values.
    const float linear = srgb_decode(0.5f);
    const auto n = bitmap("d.png", 1, {grey(linear)});
    EXPECT_NEAR(texture(n)->eval_scalar({}), 0.2140f, 2e-3f);
    auto raw = bitmap("d.png", 1, {grey(linear)}, {flag("raw", true)});
    EXPECT_NEAR(texture(raw)->eval_scalar({}), 0.5f, 2e-3f);
}

TEST_F(Textures, ToUvMovesCoordinatesFirst) {
    SceneValue to_uv{"to_uv", "transform",
                     Transform::scale({2., 2., 1.}) * Transform::translate({0.25, 0., 0.}),
                     test::at(2, 5)};
    const auto t = texture(bitmap("e.exr", 4, {grey(0.1f), grey(0.2f), grey(0.3f), grey(0.4f)},
                                  {text("filter_type", "nearest"), to_uv}));
    // u = 0.3 -> 2 (0.3 + 0.25) = 1.1 -> the first texel again.
    EXPECT_FLOAT_EQ(t->eval_scalar({0.3f, 0.f}), 0.1f);
    EXPECT_FLOAT_EQ(t->eval_scalar({0.2f, 0.f}), 0.4f);
}

TEST_F(Textures, CheckerboardsAlternate) {
    const auto n = node("texture", "checkerboard", {rgb("color0", {1.f, 0.f, 0.f})});
    const auto t = texture(n);
    const auto red = [&](float u, float v) { return t->eval({u, v}, bands)[0]; };
    EXPECT_FLOAT_EQ(red(0.2f, 0.2f), 1.f);
    EXPECT_FLOAT_EQ(red(0.7f, 0.7f), 1.f);
    EXPECT_FLOAT_EQ(red(0.7f, 0.2f), 0.2f);
    EXPECT_FLOAT_EQ(red(-0.2f, 0.2f), 0.2f);
    EXPECT_FLOAT_EQ(red(3.2f, -1.8f), 1.f);
    const auto plain = texture(node("texture", "checkerboard"));
    EXPECT_FLOAT_EQ(plain->eval_scalar({0.2f, 0.2f}), 0.4f);
    EXPECT_FLOAT_EQ(plain->mean(), 0.3f);
    EXPECT_FLOAT_EQ(plain->max(), 0.4f);
}

TEST_F(Textures, ColoursBecomeTheSpectraOfTheirTexels) {
    const Vec3f teal{0.1f, 0.5f, 0.4f};
    const auto t =
        texture(bitmap("f.exr", 2, {teal, grey(0.5f)}, {text("filter_type", "nearest")}));
    const Wavelengths w = Wavelengths::at(Spectral(450.f, 520.f, 600.f, 650.f));
    const Spectral expected = make_rgb_reflectance(teal)->eval(w);
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(t->eval({0.2f, 0.f}, w)[i], expected[i], 1e-5f);
        EXPECT_NEAR(t->eval({0.7f, 0.f}, w)[i], 0.5f, 2e-3f);
    }
    EXPECT_FALSE(t->is_spectral());
    // Lights and coefficients may exceed one.
    const Vec3f bright{4.f, 2.f, 1.f};
    const auto light = texture(bitmap("g.exr", 1, {bright}), ColorRole::illuminant);
    const Spectral emitted = make_rgb_illuminant(bright)->eval(w);
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(light->eval({}, w)[i], emitted[i], 1e-4f * emitted[i]);
        EXPECT_LE(emitted[i], light->max());
    }
}

TEST_F(Textures, GiveMaterialsTheirParameters) {
    const auto n =
        bsdf("diffuse", {},
             {child(bitmap("h.exr", 2, {grey(0.2f), grey(0.8f)}, {text("filter_type", "nearest")}),
                    "reflectance")});
    const MaterialPtr m = material(n);
    SurfacePoint left, right;
    left.uv = {0.2f, 0.f};
    right.uv = {0.8f, 0.f};
    const Vec3f up{0.f, 0.f, 1.f};
    EXPECT_NEAR(test::Bound(m, left)->eval(up, up)[0], 0.2 / M_PI, 1e-6);
    EXPECT_NEAR(test::Bound(m, right)->eval(up, up)[0], 0.8 / M_PI, 1e-6);
}

TEST_F(Textures, RefuseWhatTheyCannotBe) {
    EXPECT_EQ(error_of(node("texture", "bitmpa")),
              "test.xml:1:1: unknown texture type 'bitmpa'; did you mean 'bitmap'?");
    EXPECT_EQ(error_of(bitmap("i.exr", 1, {grey(0.5f)}, {text("wrap_mode", "repeet")})),
              "test.xml:2:5: 'wrap_mode' of <texture type=\"bitmap\"> cannot be 'repeet'; did you "
              "mean 'repeat'?");
    EXPECT_EQ(error_of(node("texture", "checkerboard", {number("colour0", 0.5)})),
              "test.xml:2:5: <texture type=\"checkerboard\"> has no parameter 'colour0'; did you "
              "mean 'color0'?");
    EXPECT_EQ(error_of(bitmap("j.exr", 2, {grey(0.5f), grey(-1.f)})),
              "test.xml:2:5: 'j.exr' has the value -1 at pixel (1, 0); a texture holds finite "
              "values that are not negative");
    EXPECT_EQ(
        error_of(bsdf("diffuse", {}, {child(bitmap("k.exr", 1, {grey(1.5f)}), "reflectance")})),
        "test.xml:3:7: 'reflectance' of <bsdf type=\"diffuse\"> must lie within [0, 1], "
        "lest energy appear from nowhere; got 1.5");
    EXPECT_EQ(
        error_of(bsdf("roughplastic", {}, {child(bitmap("l.exr", 1, {grey(0.5f)}), "alpha")})),
        "test.xml:3:7: 'alpha' of <bsdf type=\"roughplastic\"> must be a number: its "
        "boundary is tabulated for one roughness");
    EXPECT_TRUE(error_of(node("texture", "bitmap", {text("filename", "absent.png")}))
                    .starts_with("test.xml:2:5: "));
}

}  // namespace
}  // namespace nacre
