#include <cmath>

#include "nacre/math/random.h"
#include "nacre/measured/facet_distribution.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/rgl.h"
#include "nacre/measured/tensor_writer.h"
#include "nacre/measured/views.h"
#include "tests/measured/made_files.h"
#include "tests/measured/made_source.h"
#include "tests/support/constants.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

using test::MadeSource;

std::unique_ptr<RglMeasured> written_and_read(const Measured& source, WriteOptions options = {}) {
    const std::string bytes = write_rgl(source, options).bytes;
    return parse_rgl({bytes, "written.bsdf"});
}

std::shared_ptr<const Measured> model(const std::string& text) {
    return view_of(make_target(text));
}

Vec3d direction_above(Random& random, double least_z) {
    const double z = least_z + (1. - least_z) * random.next();
    return polar_direction(std::acos(z), 2. * pi * random.next());
}

}  // namespace

TEST(TensorWriter, ReadsBackWhatWasWritten) {
    TensorWriter file;
    const std::vector<float> values{1.f, 2.f, 3.f, 4.f, 5.f, 6.f};
    file.add("odd", "abc");
    file.add("numbers", {1, 2, 3}, values);
    const std::string bytes = file.bytes();
    const TensorFile read = parse_tensor_file({bytes, "x.bsdf"});
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read.at("odd").bytes, "abc");
    EXPECT_EQ(read.at("numbers").shape, (std::vector<std::uint64_t>{1, 2, 3}));
    EXPECT_EQ(read.at("numbers").floats(), values);
    EXPECT_EQ((read.at("numbers").bytes.data() - bytes.data()) % 8, 0);
    EXPECT_THROW(file.add("wrong", {2, 2}, values), std::logic_error);
}

/// Of facets that face everywhere alike, D = 1/pi, sigma is half of what a hemisphere shows of itself:
/// (1 + cos)/2; even light is the same distribution, so that it comes back unchanged.
TEST(FacetDistribution, FindsTheFacetsBehindARetroReflection) {
    for (const bool isotropic : {true, false}) {
        const FacetDistribution facets(
            [](const Vec3d& w) { return 0.3 / pi / (2. * (1. + w.z) * w.z); }, isotropic, 64, 32);
        for (int y = 0; y < 32; y += 5)
            for (int x = 0; x < 64; x += 3) {
                const double theta = 0.5 * pi * x * x / (63. * 63.);
                EXPECT_NEAR(facets.ndf()[std::size_t(y) * 64 + x], 1. / pi, 3e-3);
                EXPECT_NEAR(facets.sigma()[std::size_t(y) * 64 + x], 0.5 * (1. + std::cos(theta)),
                            4e-3);
            }
    }
}

TEST(FacetDistribution, BlackIsEven) {
    const FacetDistribution facets([](const Vec3d&) { return -1.; }, true, 8, 4);
    for (const float d : facets.ndf()) EXPECT_NEAR(d, 1. / pi, 1e-6);
}

TEST(RglWriter, NodesHaveTheValuesOfTheSource) {
    for (const char* text : {"lambert reflectance=0.5", "ggx alpha=0.3", "cook_torrance",
                             "ward alpha_u=0.2 alpha_v=0.5"}) {
        const auto source = model(text);
        WriteOptions options;
        options.resolution = 16;
        options.incidences = options.azimuths = 8;
        const auto file = written_and_read(*source, options);
        EXPECT_EQ(file->info().isotropic, source->info().isotropic) << text;
        std::size_t compared = 0;
        file->for_each_sample([&](const MeasuredSample& s) {
            EXPECT_NE(s.state, SampleState::negative);
            if (s.state == SampleState::missing || s.wo.z < 0.05) return;
            const auto value = test::value_at(*source, s.wi, s.wo);
            ASSERT_EQ(value.size(), 3u);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(s.value[c], value[c], 1e-4 * value[c] + 1e-7) << text;
            ++compared;
        });
        EXPECT_GT(compared, 0.4 * double(file->info().samples)) << text;
    }
}

