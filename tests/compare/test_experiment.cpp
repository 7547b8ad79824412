// The experiment: what it runs, keeps and takes up again.
#include <atomic>

#include "tests/compare/experiment_fixture.h"

namespace nacre::test {

using Status = Measurement::Status;

TEST_F(ExperimentTest, OnlyWhollyTranslucentPixelsCount) {
    Scene s = ball(16);
    bool object_only = false;
    const PixelMask mask = translucent_pixels(s, object_only);
    EXPECT_TRUE(object_only);
    EXPECT_TRUE(mask(8, 8));
    EXPECT_FALSE(mask(0, 0));
    // The ball's outline: half the view is 5 tan(12 deg) = 1.063 at the middle, and the ball is
    // seen under asin(1/5), which meets the film at tan(asin(1/5)) / tan(12 deg) = 0.960 of its
    // half.
    const double share = double(mask.count(16, 16)) / 256;
    EXPECT_LT(share, 3.14159265 / 4 * 0.960 * 0.960);
    EXPECT_GT(share, 0.5);
}

TEST_F(ExperimentTest, EveryTechniqueGetsARowAndIsTakenUpAgain) {
    Scene s = ball(24);
    ExperimentOptions o = experiment_options("volpath,brdf");
    const Experiment first = run_experiment(s, o);
    ASSERT_TRUE(first.complete);
    EXPECT_FALSE(first.any_failed());
    EXPECT_LE(first.reference.error, 0.05);
    ASSERT_EQ(first.rows.size(), 2u);
    for (const ExperimentRow& row : first.rows) {
        EXPECT_EQ(row.measurement.status, Status::done) << row.measurement.why;
        EXPECT_FALSE(row.measurement.reused);
        EXPECT_EQ(row.measurement.repeats(), 2);
        std::string name = row.setting.id();
        std::ranges::replace(name, ' ', '_');
        EXPECT_TRUE(std::filesystem::exists(o.folder / (name + ".exr"))) << name;
    }
    EXPECT_EQ(s.integrator.type, "volpath");
    EXPECT_EQ(s.shapes[0].subsurface, nullptr);

    const Experiment second = run_experiment(s, o);
    EXPECT_TRUE(second.reference.reused);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_TRUE(second.rows[i].measurement.reused);
        EXPECT_EQ(second.rows[i].measurement.frame.data, first.rows[i].measurement.frame.data);
        EXPECT_EQ(second.rows[i].measurement.timings[1].frame,
                  first.rows[i].measurement.timings[1].frame);
        EXPECT_NEAR(second.rows[i].verdict->frame, first.rows[i].verdict->frame, 1e-5);
    }
    // Another build, seed or scene measures anew; so does asking for it.
    ExperimentOptions other = o;
    other.build = "another";
    EXPECT_FALSE(run_experiment(s, other).rows[0].measurement.reused);
    other = o;
    other.seed = 5;
    EXPECT_FALSE(run_experiment(s, other).rows[0].measurement.reused);
    other = o;
    other.fresh = true;
    EXPECT_FALSE(run_experiment(s, o).rows[0].measurement.reused);  // they had been overwritten
    EXPECT_TRUE(run_experiment(s, o).rows[0].measurement.reused);
    EXPECT_FALSE(run_experiment(s, other).rows[0].measurement.reused);
    Scene darker = ball(24, "0.5, 0.6, 0.6");
    EXPECT_FALSE(run_experiment(darker, o).rows[0].measurement.reused);
}

/// Complete simulation of itself has no error but noise; the local reflection of a ball that is
/// many free paths wide is not quite that.
TEST_F(ExperimentTest, SimulationIsFoundToHaveNoSystematicError) {
    Scene s = ball(32);
    ExperimentOptions o = experiment_options("volpath");
    o.settings = parse_techniques("volpath", {16});
    o.reference.error = 0.01;
    o.repeats = 4;
    const Verdict v = *run_experiment(s, o).rows[0].verdict;
    EXPECT_LE(v.systematic.value, 3 * v.systematic.sigma);
    EXPECT_NEAR(v.bias.value, 0, 3.5 * v.bias.sigma);
    EXPECT_LT(v.bias.sigma, 0.01);
    EXPECT_GT(v.noise, 0.01);
}

TEST_F(ExperimentTest, AFailingTechniqueHasARowThatSaysWhyAndTheRestGoesOn) {
    // Flat: there is no inside for light to be scattered in.
    std::string text = ball_scene(16);
    text.replace(text.find("type=\"sphere\""), 13, "type=\"rectangle\"");
    Scene s = load_scene(write("flat.xml", text));
    ExperimentOptions o = experiment_options("brdf,volpath");
    const Experiment e = run_experiment(s, o);
    ASSERT_TRUE(e.complete);
    EXPECT_TRUE(e.any_failed());
    EXPECT_EQ(e.rows[0].measurement.status, Status::failed);
    EXPECT_EQ(e.rows[0].measurement.why,
              "'ball' is flat: it has no inside for light to be scattered in; give it a thickness");
    EXPECT_FALSE(e.rows[0].verdict);
    EXPECT_EQ(e.rows[1].measurement.status, Status::done);
    EXPECT_EQ(s.integrator.type, "volpath");
}

