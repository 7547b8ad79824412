// <bsdf type="measured">: a file's numbers on a surface, in bands and at wavelengths.
#include "nacre/measured/factor/textures.h"
#include "nacre/measured/formats.h"
#include "nacre/spectrum/rgb_basis.h"
#include "tests/scene/bands.h"
#include "tests/scene/material_fixture.h"
#include "tests/scene/scene_files.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

using test::bsdf;

/// A table of a matte surface with one number a column.
std::string matte(const std::string& columns, const std::string& values, bool passes = false) {
    std::string text = "theta_i,phi_i,theta_o,phi_o," + columns + "\n";
    for (int i = 0; i <= 80; i += 10)
        for (int o = 0; o <= 80; o += 10)
            for (int phi = 0; phi <= 180; phi += 30)
                text += fmt::format("{},0,{},{},{}\n", i, passes ? 180 - o : o, phi, values);
    return text;
}

class MeasuredMaterial : public SceneFiles {
  protected:
    MaterialPtr made(const std::string& text, std::vector<SceneValue> more = {}) {
        std::vector<SceneValue> values{test::text("filename", write("m.csv", text).string())};
        values.insert(values.end(), more.begin(), more.end());
        context_ = {};
        return make_material(*bsdf("measured", values), context_);
    }
    Spectral facing(const Material& m, const Wavelengths& w, float below = 1.f) {
        BsdfScratch scratch;
        return m.at({}, w, scratch)
            .eval(normalize(Vec3f{0.2f, 0.1f, below}), normalize(Vec3f{-0.3f, 0.2f, 1.f}));
    }
    const float cosine_ = normalize(Vec3f{0.2f, 0.1f, 1.f}).z;
    BuildContext context_;
};

TEST_F(MeasuredMaterial, BandsAreThoseOfTheFile) {
    const MaterialPtr m = made(matte("r,g,b", "0.3,0.2,0.1"));
    EXPECT_EQ(m->flags(), unsigned(reflects | has_smooth));
    EXPECT_FALSE(m->is_spectral());
    const Spectral f = facing(*m, bands);
    EXPECT_FLOAT_EQ(f[0], 0.3f * cosine_);
    EXPECT_FLOAT_EQ(f[2], 0.1f * cosine_);
    EXPECT_EQ(facing(*m, bands, -1.f)[0], 0.f);
    EXPECT_FLOAT_EQ(
        facing(*made(matte("r,g,b", "0.3,0.2,0.1"), {test::number("scale", 2.)}), bands)[1],
        0.4f * cosine_);
    EXPECT_TRUE(context_.warnings.empty());
}

TEST_F(MeasuredMaterial, BandsAtWavelengths) {
    Wavelengths w;
    w.mode = ColorMode::spectral;
    w.lambda = {420.f, 500.f, 580.f, 640.f};
    const Spectral f = facing(*made(matte("r,g,b", "0.3,0.2,0.1")), w);
    const Spectral expected = RgbBasis(w.lambda).eval({0.3f, 0.2f, 0.1f});
    for (int k = 0; k < 4; ++k) EXPECT_FLOAT_EQ(f[k], expected[k] * cosine_);
    const Spectral grey = facing(*made(matte("grey", "0.25")), w);
    for (int k = 0; k < 4; ++k) EXPECT_FLOAT_EQ(grey[k], 0.25f * cosine_);
}

TEST_F(MeasuredMaterial, WavelengthsOfTheFile) {
    const MaterialPtr m = made(matte("450,550,650", "0.1,0.3,0.2"));
    EXPECT_TRUE(m->is_spectral());
    Wavelengths w;
    w.mode = ColorMode::spectral;
    w.lambda = {400.f, 500.f, 575.f, 700.f};
    const Spectral f = facing(*m, w);
    EXPECT_NEAR(f[0], 0.1f * cosine_, 1e-6f);
    EXPECT_NEAR(f[1], 0.2f * cosine_, 1e-6f);
    EXPECT_NEAR(f[2], 0.275f * cosine_, 1e-6f);
    EXPECT_NEAR(f[3], 0.2f * cosine_, 1e-6f);
    // In bands: the colour under D65; what reflects all alike is grey.
    const Spectral even = facing(*made(matte("450,550,650", "0.2,0.2,0.2")), bands);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(even[c], 0.2f * cosine_, 1e-6f);
    EXPECT_GT(facing(*m, bands)[1], facing(*m, bands)[2]);
}

