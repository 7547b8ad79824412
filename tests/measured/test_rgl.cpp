#include "nacre/measured/rgl.h"

#include <numbers>

#include "nacre/math/random.h"
#include "tests/measured/made_files.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

using test::MadeRgl;

constexpr double circle = 2. * std::numbers::pi;

std::unique_ptr<RglMeasured> made(const MadeRgl& file) {
    const std::string bytes = file.file().bytes();
    return parse_rgl({bytes, "made.bsdf"});
}

Vec3d random_direction(Random& random, double least_z = 0.05) {
    const double z = least_z + (1. - least_z) * random.next(), phi = circle * random.next();
    const double s = std::sqrt(1. - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}

/// The unit square's coordinates of the half vector of a pair, by the paper.
struct Square {
    double x, y, theta_i, phi_i;
    Square(const Vec3d& wi, const Vec3d& wo, bool isotropic) {
        const Vec3d h = normalize(wi + wo);
        theta_i = std::acos(wi.z);
        phi_i = std::atan2(wi.y, wi.x);
        double phi = std::atan2(h.y, h.x) - (isotropic ? phi_i : 0.);
        x = std::sqrt(std::acos(h.z) * 4. / circle);
        y = phi / circle + 0.5;
        y -= std::floor(y);
    }
};

/// A ring of half vectors about the normal, so that most samples stay above the horizon; away from
/// the pole, where densities on the square and by solid angle have nothing in common.
double made_lobe(double, double theta, double x, double y) {
    return x < 0.2 ? 0. : std::exp(-6. * x * x) * (1.2 + std::cos(circle * y) * 0.5 + 0.3 * theta);
}

}  // namespace

/// Without a warp, what is bilinear on the square and linear in theta_i comes back exactly.
TEST(Rgl, WithoutAWarpValuesAreBilinearOnTheSquare) {
    MadeRgl file;
    const auto f = [](int c, double theta, double x, double y) {
        return (1. + c) * (0.5 + 0.3 * x + 0.2 * y - 0.1 * x * y) * (1. + 0.4 * theta);
    };
    file.value = [&](int c, double, double theta, double x, double y) { return f(c, theta, x, y); };
    const auto m = made(file);
    EXPECT_TRUE(m->info().isotropic);
    EXPECT_TRUE(m->info().cosine);
    Random random(stream_key(27, 4));
    for (int i = 0; i < 2000; ++i) {
        const Vec3d wi = random_direction(random, 0.2), wo = random_direction(random);
        const Square s(wi, wo, true);
        const auto v = test::value_at(*m, wi, wo);
        ASSERT_EQ(v.size(), 3u);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(v[c] * wo.z, f(c, s.theta_i, s.x, s.y), 2e-5) << i;
    }
    EXPECT_TRUE(test::value_at(*m, {0., 0., 1.}, {0.6, 0., -0.8}).empty());
    EXPECT_TRUE(test::value_at(*m, {0., 0.6, -0.8}, {0., 0., 1.}).empty());
}

TEST(Rgl, TheFactorIsNdfOverFourSigma) {
    MadeRgl file;
    file.jacobian = true;
    file.ndf = [](double x, double) { return 2. + 3. * x; };
    file.sigma = [](double x, double) { return 0.5 + 0.25 * x; };
    const auto m = made(file);
    Random random(stream_key(27, 5));
    for (int i = 0; i < 1000; ++i) {
        const Vec3d wi = random_direction(random, 0.2), wo = random_direction(random);
        const Square s(wi, wo, true);
        const double sigma = 0.5 + 0.25 * std::sqrt(s.theta_i * 4. / circle);
        ASSERT_NEAR(test::value_at(*m, wi, wo)[1] * wo.z, (2. + 3. * s.x) / (4. * sigma), 1e-5);
    }
}

/// Visible normals stretch the square: values at a node come back at the direction that the warp
/// takes the node to.
TEST(Rgl, NodesComeBackAtTheirDirections) {
    MadeRgl file;
    file.warp_width = 9;
    file.vndf = made_lobe;
    file.value = [](int c, double, double theta, double x, double y) {
        return 0.2 * c + 0.5 * x * x + 0.1 * std::sin(7. * y) + 0.3 * theta;
    };
    const auto m = made(file);
    std::size_t seen = 0, missing = 0;
    m->for_each_sample([&](const MeasuredSample& s) {
        const std::size_t i = seen++;
        if (s.state == SampleState::missing) {
            EXPECT_LE(s.wo.z, 0.);
            ++missing;
            return;
        }
        if (s.wo.z < 0.02) return;
        const double x = double(i % 5) / 4., y = double(i / 5 % 4) / 3., theta = file.theta[i / 20];
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(s.value[c] * s.wo.z, file.value(c, 0., theta, x, y), 1e-6) << i;
        // By eval as well, but for y = 0 and 1, which are one direction.
        if (y == 0. || y == 1.) return;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(test::value_at(*m, s.wi, s.wo)[c], s.value[c], 1e-3 / s.wo.z) << i;
    });
    EXPECT_EQ(seen, 60u);
    EXPECT_EQ(m->info().samples, 60u);
    EXPECT_EQ(m->info().missing, missing);
    EXPECT_GT(missing, 0u);
}

