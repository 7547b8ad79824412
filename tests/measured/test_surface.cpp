// Measured reflectance as renderers use it: what is drawn follows the density, and the light that
// comes back is that of the model behind.
#include "nacre/measured/surface.h"

#include <numbers>

#include "nacre/measured/formats.h"
#include "nacre/reflectance/registry.h"
#include "tests/reflectance/chi_square.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

enum class Light { is_reflected, passes, does_both };

/// A model that is known as far as `limit` degrees, in three channels; a third of light passes where it
/// does both.
class ModelData final : public Measured {
  public:
    ModelData(AnyModel model, double limit = 90., bool isotropic = true,
              Light light = Light::is_reflected)
        : model_(std::move(model)), least_(std::cos(limit * pi / 180.)), light_(light) {
        info_.isotropic = isotropic;
        info_.largest_incidence = info_.largest_exit = limit;
        info_.reflection_front = light != Light::passes;
        info_.reflection_back = light == Light::does_both;
        info_.transmission_front = info_.transmission_back = light != Light::is_reflected;
    }
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override {
        Vec3d from = wi, to = wo;
        const bool passes = wi.z * wo.z < 0.;
        if (light_ != Light::is_reflected) {
            if (!passes && light_ == Light::passes) return false;
            from.z = std::abs(wi.z);
            to.z = std::abs(wo.z);
        }
        if (!(from.z > 0. && to.z > 0.) || std::min(from.z, to.z) < least_ - 1e-9) return false;
        const double f = model_.eval(from, to) * (passes && light_ == Light::does_both ? 0.5 : 1.);
        out[0] = f;
        out[1] = 0.5 * f;
        out[2] = -f;
        return true;
    }
    void for_each_sample(const std::function<void(const MeasuredSample&)>&) const override {}

  private:
    AnyModel model_;
    double least_;
    Light light_;
};

MeasuredSurface surface(const std::string& model, const Settings& settings, double limit = 90.,
                        bool isotropic = true, Light light = Light::is_reflected) {
    return MeasuredSurface(
        std::make_unique<ModelData>(make_model(model, settings), limit, isotropic, light));
}

std::vector<Vec3f> viewers(float side) {
    std::vector<Vec3f> all;
    for (const auto& [degrees, azimuth] :
         {std::pair{0.f, 0.f}, {9.f, 4.f}, {47.f, 0.3f}, {82.f, 2.f}}) {
        const float t = degrees * float(pi) / 180.f;
        all.push_back(
            {std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), side * std::cos(t)});
    }
    return all;
}

void check_sampling(const MeasuredSurface& s, float side, std::uint64_t seed) {
    const auto all = viewers(side);
    for (const Vec3f& wo : all) {
        const auto result = test::chi_square(
            [&](Random& random) { return s.sample(wo, random.next(), random.next2()); },
            [&](const Vec3f& wi) { return s.pdf(wi, wo); }, seed);
        EXPECT_GT(result.p, 0.01 / 20.) << "theta_o " << std::acos(wo.z) * 180. / pi << ", drawn "
                                        << result.drawn << ", integral " << result.integral;
        EXPECT_LE(result.integral, 1. + 2e-3);
    }
}

TEST(MeasuredSurface, DrawsByItsDensity) {
    check_sampling(surface("lambert", {}), 1.f, 1);
    check_sampling(surface("ggx", {{"alpha", "0.3"}}), 1.f, 2);
    check_sampling(surface("ward", {{"alpha_u", "0.4"}, {"alpha_v", "0.15"}}, 90., false), 1.f, 3);
    check_sampling(surface("ggx", {{"alpha", "0.4"}}, 90., true, Light::passes), 1.f, 4);
    check_sampling(surface("ggx", {{"alpha", "0.4"}}, 90., true, Light::passes), -1.f, 5);
    for (const float side : {1.f, -1.f})
        check_sampling(surface("ggx", {{"alpha", "0.4"}}, 90., true, Light::does_both), side, 6);
}