/// Between the nodes the error falls with the resolution.
TEST(RglWriter, BetweenTheNodesFinerIsBetter) {
    const auto source = model("ggx alpha=0.2");
    double before = 0.;
    for (const int resolution : {8, 16, 32}) {
        WriteOptions options;
        options.resolution = resolution;
        const auto file = written_and_read(*source, options);
        Random random(stream_key(31, 2));
        double difference = 0., sum = 0.;
        for (int i = 0; i < 2000; ++i) {
            const Vec3d wi = direction_above(random, 0.2), wo = direction_above(random, 0.2);
            const double f = test::value_at(*source, wi, wo)[0];
            difference += std::abs(test::value_at(*file, wi, wo)[0] - f);
            sum += f;
        }
        const double error = difference / sum;
        EXPECT_TRUE(before == 0. || error < 0.8 * before) << error << " " << before;
        before = error;
    }
    EXPECT_LT(before, 0.01);
}

/// All that is drawn adds up to the albedo, for which a matte surface has a closed form; the mean of
/// the stored values over the square is the same by the paper.
TEST(RglWriter, AlbedoIsThatOfTheSource) {
    const auto file = written_and_read(*model("lambert reflectance=0.6,0.3,0.1"));
    const double albedo[] = {0.6, 0.3, 0.1};
    for (const double theta : {5., 40., 65.}) {
        const Vec3f given(test::towards(theta, 30.));
        double sum[3] = {};
        constexpr int n = 200;
        for (int i = 0; i < n * n; ++i) {
            const auto s =
                file->brdf().sample(given, (float(i % n) + 0.5f) / n, (float(i / n) + 0.5f) / n);
            float out[3];
            if (!s || !file->brdf().eval(given, s->direction, out)) continue;
            for (int c = 0; c < 3; ++c) sum[c] += out[c] / s->pdf / (n * n);
        }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], albedo[c], 0.01 * albedo[c]) << theta;
    }
}

TEST(RglWriter, SamplesFollowThePdf) {
    for (const char* text : {"ggx alpha=0.4", "ward alpha_u=0.2 alpha_v=0.5"}) {
        WriteOptions options;
        options.incidences = options.azimuths = 8;
        const auto file = written_and_read(*model(text), options);
        const Vec3f given(test::towards(50., 200.));
        constexpr int rows = 8, columns = 12, fine = 20, count = 40000;
        std::vector<double> observed(rows * columns), expected(rows * columns);
        Random random(stream_key(31, 3));
        for (int i = 0; i < count; ++i) {
            const float u = random.next(), v = random.next();
            const auto s = file->brdf().sample(given, u, v);
            if (!s) continue;
            const double turn =
                std::atan2(s->direction.y, s->direction.x) / (2. * pi) + (s->direction.y < 0.f);
            observed[std::min(int(s->direction.z * rows), rows - 1) * columns +
                     std::min(int(turn * columns), columns - 1)] += 1.;
        }
        for (int y = 0; y < rows * fine; ++y)
            for (int x = 0; x < columns * fine; ++x) {
                const double z = (y + 0.5) / (rows * fine),
                             phi = 2. * pi * (x + 0.5) / (columns * fine);
                expected[y / fine * columns + x / fine] +=
                    file->brdf().pdf(given, Vec3f(polar_direction(std::acos(z), phi))) * 2. * pi *
                    count / (rows * fine * columns * fine);
            }
        EXPECT_TRUE(test::chi_square_passes(observed, expected)) << text;
    }
}

TEST(RglWriter, KeepsWavelengths) {
    const std::vector<double> nm{400., 450., 520., 610., 700.};
    const MadeSource source([](int c, const Vec3d&, const Vec3d& wo) { return (1. + c) * wo.z; },
                            true, nm);
    const auto file = written_and_read(source);
    EXPECT_EQ(file->info().wavelengths, nm);
    EXPECT_EQ(file->info().description, "made by a test");
    const Vec3d wi = test::towards(30., 10.), wo = test::towards(50., 120.);
    for (int c = 0; c < 5; ++c)
        EXPECT_NEAR(test::value_at(*file, wi, wo)[c], (1. + c) * wo.z, 0.01 * (1. + c));
}

