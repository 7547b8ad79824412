// Which technique for which error: laws of known numbers.
#include "nacre/report/advice.h"

#include "tests/compare/experiment_fixture.h"

namespace nacre::test {
namespace {

constexpr double five[] = {0.05};

ErrorLaw law(const std::string& name, double frame, double noise, double floor = 0,
             double sigma = 0) {
    return {.name = name,
            .frame = frame,
            .least_frame = frame / 16,
            .noise = noise,
            .floor = floor,
            .sigma = sigma};
}

std::string said(const std::vector<ErrorLaw>& laws, std::span<const double> errors = five) {
    return fmt::format("{}", fmt::join(advise(laws, errors), " "));
}

ExperimentRow row(double bias, double sigma, std::uint64_t seed) {
    ExperimentRow r;
    r.setting.choice.technique = "surface";
    r.measurement = made_up(32, 1, bias, sigma, 3, seed);
    Image truth(32, 32), none(32, 32);
    for (float& v : truth.data) v = 1.f;
    r.verdict = judge(r.measurement, truth, none, {});
    return r;
}

}  // namespace

/// Noise of 10 % after 1 s is 5 % after 4 s.
TEST(Advice, NoiseFallsAsOneOverTheRootOfTheTime) {
    ErrorLaw l = law("a", 1, 0.1);
    EXPECT_DOUBLE_EQ(time_to_reach(l, 0.05).seconds, 4);
    l.precompute = 3;
    EXPECT_DOUBLE_EQ(time_to_reach(l, 0.05).seconds, 7);
    // 5-4-3: a floor of 3 % leaves 4 % to noise, and 10 % / 4 % squared is 6.25.
    l.floor = 0.03;
    EXPECT_NEAR(time_to_reach(l, 0.05).seconds, 3 + 6.25, 1e-12);
    // No picture takes less than one sample a pixel.
    EXPECT_DOUBLE_EQ(time_to_reach(law("a", 1, 0.1), 1).seconds, 1. / 16);
}

TEST(Advice, TakesTwoStandardErrorsAsTheLimit) {
    EXPECT_EQ(time_to_reach(law("a", 1, 0.1, 0.03, 0.0099), 0.05).reach, Reach::certain);
    EXPECT_EQ(time_to_reach(law("a", 1, 0.1, 0.03, 0.0101), 0.05).reach, Reach::unsure);
    EXPECT_EQ(time_to_reach(law("a", 1, 0.1, 0.07, 0.0101), 0.05).reach, Reach::unsure);
    EXPECT_EQ(time_to_reach(law("a", 1, 0.1, 0.07, 0.0099), 0.05).reach, Reach::never);
}

TEST(Advice, SaysWhatTheNumbersSay) {
    EXPECT_EQ(said({}), "No technique has numbers, so none is recommended.");
    EXPECT_EQ(said({law("a", 1, 0.1), law("b", 2, 0.1)}),
              "For an error of 5 % the fastest is a: 4 s.");
    EXPECT_EQ(said({law("a", 1, 0.1), law("b", 1.05, 0.1)}),
              "For an error of 5 % the fastest is a: 4 s; not told apart by time: b.");
    EXPECT_EQ(said({law("a", 1, 0.1)}), "For an error of 5 % the only one compared is a: 4 s.");
    EXPECT_EQ(said({law("a", 1, 0.1, 0.2), law("b", 1, 0.1, 0.3)}),
              "An error of 5 % is certainly reached by none.");
    EXPECT_EQ(
        said({law("a", 1, 0.1, 0.05, 0.01), law("b", 1, 0.1, 0.3)}),
        "An error of 5 % is certainly reached by none; the noise leaves open whether a does.");
    EXPECT_EQ(said({law("a", 1, 0.1), law("b", 1, 0.1, 0.05, 0.01)}),
              "For an error of 5 % only a is certain: 4 s; left open by noise: b.");
}

/// A fast technique with a floor of 4 % and a slow one without: each where it is the faster.
TEST(Advice, ChangesWithTheError) {
    constexpr double errors[] = {0.2, 0.05, 0.02, 0.01};
    EXPECT_EQ(said({law("fast", 0.16, 0.03, 0.04), law("slow", 10, 0.1)}, errors),
              "For an error of 20 % to 5 % the fastest is fast: 0.01 s to 0.16 s. "
              "For an error of 2 % to 1 % only slow is certain: 4.2 min to 17 min.");
}

TEST(Advice, OfAnExperimentLeavesOutTwinsAndSaysWhatIsMissing) {
    Experiment e;
    e.rows = {row(0.01, 0, 1), row(0.01, 0, 1), row(0.02, 0, 3)};
    e.rows[1].setting.choice.technique = "brdf";
    const auto same = identical_rows(e.rows);
    EXPECT_FALSE(same[0]);
    EXPECT_EQ(same[1], std::optional<std::size_t>(0));
    EXPECT_FALSE(same[2]);
    e.rows.resize(2);  // 0.5 s before it, and one of 16 samples of a frame of 2 s
    EXPECT_EQ(advise(e, "volpath").front(),
              "For an error of 20 % to 1 % the only one compared is surface: 0.62 s.");
    e.rows[1].verdict.reset();
    e.rows[1].measurement.status = Measurement::Status::failed;
    EXPECT_EQ(advise(e, "volpath").back(), "One technique failed and has no part in this.");
    e.rows[1].measurement.status = Measurement::Status::missing;
    EXPECT_EQ(advise(e, "volpath").back(),
              "1 of 2 were not run: the finished comparison may say otherwise.");
}

/// The reference's own technique has no systematic error, whatever noise pretends.
TEST(Advice, TheReferencesTechniqueHasNoFloor) {
    ExperimentRow r = row(0.03, 0.2, 5);
    EXPECT_GT(error_law(r, "volpath")->floor, 0);
    EXPECT_EQ(error_law(r, "surface")->floor, 0);
}

}  // namespace nacre::test