/// What is drawn comes with its value and density, which are those of `eval` and `pdf`.
TEST(MeasuredSurface, DrawsWithValueAndDensity) {
    const MeasuredSurface s = surface("ggx", {{"alpha", "0.3"}}, 70., true, Light::does_both);
    Random random(stream_key(11, 9));
    int drawn = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3f wo = viewers(i % 2 ? 1.f : -1.f)[std::size_t(i) % 4];
        const float u1 = random.next();
        const Vec2f u2 = random.next2();
        float with[3] = {7.f, 7.f, 7.f}, alone[3];
        const auto d = s.draw(wo, u1, u2, with);
        const auto wi = s.sample(wo, u1, u2);
        ASSERT_EQ(bool(d), bool(wi));
        if (!d) continue;
        ++drawn;
        EXPECT_EQ(d->wi, *wi);
        EXPECT_EQ(d->pdf, s.pdf(*wi, wo));
        s.eval(*wi, wo, alone);
        for (int c = 0; c < 3; ++c) EXPECT_EQ(with[c], alone[c]);
        EXPECT_EQ(s.eval_pdf(*wi, wo, with), d->pdf);
        for (int c = 0; c < 3; ++c) EXPECT_EQ(with[c], alone[c]);
    }
    EXPECT_GT(drawn, 200);
}

/// What comes back of even light, by samples and by a grid of directions.
TEST(MeasuredSurface, SamplesGiveTheAlbedo) {
    const MeasuredSurface s = surface("ggx", {{"alpha", "0.1"}});
    for (const Vec3f& wo : viewers(1.f)) {
        Random random(stream_key(11, 3));
        double sum = 0., squares = 0.;
        const int n = 40000;
        for (int i = 0; i < n; ++i) {
            const auto wi = s.sample(wo, random.next(), random.next2());
            float out[3] = {};
            double v = 0.;
            if (wi) {
                s.eval(*wi, wo, out);
                v = out[0] / s.pdf(*wi, wo);
            }
            sum += v;
            squares += v * v;
        }
        const double mean = sum / n, error = std::sqrt((squares / n - mean * mean) / n);
        double grid = 0.;
        const int rows = 400, columns = 400;
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c) {
                const float z = (r + 0.5f) / rows, t = std::sqrt(1.f - z * z);
                const float phi = float(2. * pi) * (c + 0.5f) / columns;
                float out[3];
                s.eval({t * std::cos(phi), t * std::sin(phi), z}, wo, out);
                grid += out[0];
            }
        grid *= 2. * pi / (double(rows) * columns);
        EXPECT_NEAR(mean, grid, 4. * error + 2e-4) << wo.z;
        // A table of half vectors that fits: a sample's standard deviation is below its mean.
        EXPECT_LT(error * std::sqrt(n), 0.9 * mean) << wo.z;
    }
}

TEST(MeasuredSurface, HoldsTheLastMeasuredAngle) {
    const MeasuredSurface s = surface("ggx", {{"alpha", "0.3"}}, 60.);
    const auto at = [](double degrees, double azimuth) {
        const double t = degrees * pi / 180.;
        return Vec3f(
            Vec3d{std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t)});
    };
    float held[3], last[3];
    s.eval(at(80., 0.), at(75., 2.5), held);
    s.eval(at(60., 0.), at(60., 2.5), last);
    EXPECT_GT(held[0], 0.f);
    EXPECT_NEAR(held[0] / std::cos(80. * pi / 180.), last[0] / std::cos(60. * pi / 180.),
                1e-4f * last[0]);
    EXPECT_EQ(s.black(), 0.);
    // Negative values are 0, the other side is dark.
    EXPECT_EQ(held[2], 0.f);
    s.eval(at(100., 0.), at(30., 1.), held);
    EXPECT_EQ(held[0], 0.f);
    EXPECT_EQ(s.pdf(at(100., 0.), at(30., 1.)), 0.f);
    EXPECT_FALSE(s.sample(at(120., 1.), 0.5f, {0.5f, 0.5f}));
}

TEST(MeasuredSurface, LightThatPasses) {
    const MeasuredSurface s = surface("ggx", {{"alpha", "0.4"}}, 90., true, Light::passes);
    EXPECT_TRUE(s.transmits());
    EXPECT_FALSE(s.reflects());
    const Vec3f wo = normalize(Vec3f{0.3f, 0.1f, 0.8f}), wi = normalize(Vec3f{-0.2f, 0.3f, 0.9f});
    float out[3], back[3];
    s.eval(wi, wo, out);
    EXPECT_EQ(out[0], 0.f);
    s.eval({wi.x, wi.y, -wi.z}, wo, out);
    EXPECT_GT(out[0], 0.f);
    s.eval(wi, {wo.x, wo.y, -wo.z}, back);
    EXPECT_FLOAT_EQ(out[0], back[0]);
}

}  // namespace
}  // namespace nacre
