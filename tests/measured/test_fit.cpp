#include "nacre/measured/fit.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <filesystem>
#include <numbers>

#include "nacre/math/error.h"
#include "nacre/measured/fit_plan.h"

namespace nacre {
namespace {

TargetSamples samples_of(const std::string& target) { return sample_target(*make_target(target)); }

ModelFit fit(const std::string& model, const TargetSamples& samples,
             FitMetric metric = FitMetric::log) {
    const ModelSpec spec = parse_model_spec(model);
    return fit_model(find_evaluator(spec.name), spec.settings, samples, {.metric = metric});
}

class Black final : public Target {
  public:
    explicit Black(double value) : value_(value) {}
    std::string name() const override { return "soot"; }
    std::optional<Vec3d> value(const Vec3d&, const Vec3d&) const override {
        if (value_ < 0.) return std::nullopt;
        return Vec3d{value_, value_, value_};
    }
    bool isotropic() const override { return true; }

  private:
    double value_;
};

}  // namespace

// A model fitted to itself comes back, from starts at the defaults, a quarter and four times them.
TEST(Fit, FindsItsOwnParameters) {
    const std::pair<std::string, std::string> cases[] = {
        {"lambert reflectance=0.7,0.31,0.05", "lambert"},
        {"oren_nayar reflectance=0.6,0.4,0.2 sigma=0.55", "oren_nayar"},
        {"eon reflectance=0.9,0.5,0.2 roughness=0.7", "eon"},
        {"phong kd=0.4,0.2,0.1 ks=0.31 n=64", "phong"},
        {"blinn_phong kd=0.2 ks=0.1,0.2,0.3 n=25", "blinn_phong"},
        {"ward kd=0.2,0.3,0.1 ks=0.45,0.4,0.35 alpha=0.027", "ward"},
        {"ward variant=duer kd=0.2,0.3,0.1 ks=0.21 alpha=0.22", "ward variant=duer"},
        {"ward kd=0.2 ks=0.6 alpha_u=0.08 alpha_v=0.31", "ward"},
        {"cook_torrance kd=0.35,0.25,0.15 ks=0.6 m=0.18 n=1.7,1.6,1.8", "cook_torrance"},
        {"cook_torrance fresnel=schlick kd=0.1 ks=0.8 m=0.06 f0=0.9,0.6,0.3",
         "cook_torrance fresnel=schlick"},
        {"ggx kd=0.3,0.2,0.1 ks=0.7 alpha=0.12 n=1.4", "ggx"},
        {"ggx fresnel=conductor ks=1 kd=0 alpha=0.4 n=0.2,0.9,1.1 k=3.9,2.6,2.3",
         "ggx fresnel=conductor ks=1 kd=0"},
        {"torrance_sparrow kd=0.2 ks=0.5 m=0.07", "torrance_sparrow"},
        {"schlick c=0.3,0.4,0.5 r=0.02", "schlick"},
    };
    FitMetric metric = FitMetric::log;
    for (const auto& [target, model] : cases) {
        const ModelFit f = fit(model, samples_of(target), metric);
        EXPECT_LT(f.errors.relative(metric), 1e-5) << target << " fitted: " << f.text;
        EXPECT_TRUE(f.converged) << target;
        const ModelSpec truth = parse_model_spec(target);
        const std::array<ValuesD, 3> want = band_values(make_model(truth.name, truth.settings)),
                                     got = band_values(f.model);
        const auto& parameters = f.model.description().parameters;
        for (std::size_t i = 0; i < parameters.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(got[c].scalar[i], want[c].scalar[i],
                            1e-3 * std::max(0.05, want[c].scalar[i]))
                    << target << ", " << parameters[i].name << " fitted: " << f.text;
        metric = metric == FitMetric::log ? FitMetric::cosine : FitMetric::log;
    }
}

TEST(Fit, AMattSurfaceIsNotRough) {
    const ModelFit f = fit("oren_nayar", samples_of("lambert reflectance=0.5,0.4,0.3"));
    EXPECT_EQ(f.text, "reflectance=0.5,0.4,0.3 sigma=0");
    EXPECT_EQ(f.at_limit, std::vector<std::string>{"sigma"});
    EXPECT_EQ(f.beyond, "");
}

// The end of sigma's range is pi/2, which six digits would exceed.
TEST(Fit, WhatIsPrintedIsWithinTheRange) {
    const ModelFit f = fit("oren_nayar", samples_of("eon reflectance=0.6 roughness=0.8"));
    EXPECT_NE(f.text.find("sigma=1.57079"), f.text.npos) << f.text;
    EXPECT_EQ(f.at_limit, std::vector<std::string>{"sigma"});
    EXPECT_EQ(f.errors.log, errors_of(make_model("oren_nayar", parse_settings(f.text)),
                                      samples_of("eon reflectance=0.6 roughness=0.8"))
                                .log);
}

// The best grey of a Lambertian fit in the cosine metric has a closed form: the weighted mean
// sum w c^2 t / sum w c^2.
TEST(Fit, LambertHasAClosedForm) {
    const TargetSamples s = samples_of("ward kd=0.3,0.2,0.1 ks=0.2 alpha=0.2");
    for (int c = 0; c < 3; ++c) {
        double above = 0., below = 0.;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double w = s.weight[i] * s.wi[i].z * s.wi[i].z;
            above += w * s.value[i][c];
            below += w;
        }
        const ModelFit f = fit("lambert", s, FitMetric::cosine);
        EXPECT_NEAR(band_values(f.model)[c].scalar[0] / std::numbers::pi, above / below, 1e-5);
    }
}

// What a family contains it fits at least as well.
TEST(Fit, ARicherFamilyIsNoWorse) {
    for (const char* target :
         {"ward ks=0.3 kd=0.4 alpha=0.2", "ggx kd=0.2,0.1,0.05 ks=0.5 alpha=0.3"}) {
        const TargetSamples s = samples_of(target);
        const double matt = fit("lambert", s).errors.log;
        for (const char* model : {"oren_nayar", "ward", "cook_torrance", "ggx", "phong"})
            EXPECT_LE(fit(model, s).errors.log, matt * (1. + 1e-4)) << model << " to " << target;
        EXPECT_LE(fit("cook_torrance", s).errors.log, fit("cook_torrance m=0.2", s).errors.log);
    }
}

TEST(Fit, WhatIsGivenStays) {
    const TargetSamples s = samples_of("ward kd=0.3 ks=0.3 alpha=0.1");
    const ModelFit f = fit("ward variant=original ks=0.25 alpha_u=0.2", s);
    EXPECT_TRUE(f.text.starts_with("variant=original ks=0.25 alpha_u=0.2 kd=")) << f.text;
    EXPECT_NE(f.text.find(" alpha_v="), f.text.npos) << f.text;
    const ModelFit all = fit("lambert reflectance=0.5", s);
    EXPECT_EQ(all.text, "reflectance=0.5");
    EXPECT_TRUE(all.converged);
}

TEST(Fit, SumsBeyondOneAreSaid) {
    const ModelFit f = fit("ggx ks=1", samples_of("lambert reflectance=0.5"));
    EXPECT_TRUE(f.beyond.starts_with("ggx: kd + ks = 1.")) << f.beyond;
}

TEST(Fit, TheSameForAnyNumberOfThreads) {
    const TargetSamples s = samples_of("ward kd=0.3,0.2,0.1 ks=0.2 alpha=0.2");
    const auto with = [&](int threads) {
        std::string text;
        tbb::task_arena arena(threads);
        arena.execute([&] { text = fit("cook_torrance", s).text; });
        return text;
    };
    const std::string one = with(1);
    EXPECT_EQ(with(2), one);
}

// A stop leaves what there is.
TEST(Fit, Stops) {
    const std::atomic<bool> stop = true;
    const ModelFit f = fit_model(find_evaluator("ward"), {}, samples_of("phong"), {.stop = &stop});
    EXPECT_FALSE(f.converged);
    EXPECT_TRUE(std::isfinite(f.errors.log));
}

// Each metric's fit is the best by that metric, though GGX's weight ends at its bound on felt.
TEST(LongFit, EachMetricIsBestByItself) {
    const std::filesystem::path file =
        std::filesystem::path(NACRE_SHARED_DIR) / "data/brdf/merl/pink-felt.nbrdf.binary";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference data at " << file;
    const TargetSamples s = samples_of(file.string());
    for (const char* model : {"ggx", "cook_torrance distribution=ggx", "he_torrance"}) {
        const ModelFit log = fit(model, s), cosine = fit(model, s, FitMetric::cosine);
        EXPECT_LE(log.errors.log, cosine.errors.log * (1. + 1e-6)) << model;
        EXPECT_LE(cosine.errors.cosine, log.errors.cosine * (1. + 1e-6)) << model;
    }
}

TEST(FitPlan, Unknowns) {
    const auto names = [](const char* model, bool isotropic) {
        const ModelSpec spec = parse_model_spec(model);
        std::string text;
        for (const Unknown& u :
             plan_unknowns(find_evaluator(spec.name).description(), spec.settings, isotropic))
            text += (text.empty() ? "" : " ") + u.name;
        return text;
    };
    EXPECT_EQ(names("ward", true), "kd ks alpha");
    EXPECT_EQ(names("ward", false), "kd ks alpha_u alpha_v");
    EXPECT_EQ(names("ward alpha=0.2", true), "kd ks");
    EXPECT_EQ(names("ward alpha_v=0.2", true), "kd ks alpha_u");
    EXPECT_EQ(names("oren_nayar rho=0.2", true), "sigma");
    EXPECT_EQ(names("schlick", true), "c r k c2 r2 k2");
    EXPECT_THROW(names("ward beta=1", true), InputError);
}

TEST(FitPlan, Starts) {
    const auto starts = [](const char* model) {
        return plan_starts(plan_unknowns(find_evaluator(model).description(), {}, true));
    };
    // kd, ks, alpha: a quarter of the default and four times it, too.
    EXPECT_EQ(starts("ward"), (std::vector<std::vector<double>>{
                                  {0.5, 0.2, 0.1}, {0.5, 0.2, 0.025}, {0.5, 0.2, 0.4}}));
    EXPECT_EQ(starts("lambert").size(), 1u);
    EXPECT_EQ(starts("he_torrance").size(), 9u);  // sigma0 and tau
    for (const auto& s : starts("eon")) EXPECT_LE(s[1], 1.);
}

TEST(FitSamples, WeightsAndAngles) {
    const TargetSamples s = samples_of("lambert reflectance=0.5");
    double sum = 0., c2 = 0.;
    for (std::size_t i = 0; i < s.size(); ++i) {
        EXPECT_GE(std::min(s.wi[i].z, s.wo[i].z), std::cos(80. * std::numbers::pi / 180.));
        sum += s.weight[i];
        c2 += s.weight[i] * s.wi[i].z * s.wi[i].z;
    }
    EXPECT_NEAR(sum, 1., 1e-12);
    // Uniform over pairs of directions to 80 degrees: <cos^2> = (1 + k + k^2)/3, k = cos 80.
    const double k = std::cos(80. * std::numbers::pi / 180.);
    EXPECT_NEAR(c2, (1. + k + k * k) / 3., 0.01);
    // A black model is off by all there is.
    const FitErrors e = errors_of(make_model("lambert", {{"reflectance", 0.}}), s);
    EXPECT_NEAR(e.cosine_relative, 1., 1e-12);
    EXPECT_NEAR(e.log_relative, 1., 1e-12);
    EXPECT_NEAR(e.cosine, 0.5 / std::numbers::pi * std::sqrt(c2), 1e-9);
}

TEST(FitSamples, WrongTargets) {
    const auto message = [](auto&& call) {
        try {
            call();
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(message([] { sample_target(Black(0.)); }),
              "soot: is black; nothing can be fitted to it");
    EXPECT_EQ(message([] { sample_target(Black(std::nan(""))); }),
              "soot: has values that are not finite; nothing can be fitted to it");
    EXPECT_EQ(message([] { sample_target(Black(-1.)); }),
              "soot: has no value within 80 degrees of the normal");
    EXPECT_EQ(message([] { make_target("  "); }),
              "a model is missing: write its name, such as 'ward'");
    EXPECT_EQ(message([] { make_target("wrad alpha=0.2"); }),
              "unknown reflectance model 'wrad'; did you mean 'ward'?");
    EXPECT_EQ(message([] { make_target("ward kd=0.9 ks=0.9"); }),
              "ward: kd + ks = 1.8 is out of range: must lie within [0, 1], lest energy appear "
              "from nowhere");
    const std::string no_data = message([] { make_target(NACRE_SOURCE_DIR "/CMakeLists.txt"); });
    EXPECT_TRUE(no_data.starts_with(NACRE_SOURCE_DIR
                                    "/CMakeLists.txt: holds no measured reflectance that can be "
                                    "read (MERL"))
        << no_data;
    EXPECT_TRUE(no_data.ends_with("): it is text of another kind")) << no_data;
    EXPECT_EQ(message([] { make_target("felt.binary"); }),
              "felt.binary: cannot be read; check the name");
}

TEST(Target, KnowsWhetherItIsIsotropic) {
    for (const char* text : {"lambert", "ward", "ggx alpha=0.01", "schlick", "lafortune"})
        EXPECT_TRUE(make_target(text)->isotropic()) << text;
    for (const char* text : {"ward alpha_v=0.3", "ggx alpha_u=0.02", "schlick p=0.7",
                             "lafortune cx=-0.9", "lafortune cxy=0.1"})
        EXPECT_FALSE(make_target(text)->isotropic()) << text;
}

}  // namespace nacre
