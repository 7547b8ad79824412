// Sums of lobes, channels by themselves, held-out data, the cube root.
#include <gtest/gtest.h>

#include <numbers>

#include "nacre/measured/fit.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

ModelTerm term(const std::string& text, const Vec3d& weight = {1., 1., 1.}) {
    const ModelSpec spec = parse_model_spec(text);
    return {make_model(spec.name, spec.settings), spec.settings, weight};
}

SumFit fit_of(const std::string& model, const Target& target, const FitOptions& options = {}) {
    const ModelSpec spec = parse_model_spec(model);
    return fit_sum(find_evaluator(spec.name), spec.settings, sample_target(target), options);
}

void expect_same(const AnyModel& found, const AnyModel& wanted, int band, double tolerance) {
    const auto got = band_values(found)[std::size_t(band)],
               want = band_values(wanted)[std::size_t(band)];
    const auto& parameters = wanted.description().parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        EXPECT_NEAR(got.scalar[i], want.scalar[i], tolerance * std::max(0.05, want.scalar[i]))
            << parameters[i].name << " in band " << band;
}

/// Another target with noise that is a function of the directions alone, and holes.
class Noisy final : public Target {
  public:
    Noisy(const std::string& text, double noise) : inner_(make_target(text)), noise_(noise) {}
    std::string name() const override { return "noise"; }
    bool isotropic() const override { return true; }
    std::optional<Vec3d> value(const Vec3d& wi, const Vec3d& wo) const override {
        const double x = 1e4 * (wi.x + 3. * wi.y + 7. * wo.x + 11. * wo.y);
        const double u = x - std::floor(x);
        if (u < 0.2) return std::nullopt;
        const auto f = inner_->value(wi, wo);
        return f ? std::optional((1. + noise_ * (u - 0.6)) * *f) : f;
    }

  private:
    std::unique_ptr<Target> inner_;
    double noise_;
};

}  // namespace

// The wide lobe comes first, whichever the target lists first, and the matte part is there once.
TEST(FitSum, TwoLobesComeBack) {
    const std::vector<std::string> cases[] = {
        {"ward kd=0.2,0.3,0.1 ks=0.15,0.1,0.2 alpha=0.3", "ward kd=0 ks=0.1,0.05,0.02 alpha=0.05"},
        {"blinn_phong kd=0.1 ks=0.3 n=12", "blinn_phong kd=0 ks=0.04,0.06,0.05 n=400"},
        {"ggx kd=0.2 ks=0.5 alpha=0.4 fresnel=schlick f0=0.3",
         "ggx kd=0 ks=0.2 alpha=0.06 fresnel=schlick f0=0.3"},
    };
    const std::string given[] = {"ward", "blinn_phong", "ggx fresnel=schlick f0=0.3"};
    for (std::size_t k = 0; k < std::size(cases); ++k) {
        const ModelSum target({term(cases[k][1]), term(cases[k][0])}, "two lobes");
        const SumFit one = fit_of(given[k], target);
        const SumFit two = fit_of(given[k], target, {.lobes = 2});
        EXPECT_GT(one.errors.log_relative, 1e-2) << given[k];
        EXPECT_LT(two.errors.log_relative, 1e-5) << given[k];
        ASSERT_EQ(two.sum.terms().size(), 2u);
        EXPECT_TRUE(two.converged);
        for (std::size_t l = 0; l < 2; ++l)
            for (int c = 0; c < 3; ++c)
                expect_same(two.sum.terms()[l].model, term(cases[k][l]).model, c, 1e-3);
    }
}

TEST(FitSum, ALobeMoreIsNoWorse) {
    const auto target = make_target("ggx kd=0.2,0.1,0.05 ks=0.5 alpha=0.2");
    double before = infinite;
    for (int lobes : {1, 2, 3}) {
        const SumFit f = fit_of("ward", *target, {.lobes = lobes});
        EXPECT_LT(f.errors.log, before);
        EXPECT_EQ(f.numbers, 3 + 4 * lobes);
        before = f.errors.log;
    }
}

TEST(FitSum, ChannelsByThemselves) {
    const ModelSum target({term("ward kd=0.3 ks=0.2 alpha=0.1", {1., 0., 0.}),
                           term("ward kd=0.2 ks=0.3 alpha=0.2", {0., 1., 0.}),
                           term("ward kd=0.1 ks=0.1 alpha=0.4", {0., 0., 1.})},
                          "three");
    EXPECT_GT(fit_of("ward", target).errors.log_relative, 1e-2);
    const SumFit f = fit_of("ward", target, {.by_channel = true});
    EXPECT_LT(f.errors.log_relative, 1e-5);
    EXPECT_EQ(f.numbers, 9);
    ASSERT_EQ(f.sum.terms().size(), 3u);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(f.sum.terms()[c].weight, target.terms()[c].weight);
        expect_same(f.sum.terms()[c].model, target.terms()[c].model, c, 1e-3);
    }
    // A colour that is given is given to each in its own band.
    const SumFit with = fit_of("ward kd=0.3,0.2,0.1", target, {.by_channel = true});
    EXPECT_LT(with.errors.log_relative, 1e-5);
    EXPECT_EQ(with.numbers, 6);
    // A band without light is no obstacle.
    const ModelSum red({term("ward kd=0.3 ks=0.2 alpha=0.1", {1., 0., 0.})}, "red");
    EXPECT_LT(fit_of("ward", red, {.by_channel = true}).errors.log_relative, 1e-5);
}

