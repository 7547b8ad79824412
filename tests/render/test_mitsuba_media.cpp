// The complete simulation against published reference images of another renderer: five scenes with
// media, nested boundaries and an environment map (Mitsuba 3's regression tests), each with a mean
// and a variance image.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "nacre/image/image.h"
#include "nacre/render/render.h"
#include "nacre/scene/load.h"

namespace nacre {
namespace {

constexpr int samples = 256;

// Two-sided bound of a standard normal variable for 48 x 48 x 3 comparisons at a joint significance
// of 1 % (Sidak): the quantile of 1 - (1 - 0.99^(1/6912)) / 2.
constexpr double bound = 4.8186;

class MitsubaMedia : public testing::TestWithParam<const char*> {};

TEST_P(MitsubaMedia, AgreesWithPublishedMeanAndVariance) {
    const std::filesystem::path folder =
        std::filesystem::path(NACRE_SHARED_DIR) / "data/scene/mitsuba_media";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << folder << " is not there: published images not compared";
    const std::string name = GetParam();
    Scene scene = load_scene(folder / ("test_" + name + "_volpath.xml"));
    scene.sampler.samples = samples;
    ASSERT_TRUE(scene.integrator.moment);
    const Film film = render(scene).film;
    const Image mean = read_image(folder / "refs" / ("test_" + name + "_ref_rgb.pfm"));
    const Image variance = read_image(folder / "refs" / ("test_" + name + "_ref_rgb_var.pfm"));
    ASSERT_EQ(mean.width, film.width());
    ASSERT_EQ(mean.height, film.height());

    int within = 0, within_published = 0, count = 0;
    double ours[3]{}, theirs[3]{}, squares = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const Vec3f value = film.mean(x, y), own_variance = film.sample_variance(x, y);
            const Vec3f reference = mean.rgb(x, y), published = variance.rgb(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                ours[c] += value[c];
                theirs[c] += reference[c];
                const double difference = std::abs(value[c] - reference[c]);
                // The published variances come from a difference of moments of heavy-tailed samples
                // and are zero or negative in up to 5 % of some images, where no unbiased estimate
                // could pass; so the larger of theirs and ours is taken. How many would pass by
                // theirs alone is recorded beside it.
                const double larger =
                    std::max({double(published[c]), double(own_variance[c]), 1e-4});
                const double z = difference * std::sqrt(samples / larger);
                within += z < bound;
                within_published +=
                    difference * std::sqrt(samples / std::max<double>(published[c], 1e-4)) < bound;
                squares += z * z;
                ++count;
            }
        }
    RecordProperty("within_by_published_variance",
                   std::to_string(double(within_published) / count));
    EXPECT_GE(double(within) / count, 0.9975);
    EXPECT_GE(double(within_published) / count, 0.96);
    // A bias that hides below the noise of single pixels would raise the mean square.
    EXPECT_LT(squares / count, 1.1);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(ours[c] / theirs[c], 1.0, 0.01) << "channel " << c;
}

INSTANTIATE_TEST_SUITE_P(Scenes, MitsubaMedia,
                         testing::Values("homo_null_envmap", "homo_area_light",
                                         "homo_obj_inside_medium", "hetero_sigmat_albedo",
                                         "surf_area_light"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace nacre