/// What looks the same turned or mirrored is stored for a half or a quarter of the circle, and comes
/// back for all of it.
TEST(RglWriter, AnisotropicSurfacesByTheirSymmetry) {
    struct Case {
        int parts;
        MadeSource::Value value;
    };
    for (const Case& c :
         {Case{4, [](int, const Vec3d&i, const Vec3d&o) { return 1. + (i.x + o.x) * (i.x + o.x); }},
          Case{2, [](int, const Vec3d&i, const Vec3d&o) { return 2. + (i.x + o.x) * (i.y + o.y); }},
          Case{1, [](int, const Vec3d&i, const Vec3d&o) {
                   return 2. + 0.5 * (i.x + o.x) + 0.2 * (i.y + o.y);
               }}}) {
        const MadeSource source(c.value, false);
        WriteOptions options;
        options.incidences = 12;
        const auto file = written_and_read(source, options);
        EXPECT_FALSE(file->info().isotropic);
        const std::vector<float>& phi = file->brdf().tables().incidence.slow();
        EXPECT_NEAR(phi.front(), -pi, 1e-6);
        EXPECT_NEAR(phi.back() - phi.front(), 2. * pi / c.parts, 1e-5);
        Random random(stream_key(31, 4));
        double mean = 0.;
        for (int i = 0; i < 1000; ++i) {
            const Vec3d wi = direction_above(random, 0.3), wo = direction_above(random, 0.3);
            const double f = c.value(0, wi, wo), error = test::value_at(*file, wi, wo)[0] / f - 1.;
            ASSERT_NEAR(error, 0., 0.35) << c.parts;
            mean += std::abs(error) / 1000.;
        }
        EXPECT_LT(mean, 0.025) << c.parts;
    }
}

/// Retro-reflection says nothing of these surfaces: their light goes elsewhere, but for a narrow lobe
/// of the second. The warp and the sampling cover it nevertheless.
TEST(RglWriter, WhatTheRetroReflectionMissesIsThere) {
    for (const double lobe : {0., 1.}) {
        const MadeSource source([&](int, const Vec3d& i, const Vec3d& o) {
            const double forward = std::max(-(i.x * o.x + i.y * o.y), 0.);
            return forward + lobe * std::pow(normalize(i + o).z, 400.);
        });
        const auto file = written_and_read(source);
        Random random(stream_key(31, 5));
        double difference = 0., sum = 0.;
        for (int i = 0; i < 2000; ++i) {
            const Vec3d wi = direction_above(random, 0.2), wo = direction_above(random, 0.2);
            const double f = test::value_at(source, wi, wo)[1];
            difference += std::abs(test::value_at(*file, wi, wo)[1] - f);
            sum += f;
            ASSERT_TRUE(f == 0. || file->brdf().pdf(Vec3f(wi), Vec3f(wo)) > 0.f);
        }
        EXPECT_LT(difference, (lobe > 0. ? 0.6 : 0.05) * sum) << difference / sum;
    }
}

TEST(RglWriter, SaysWhatIsNotKnownAndWhatIsNegative) {
    MadeSource gap([](int, const Vec3d&, const Vec3d&) { return 1.; });
    gap.known = [](const Vec3d&, const Vec3d& wo) { return wo.z < 0.7; };
    const auto lost = write_rgl(gap, {}).lost;
    ASSERT_EQ(lost.size(), 1u);
    EXPECT_NE(lost[0].find("are not known"), std::string::npos) << lost[0];
    const MadeSource noise(
        [](int c, const Vec3d&, const Vec3d& wo) { return c == 1 ? -wo.z : 1.; });
    const WrittenMeasured written = write_rgl(noise, {});
    ASSERT_EQ(written.lost.size(), 1u);
    EXPECT_NE(written.lost[0].find("negative values"), std::string::npos) << written.lost[0];
    EXPECT_EQ(parse_rgl({written.bytes, "x"})->info().negative, 0u);
    EXPECT_TRUE(write_rgl(*model("lambert"), {}).lost.empty());
}

/// Beyond the largest measured angles their values hold.
TEST(RglWriter, HoldsTheValuesAtTheLargestAngles) {
    MadeSource source([](int, const Vec3d&, const Vec3d&) { return 0.2; });
    source.known = [](const Vec3d& wi, const Vec3d& wo) { return wi.z > 0.49 && wo.z > 0.49; };
    source.info_to_change().largest_incidence = source.info_to_change().largest_exit = 60.;
    const WrittenMeasured written = write_rgl(source, {});
    EXPECT_TRUE(written.lost.empty());
    const auto file = parse_rgl({written.bytes, "x"});
    const auto v = test::value_at(*file, test::towards(75., 0.), test::towards(20., 40.));
    EXPECT_NEAR(v.at(0), 0.2, 0.01);
}

}  // namespace nacre