TEST(Rgl, SpectraHaveWavelengthsAndNegativeOnesAreCounted) {
    MadeRgl file;
    file.channels = 5;
    file.wavelengths = {400.f, 450.f, 500.f, 600.f, 700.f};
    file.value = [](int c, double, double theta, double x, double) {
        return c == 2 && theta == 0. && x == 0. ? -0.1 : 1. + c;
    };
    const auto m = made(file);
    EXPECT_EQ(m->info().channels, 5);
    EXPECT_EQ(m->info().wavelengths, (std::vector<double>{400., 450., 500., 600., 700.}));
    EXPECT_EQ(m->info().negative, 4u);  // one column of four rows
    const Vec3d w = test::towards(40., 10.), v = test::towards(30., 100.);
    for (int c = 0; c < 5; ++c) EXPECT_NEAR(test::value_at(*m, w, v)[c] * v.z, 1. + c, 1e-5);
}

/// A measured half or quarter of the circle stands for all of it.
TEST(Rgl, AnisotropicFilesCoverTheCircleBySymmetry) {
    struct Case {
        std::vector<float> phi;
        int reduction;
    };
    const float pi = std::numbers::pi_v<float>;
    for (const Case& c : {Case{{-pi, -0.5f * pi, 0.f, 0.5f * pi, pi}, 1},
                          {{-pi, -0.6f * pi, 0.f}, 2},
                          {{0.f, 0.3f * pi, pi}, 2},
                          {{-pi, -0.75f * pi, -0.5f * pi}, 4},
                          {{0.f, 0.25f * pi, 0.5f * pi}, 4}}) {
        MadeRgl file;
        file.phi = c.phi;
        file.warp_width = 5;
        file.value = [](int k, double phi, double, double x, double) { return 10. + phi + k * x; };
        const auto m = made(file);
        EXPECT_FALSE(m->info().isotropic);
        Random random(stream_key(27, 6));
        for (int i = 0; i < 500; ++i) {
            const Vec3d wi = random_direction(random, 0.2), wo = random_direction(random);
            const auto v = test::value_at(*m, wi, wo);
            double phi = std::atan2(wi.y, wi.x);
            if (c.reduction == 2 && (phi < c.phi.front() || phi > c.phi.back()))
                phi += phi < 0. ? pi : -pi;
            if (c.reduction == 4)
                phi = c.phi.front() < 0.f ? -pi + std::abs(std::atan(wi.y / wi.x))
                                          : std::abs(std::atan(wi.y / wi.x));
            ASSERT_NEAR(v[0] * wo.z, 10. + phi, 1e-4) << c.reduction << " " << i;
            if (c.reduction >= 2) {
                const Vec3d a{-wi.x, -wi.y, wi.z}, b{-wo.x, -wo.y, wo.z};
                ASSERT_NEAR(test::value_at(*m, a, b)[2], v[2], 1e-4);
            }
            if (c.reduction == 4) {
                const Vec3d a{-wi.x, wi.y, wi.z}, b{-wo.x, wo.y, wo.z};
                ASSERT_NEAR(test::value_at(*m, a, b)[2], v[2], 1e-4);
            }
        }
    }
}

