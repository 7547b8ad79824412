// Factored BRDFs in files, and the spheres of them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "nacre/image/image.h"
#include "nacre/math/warp.h"
#include "nacre/measured/factor/factorise.h"
#include "nacre/measured/factor/spheres.h"
#include "nacre/measured/factor/textures.h"
#include "nacre/measured/open_measured.h"
#include "nacre/measured/surface.h"
#include "tests/measured/factor_targets.h"
#include "tests/reflectance/chi_square.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class FactorFiles : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  fmt::format("nacre_factors_{}_{}", getpid(),
                              testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    FactoredBrdf made(int terms, bool logarithmic = false,
                      FactorParameters parameters = FactorParameters::half_difference) const {
        FactorOptions o;
        o.grid = {parameters, 6};
        o.terms = {terms};
        o.logarithmic = logarithmic;
        return factorise(*make_target("ward kd=0.3,0.2,0.1 ks=0.4 alpha_u=0.3 alpha_v=0.6"), o)
            .brdfs[0];
    }
    fs::path folder_;
};

}  // namespace

TEST_F(FactorFiles, AreReadAsTheyWereWritten) {
    for (const bool logarithmic : {false, true})
        for (const FactorParameters parameters :
             {FactorParameters::in_out, FactorParameters::half_difference}) {
            const FactoredBrdf brdf = made(3, logarithmic, parameters);
            write_factors(brdf, folder_);
            const FactoredBrdf read = read_factors(folder_);
            EXPECT_EQ(read.grid().side, 6);
            EXPECT_EQ(read.grid().parameters, parameters);
            EXPECT_EQ(read.logarithmic(), logarithmic);
            EXPECT_EQ(read.isotropic(), brdf.isotropic());
            EXPECT_EQ(read.name(), brdf.name());
            ASSERT_EQ(read.terms().size(), 3u);
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 36; ++k)
                    for (int c = 0; c < 3; ++c) {
                        EXPECT_EQ(read.terms()[j].g[k][c], brdf.terms()[j].g[k][c]);
                        EXPECT_EQ(read.terms()[j].h[k][c], brdf.terms()[j].h[k][c]);
                    }
            const Vec3d wi = normalize(Vec3d{0.3, 0.4, 0.8}), wo = normalize(Vec3d{-0.5, 0.1, 0.6});
            EXPECT_EQ(read.value(wi, wo)->y, brdf.value(wi, wo)->y);
            // The folder is a target as a file or a model is.
            EXPECT_EQ(make_target(folder_.string())->value(wi, wo)->y, brdf.value(wi, wo)->y);
        }
}

/// A folder is what files of measured reflectance are: whatever takes those takes it.
TEST_F(FactorFiles, AreMeasuredReflectance) {
    for (const FactorParameters parameters :
         {FactorParameters::in_out, FactorParameters::half_difference}) {
        const FactoredBrdf brdf = made(2, false, parameters);
        write_factors(brdf, folder_);
        const auto data = open_measured(folder_);
        EXPECT_EQ(data->info().format, "factors");
        EXPECT_EQ(data->info().channels, 3);
        EXPECT_FALSE(data->info().isotropic);
        EXPECT_EQ(data->info().samples, 36u * 36u);
        // Of half and difference vectors some pairs lead below the horizon.
        EXPECT_EQ(data->info().missing > 0, parameters == FactorParameters::half_difference);
        Random random(stream_key(3, 1));
        for (int i = 0; i < 200; ++i) {
            const Vec3d wi(square_to_cosine_hemisphere(random.next2()));
            const Vec3d wo(square_to_cosine_hemisphere(random.next2()));
            double f[3];
            float quick[3];
            ASSERT_TRUE(data->eval(wi, wo, f));
            ASSERT_TRUE(data->eval_float(Vec3f(wi), Vec3f(wo), quick));
            for (int c = 0; c < 3; ++c) {
                EXPECT_EQ(f[c], (*brdf.value(wi, wo))[c]);
                EXPECT_NEAR(quick[c], f[c], 1e-3 * f[c] + 1e-4);
            }
            EXPECT_FALSE(data->eval(wi, -wo, f));
        }
        float quick[3];
        data->eval_float({NAN, 0.f, 1.f}, {0.f, NAN, 1.f}, quick);  // stays within the textures
    }
    const MeasuredSurface surface(open_measured(folder_));
    for (const Vec3f& wo : {Vec3f{0.f, 0.f, 1.f}, normalize(Vec3f{0.6f, 0.5f, 0.5f})}) {
        const auto result =
            test::chi_square([&](Random& r) { return surface.sample(wo, r.next(), r.next2()); },
                             [&](const Vec3f& wi) { return surface.pdf(wi, wo); }, 71);
        EXPECT_GT(result.p, 0.01 / 2.) << result.drawn << " " << result.integral;
    }
}

// phi goes to the right, theta downwards.
TEST_F(FactorFiles, Layout) {
    const FactoredBrdf brdf = made(1);
    write_factors(brdf, folder_);
    const Image g = read_image(folder_ / "g01.exr");
    EXPECT_EQ(g.width, 6);
    EXPECT_EQ(g.rgb(2, 5).y, brdf.terms()[0].g[6 * 2 + 5].y);
    EXPECT_EQ(g.metadata.at("factorParameters"), "half_difference");
    EXPECT_EQ(g.metadata.at("factorTerms"), "1");
    EXPECT_EQ(g.metadata.at("factorValues"), "linear");
}