TEST_F(ExperimentTest, AStopKeepsWhatIsFinished) {
    Scene s = ball(24);
    ExperimentOptions o = experiment_options("volpath,brdf");
    std::atomic<bool> stop = false;
    o.stop = &stop;
    o.progress = [&](const ExperimentProgress& p) {
        if (p.part == 3) stop = true;
    };
    const Experiment stopped = run_experiment(s, o);
    EXPECT_FALSE(stopped.complete);
    EXPECT_EQ(stopped.rows[0].measurement.status, Status::done);
    EXPECT_EQ(stopped.rows[1].measurement.status, Status::missing);
    stop = false;
    o.progress = {};
    const Experiment whole = run_experiment(s, o);
    EXPECT_TRUE(whole.complete);
    EXPECT_TRUE(whole.rows[0].measurement.reused);
    EXPECT_FALSE(whole.rows[1].measurement.reused);
}

TEST_F(ExperimentTest, DamagedPartsAreMeasuredAgain) {
    Measurement m = made_up(4, 1, 0, 0.1, 3, 1);
    m.statistics = {{"points", 12, ""}};
    m.memory_mb = 3.5;
    const auto file = folder_ / "part.exr";
    write_measurement(m, "key", file);
    const auto again = read_measurement("key", file);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->frame.data, m.frame.data);
    EXPECT_EQ(again->mean.data, m.mean.data);
    for (std::size_t i = 0; i < m.variance.data.size(); ++i)
        EXPECT_NEAR(again->variance.data[i], m.variance.data[i], 1e-5f * m.variance.data[i]);
    EXPECT_EQ(again->median_of(&Timing::frame), 2.);
    EXPECT_EQ(again->memory_mb, 3.5);
    ASSERT_EQ(again->statistics.size(), 1u);
    EXPECT_EQ(again->statistics[0].value, 12);
    EXPECT_FALSE(read_measurement("another key", file));
    EXPECT_FALSE(read_measurement("key", folder_ / "none.exr"));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_FALSE(read_measurement("key", file));
}

/// Another renderer: what it says of itself is in its row, and its failure is its own.
TEST_F(ExperimentTest, APeerIsMeasuredLikeATechnique) {
    PeerDescription good;
    good.name = "good";
    good.title = "Good";
    good.run = [](const PeerRequest& r) {
        PeerResult result;
        result.picture = Image(24, 24, {"R", "G", "B", "A"});
        for (float& v : result.picture.data) v = 0.25f;
        result.picture.at(0, 0, 0) = r.seed % 2 ? 1.f : 0.f;
        result.seconds = 2;
        result.wall_seconds = 5;
        result.peak_mb = 100;
        result.version = "Good 1.2";
        result.substitutions = {"the floor is flat"};
        EXPECT_EQ(r.samples, 7);
        EXPECT_EQ(r.scene_file, "a.xml");
        return result;
    };
    PeerDescription bad = good;
    bad.name = "bad";
    bad.run = [](const PeerRequest&) {
        PeerResult result;
        result.picture = Image(3, 2);
        return result;
    };
    Scene s = ball(24);
    ExperimentOptions o = experiment_options("brdf");
    o.peers = {&good, &bad};
    o.peer_source = {"a.xml", {}, 7};
    PeerDescription broken = good;
    broken.name = "broken";
    broken.run = [](const PeerRequest&) {
        PeerResult result;
        result.picture = Image(24, 24);
        for (float& v : result.picture.data) v = std::numeric_limits<float>::infinity();
        return result;
    };
    o.peers.push_back(&broken);
    const Experiment e = run_experiment(s, o);
    ASSERT_EQ(e.rows.size(), 4u);
    EXPECT_TRUE(e.complete);
    EXPECT_EQ(e.rows[3].measurement.status, Status::failed);
    EXPECT_NE(e.rows[3].measurement.why.find("is not finite at pixel"), std::string::npos)
        << e.rows[3].measurement.why;
    const Measurement& m = e.rows[1].measurement;
    EXPECT_EQ(m.id, "good 7 spp");
    ASSERT_EQ(m.status, Status::done) << m.why;
    EXPECT_EQ(m.median_of(&Timing::frame), 2);
    EXPECT_EQ(m.median_of(&Timing::precompute), 3);
    EXPECT_EQ(m.memory_mb, 100);
    EXPECT_EQ(m.mean.at(5, 5, 1), 0.25f);
    EXPECT_EQ(m.program, "Good 1.2");
    EXPECT_EQ(m.notes, std::vector<std::string>{"the floor is flat"});
    EXPECT_TRUE(e.rows[1].verdict);
    EXPECT_EQ(e.rows[2].measurement.status, Status::failed);
    EXPECT_EQ(e.rows[2].measurement.why, "its picture has 3 x 2 pixels instead of 24 x 24");
    EXPECT_TRUE(e.any_failed());
    // Kept like the others, with what it said.
    const Experiment again = run_experiment(s, o);
    EXPECT_TRUE(again.rows[1].measurement.reused);
    EXPECT_EQ(again.rows[1].measurement.notes, m.notes);
    EXPECT_EQ(again.rows[1].measurement.program, m.program);
}

TEST_F(ExperimentTest, OneRepeatIsTooFew) {
    Scene s = ball(8);
    EXPECT_EQ(error_of([&] {
                  measure(s, {{"volpath"}, 1}, {.repeats = 1});
              }),
              "1 repeats do not tell noise from bias; at least 2 are needed");
}

}  // namespace nacre::test