TEST(FitSum, ExactModelsAreExactOnWhatIsHeldOut) {
    const auto target = make_target("ward kd=0.3,0.2,0.1 ks=0.2 alpha_u=0.1 alpha_v=0.3");
    const TargetSamples even = sample_target(*target, {.nodes = FitGrid::Nodes::even}),
                        odd = sample_target(*target, {.nodes = FitGrid::Nodes::odd});
    const TargetSamples all = sample_target(*target);
    EXPECT_EQ(even.size() + odd.size(), all.size());
    EXPECT_NEAR(double(even.size()), 0.5 * double(all.size()), 0.01 * double(all.size()));
    for (std::size_t i = 0; i < odd.size(); ++i)
        for (std::size_t k = 0; k < even.size(); ++k) ASSERT_FALSE(odd.wi[i] == even.wi[k]);
    const SumFit f = fit_sum(find_evaluator("ward"), {}, even);
    EXPECT_LT(errors_of(f.sum, odd).log_relative, 1e-5);
    EXPECT_LT(errors_of(f.sum, even).log_relative, 1e-5);
    EXPECT_LT(f.errors.cuberoot_relative, 1e-5);
}

// Nothing but noise above a flat surface: lobes go after it, and what they win they lose elsewhere.
TEST(FitSum, OverfittingShowsOnWhatIsHeldOut) {
    const Noisy target("lambert reflectance=0.5", 1.);
    const TargetSamples even = sample_target(target, {8, 4, 4, 80., FitGrid::Nodes::even}),
                        odd = sample_target(target, {8, 4, 4, 80., FitGrid::Nodes::odd});
    EXPECT_GT(even.missing, 0u);
    const FitOptions three{.stride = 1, .lobes = 3};
    const SumFit flat = fit_sum(find_evaluator("lambert"), {}, even);
    const SumFit lobes = fit_sum(find_evaluator("lafortune"), {}, even, three);
    EXPECT_LT(lobes.errors.log, 0.9 * flat.errors.log);
    EXPECT_GT(errors_of(lobes.sum, odd).log, 1.1 * errors_of(flat.sum, odd).log);
}

// cbrt(rho c/pi) is linear in cbrt(rho/pi): its best has a closed form, of whatever BRDF.
TEST(FitSum, CubeRootsOfAMatteSurfaceHaveAClosedForm) {
    const auto target = make_target("ward kd=0.3,0.2,0.1 ks=0.2 alpha=0.2");
    const TargetSamples s = sample_target(*target);
    const SumFit f = fit_sum(find_evaluator("lambert"), {}, s, {.metric = FitMetric::cuberoot});
    for (int c = 0; c < 3; ++c) {
        double above = 0., below = 0.;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double w = s.weight[i] * std::pow(s.wi[i].z, 2. / 3.);
            above += w * std::cbrt(s.value[i][c]);
            below += w;
        }
        EXPECT_NEAR(band_values(f.sum.terms()[0].model)[c].scalar[0],
                    std::numbers::pi * std::pow(above / below, 3.), 1e-5);
    }
    const SumFit ward = fit_sum(find_evaluator("ward"), {}, s, {.metric = FitMetric::cuberoot});
    EXPECT_LT(ward.errors.cuberoot_relative, 1e-5);
    // Each metric's fit is the best by it.
    const auto other = make_target("ggx kd=0.2 ks=0.6 alpha=0.15");
    const SumFit cube = fit_of("ward", *other, {.metric = FitMetric::cuberoot}),
                 log = fit_of("ward", *other);
    EXPECT_LT(cube.errors.cuberoot, log.errors.cuberoot);
    EXPECT_LT(log.errors.log, cube.errors.log);
}

TEST(FitSum, LimitsAndBoundsOfSums) {
    const auto target = make_target("lambert reflectance=0.5");
    // Neither of the lobes exceeds it alone.
    const SumFit two = fit_of("ward ks=0.6", *make_target("lambert reflectance=0.2"), {.lobes = 2});
    EXPECT_TRUE(two.beyond.starts_with("ward: kd + ks = 1.")) << two.beyond;
    const SumFit channel = fit_of("oren_nayar", *target, {.by_channel = true});
    EXPECT_EQ(channel.at_limit,
              (std::vector<std::string>{"sigma (red)", "sigma (green)", "sigma (blue)"}));
}

// Of Lafortune's lobe c^n carries the height, and its weight may be tiny: it is not rounded away.
TEST(FitSum, SmallWeightsOfHighLobesStay) {
    const char* text = "lafortune kd=0.1 ks=1e-7 cx=-1.05 cy=-1.05 cz=1.05 n=400 norm=none";
    const SumFit f =
        fit_of("lafortune norm=none cx=-1.05 cy=-1.05 cz=1.05 n=400", *make_target(text));
    EXPECT_LT(f.errors.log_relative, 1e-5);
    EXPECT_TRUE(f.at_limit.empty());
}

TEST(FitSum, WrongLobes) {
    const auto target = make_target("ward");
    const auto message = [&](const char* model) {
        return test::error_of([&] { fit_of(model, *target, {.lobes = 2}); });
    };
    EXPECT_EQ(message("lambert"),
              "lambert has no diffuse albedo kd apart from its highlight: it has one lobe");
    EXPECT_EQ(message("schlick"),
              "schlick has no diffuse albedo kd apart from its highlight: it has one lobe");
    EXPECT_EQ(message("ward ks=0.2 alpha=0.1"),
              "ward: nothing is left to fit in a further lobe; ask for one lobe");
}

}  // namespace nacre