TEST(Rgl, SamplesFollowThePdf) {
    const float pi = std::numbers::pi_v<float>;
    for (const bool isotropic : {true, false}) {
        MadeRgl file;
        if (!isotropic) file.phi = {-pi, -0.5f * pi, 0.f};
        file.warp_width = 9;
        file.vndf = made_lobe;
        file.luminance = [](double, double, double x, double y) { return 0.3 + x + 0.5 * y; };
        const auto m = made(file);
        const RglBrdf& brdf = m->brdf();
        for (const Vec3d& given : {test::towards(25., 20.), test::towards(60., 200.)}) {
            constexpr int rows = 10, columns = 16, fine = 24, count = 100000;
            std::vector<double> observed(rows * columns), expected(rows * columns);
            Random random(stream_key(27, 7));
            int drawn = 0;
            float there[3], again[3];
            for (int i = 0; i < count; ++i) {
                const float u = random.next(), v = random.next();
                const auto s = brdf.sample(Vec3f(given), u, v, there);
                if (!s) continue;
                ++drawn;
                // What comes with it is what `eval` and `pdf` say, together or each by itself.
                const auto both = brdf.eval_pdf(Vec3f(given), s->direction, again);
                ASSERT_TRUE(both);
                ASSERT_EQ(*both, brdf.pdf(Vec3f(given), s->direction));
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(there[c], again[c], 2e-3 * std::abs(again[c]) + 1e-6);
                ASSERT_TRUE(brdf.eval(Vec3f(given), s->direction, there));
                for (int c = 0; c < 3; ++c) ASSERT_EQ(there[c], again[c]);
                ASSERT_NEAR(length(s->direction), 1.f, 1e-5);
                ASSERT_NEAR(brdf.pdf(Vec3f(given), s->direction), s->pdf, 2e-3 * s->pdf);
                const double turn =
                    std::atan2(s->direction.y, s->direction.x) / circle + (s->direction.y < 0.f);
                observed[std::min(int(s->direction.z * rows), rows - 1) * columns +
                         std::min(int(turn * columns), columns - 1)] += 1.;
            }
            double integral = 0.;
            for (int y = 0; y < rows * fine; ++y)
                for (int x = 0; x < columns * fine; ++x) {
                    const float z = (y + 0.5f) / (rows * fine), s = std::sqrt(1.f - z * z);
                    const float phi = float(circle) * (x + 0.5f) / (columns * fine);
                    const double part =
                        brdf.pdf(Vec3f(given), {s * std::cos(phi), s * std::sin(phi), z}) * circle /
                        (rows * fine * columns * fine);
                    integral += part;
                    expected[y / fine * columns + x / fine] += part * count;
                }
            // What is not drawn would lie below the horizon.
            EXPECT_NEAR(integral, double(drawn) / count, 4. * std::sqrt(0.25 / count) + 1e-3);
            EXPECT_GT(integral, 0.5);
            EXPECT_TRUE(test::chi_square_passes(observed, expected)) << isotropic;
        }
    }
}

/// Directions that are no numbers give no sense, but lead nowhere out of the tables either.
TEST(Rgl, DirectionsThatAreNoNumbersDoNoHarm) {
    MadeRgl file;
    file.theta = {0.5f};
    const auto m = made(file);
    const float none = std::nanf("");
    for (const Vec3f& w : {Vec3f(none, 0.f, 1.f), Vec3f(0.f, none, 1.f), Vec3f(0.f, 0.f, none)}) {
        float out[3];
        m->brdf().eval(w, {0.f, 0.f, 1.f}, out);
        m->brdf().eval({0.f, 0.f, 1.f}, w, out);
        m->brdf().pdf(w, {0.6f, 0.f, 0.8f});
        m->brdf().sample(w, 0.5f, 0.5f);
    }
    const ParameterGrid grid({0.f}, {0.f, 1.f});
    for (const SliceMix& mix : {grid.at(none, none), grid.at(0.f, none)})
        for (int k = 0; k < mix.count; ++k) EXPECT_LT(mix.slice[k], 2u);
}

/// All that is reflected, drawn by `sample`, is the integral over the hemisphere.
TEST(Rgl, SamplingEstimatesTheAlbedo) {
    MadeRgl file;
    file.warp_width = 9;
    file.vndf = made_lobe;
    file.luminance = [](double, double, double x, double) { return 1. + x; };
    file.value = [](int, double, double, double x, double) { return 0.1 * (1. + x); };
    const auto m = made(file);
    const Vec3f given(test::towards(35., 60.));
    double sum = 0., squares = 0., integral = 0.;
    constexpr int count = 50000, rows = 300, columns = 300;
    Random random(stream_key(27, 8));
    for (int i = 0; i < count; ++i) {
        const float u = random.next(), v = random.next();
        const auto s = m->brdf().sample(given, u, v);
        float out[3] = {};
        if (s) m->brdf().eval(given, s->direction, out);
        const double f = s ? out[0] / s->pdf : 0.;
        sum += f;
        squares += f * f;
    }
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const float z = (y + 0.5f) / rows, s = std::sqrt(1.f - z * z);
            const float phi = float(circle) * (x + 0.5f) / columns;
            float out[3];
            m->brdf().eval(given, {s * std::cos(phi), s * std::sin(phi), z}, out);
            integral += out[0] * circle / (rows * columns);
        }
    const double mean = sum / count;
    const double error = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_NEAR(mean, integral, 4. * error + 1e-4 * integral);
}

}  // namespace nacre