TEST_F(FactorFiles, FewerTermsLeaveNoneOfTheMany) {
    write_factors(made(4), folder_);
    EXPECT_TRUE(fs::exists(folder_ / "h04.exr"));
    write_factors(made(2), folder_);
    EXPECT_TRUE(fs::exists(folder_ / "h02.exr"));
    for (const char* gone : {"g03.exr", "h03.exr", "g04.exr", "h04.exr"})
        EXPECT_FALSE(fs::exists(folder_ / gone)) << gone;
    EXPECT_EQ(read_factors(folder_).terms().size(), 2u);
}

TEST_F(FactorFiles, WrongFolders) {
    const auto message = [&] {
        std::string text = test::error_of([&] { read_factors(folder_); });
        const std::size_t at = text.find(folder_.string());
        return at == text.npos ? text : text.substr(at + folder_.string().size());
    };
    EXPECT_EQ(message(),
              ": is no folder of factors: it has no g01.exr; nacre factor -o writes one");
    const FactoredBrdf brdf = made(2);
    // What `change` makes of a texture that was right.
    const auto changed = [&](const char* file, auto&& change) {
        write_factors(brdf, folder_);
        Image image = read_image(folder_ / file);
        change(image);
        write_image(image, folder_ / file);
        return message();
    };
    const auto attribute = [&](const char* name, const char* value) {
        return changed("g01.exr", [&](Image& image) { image.metadata[name] = value; });
    };
    EXPECT_EQ(changed("g01.exr", [](Image& i) { i.metadata.erase("factorValues"); }),
              "/g01.exr: has no attribute 'factorValues'; it was not written by nacre factor");
    EXPECT_EQ(attribute("factorParameters", "polar"),
              "/g01.exr: attribute 'factorParameters' is 'polar'; known are: in_out, "
              "half_difference");
    EXPECT_EQ(attribute("factorValues", "square"),
              "/g01.exr: attribute 'factorValues' is 'square'; known are: linear, logarithm");
    EXPECT_EQ(attribute("factorIsotropic", "perhaps"),
              "/g01.exr: attribute 'factorIsotropic' is 'perhaps'; known are: yes, no");
    EXPECT_EQ(attribute("factorTerms", "two"),
              "/g01.exr: attribute 'factorTerms' is 'two', not a number from 1 to 4096");
    EXPECT_EQ(attribute("factorTerms", "0"),
              "/g01.exr: attribute 'factorTerms' is '0', not a number from 1 to 4096");
    EXPECT_EQ(changed("h02.exr", [](Image& i) { i.metadata["factorOf"] = "other"; }),
              "/h02.exr: is of another factorisation than g01.exr; factor again");
    EXPECT_EQ(changed("h02.exr", [](Image& i) { i.at(3, 4, 1) = NAN; }),
              "/h02.exr: pixel 3, 4 is not finite; factor again");
    EXPECT_EQ(changed("g01.exr", [](Image& i) { i = Image(6, 5); }),
              "/g01.exr: has 6 x 5 pixels; factors are square, of a side from 2 to 64");
    EXPECT_EQ(changed("g02.exr",
                      [](Image& i) {
                          const auto metadata = i.metadata;
                          i = Image(5, 5);
                          i.metadata = metadata;
                      }),
              "/g02.exr: is of another factorisation than g01.exr; factor again");
    write_factors(brdf, folder_);
    fs::remove(folder_ / "h02.exr");
    EXPECT_NE(message().find("/h02.exr"), std::string::npos) << message();
    std::ofstream(folder_ / "g01.exr") << "<html>";
    EXPECT_TRUE(message().starts_with("/g01.exr: ")) << message();
}

// A matt sphere is as bright as the cosines say: in the middle, which faces the viewer, the key
// light has 1.3/sqrt(3.69), the fill light half of 0.9/sqrt(2.78), the third light is behind.
TEST(FactorSpheres, AMattSphere) {
    const test::MadeTarget matt([](const Vec3d&, const Vec3d&) { return 0.25; }, {1., 0.5, 0.2});
    const test::MadeTarget darker([](const Vec3d&, const Vec3d&) { return 0.125; }, {1., 0.5, 0.2});
    const SphereGroup groups[] = {{&matt, {&darker, &matt}}, {&darker, {&matt}}};
    const Image image = draw_spheres(groups, {.size = 80, .samples = 2});
    EXPECT_EQ(image.width, 3 * 80 + 10);
    EXPECT_EQ(image.height, 160);
    const double middle = 1.3 / std::sqrt(3.69) + 0.5 * 0.9 / std::sqrt(2.78);
    const Vec3f original = image.rgb(80, 40), approximation = image.rgb(40, 120);
    EXPECT_NEAR(approximation.x / original.x, 0.5, 1e-3);
    EXPECT_NEAR(original.y / original.x, 0.5, 1e-6);
    EXPECT_EQ(image.rgb(120, 120).x, original.x);
    // Each group has an exposure of its own.
    EXPECT_NEAR(image.rgb(250 - 40, 40).x, original.x, 1e-5);
    EXPECT_NEAR(image.rgb(250 - 40, 120).x, 2. * original.x, 1e-5);
    // Where the key light falls along the normal it is 1, and the fill light adds little.
    const Vec3d key = normalize(Vec3d{-1., 1., 1.3});
    const double radius = 0.47 * 80.;
    const Vec3f facing = image.rgb(int(80 + key.x * radius), int(40 - key.y * radius));
    const double fill = std::max(0., dot(key, normalize(Vec3d{1.4, 0.1, 0.9})));
    const double rim = std::max(0., dot(key, normalize(Vec3d{0.3, 1., -0.6})));
    EXPECT_NEAR(facing.x / original.x, (1. + 0.5 * fill + 0.35 * rim) / middle, 0.02);
}

}  // namespace nacre