TEST_F(MeasuredMaterial, LightThatPassesAndGaps) {
    const MaterialPtr m = made(matte("r,g,b", "0.3,0.2,0.1", true));
    EXPECT_EQ(m->flags(), unsigned(transmits | has_smooth));
    EXPECT_EQ(facing(*m, bands)[0], 0.f);
    // A file of one plane says nothing about the others.
    std::string plane = "theta_i,phi_i,theta_o,phi_o,grey\n";
    for (int o = -80; o <= 80; o += 4)
        plane += fmt::format("40,0,{},{},0.3\n", std::abs(o), o < 0 ? 0 : 180);
    made(plane);
    ASSERT_EQ(context_.warnings.size(), 1u);
    EXPECT_NE(context_.warnings[0].find("% of the pairs of directions have no measurement and "
                                        "reflect nothing"),
              std::string::npos);
}

/// A folder of factors, by its name; what it is read from is all of its files.
TEST_F(MeasuredMaterial, FactorsOfAFolder) {
    const std::filesystem::path folder = folder_ / "factors";
    std::filesystem::create_directory(folder);
    const FactorGrid grid{FactorParameters::in_out, 2};
    const FactoredBrdf brdf(
        grid, {{FactorTexture(4, {0.5f, 0.5f, 0.5f}), FactorTexture(4, {0.4f, 0.2f, 0.1f})}}, false,
        "made", true);
    write_factors(brdf, folder);
    std::vector<std::filesystem::path> read;
    context_.files = &read;
    context_.search_path = {folder_};
    const MaterialPtr m =
        make_material(*bsdf("measured", {test::text("filename", "factors")}), context_);
    const Spectral f = facing(*m, bands);
    EXPECT_FLOAT_EQ(f[0], 0.2f * cosine_);
    EXPECT_FLOAT_EQ(f[2], 0.05f * cosine_);
    EXPECT_EQ(read, (std::vector{folder / "g01.exr", folder / "h01.exr"}));
    std::filesystem::remove(folder / "h01.exr");
    EXPECT_NE(
        test::error_of(bsdf("measured", {test::text("filename", folder.string())})).find("h01.exr"),
        std::string::npos);
}

TEST_F(MeasuredMaterial, WrongInput) {
    const std::string file = write("m.csv", matte("grey", "0.1")).string();
    const std::string html = write("page.bsdf", "<!DOCTYPE html><html></html>").string();
    const struct {
        std::vector<SceneValue> values;
        std::string message;
    } cases[] = {
        {{}, "test.xml:1:1: <bsdf type=\"measured\"> needs a string 'filename'"},
        {{test::text("filename", file), test::number("scale", 0.)},
         "test.xml:2:5: 'scale' of <bsdf type=\"measured\"> must be positive; got 0"},
        {{test::text("filename", file), test::number("scal", 1.)},
         "test.xml:2:5: <bsdf type=\"measured\"> has no parameter 'scal'; did you mean 'scale'?"},
    };
    for (const auto& [values, message] : cases)
        EXPECT_EQ(test::error_of(bsdf("measured", values)), message);
    const std::string page = test::error_of(bsdf("measured", {test::text("filename", html)}));
    EXPECT_NE(page.find("page.bsdf"), std::string::npos);
    EXPECT_NE(page.find("web page"), std::string::npos) << page;
}

}  // namespace
}  // namespace nacre
