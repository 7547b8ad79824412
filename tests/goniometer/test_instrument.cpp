// Real instruments: what they reach, blur and add is what their parameters say.
#include "nacre/goniometer/instrument.h"

#include <fmt/format.h>

#include "nacre/goniometer/patch_material.h"
#include "nacre/math/error.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

constexpr double one_degree = std::numbers::pi / 180.;

MeasurementSet measured_flat(const char* material, HemisphereBins bins,
                             const std::vector<double>& thetas, double phi_step = 0.) {
    const Patch patch =
        make_patch(make_microgeometry("flat"), surface_bsdf(material, Wavelengths::rgb_bands()));
    MeasureOptions options{.bins = bins};
    options.least_rays = options.most_rays = 1 << 16;
    MeasurementSet set{{}, {"r", "g", "b"}, {}, true};
    for (std::size_t i = 0; i < thetas.size(); ++i) {
        set.incidences.emplace_back(
            DirectionCell::at(thetas[i] * one_degree, double(i) * phi_step * one_degree), bins);
        measure(patch, options, set.incidences.back());
    }
    return set;
}

}  // namespace

TEST(Instrument, MissesWhatLiesOutsideItsReach) {
    const MeasurementSet set = measured_flat("lambert reflectance=0.5", {9, 18}, {20., 60.});
    const auto readings = read_instrument(
        make_instrument("foo incidence=50 exit=66 blocked=0 source=0 detector=0 noise=0 floor=0"),
        set);
    ASSERT_EQ(readings.size(), 2u);
    EXPECT_TRUE(readings[0].reached);
    EXPECT_FALSE(readings[1].reached);
    // Bins of 10 degrees with their middle at 65 and less: of Lambert's light the square of the sine
    // of 70 degrees; 2^16 rays give 0.0013.
    EXPECT_NEAR(readings[0].outside, std::pow(std::cos(70. * one_degree), 2), 0.0055);
    EXPECT_EQ(readings[0].blur, 0.);
    EXPECT_EQ(readings[0].noise, 0.);
    EXPECT_EQ(readings[1].outside, 1.);
    const IncidenceMeasurement& m = set.incidences[0];
    for (std::size_t i = 0; i < m.bins.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const double v = readings[0].value[i][std::size_t(k)];
            if (m.bins.cell(i).theta() < 66. * one_degree)
                EXPECT_EQ(v, m.brdf(i, k).value);
            else
                EXPECT_TRUE(std::isnan(v));
            EXPECT_TRUE(std::isnan(readings[1].value[i][std::size_t(k)]));
        }
    // The table says "nan" for what is missing.
    const std::string csv = csv_of(set, "foo", readings);
    EXPECT_NE(csv.find("\n60,0,5,10,nan,nan,nan\n"), std::string::npos) << csv.substr(0, 400);
    EXPECT_NE(csv.find("\n20,0,75,10,nan,nan,nan\n"), std::string::npos);
}

TEST(Instrument, ABlockedDetectorDoesNotSeeTheSourcesSurroundings) {
    const MeasurementSet set = measured_flat("lambert reflectance=0.5", {18, 36}, {42.5});
    const auto seen = [&](const char* text) {
        int count = 0;
        const auto readings = read_instrument(make_instrument(text), set);
        for (const Vec3d& v : readings[0].value) count += !std::isnan(v.x);
        return count;
    };
    // Within 8 degrees of (42.5, 0): two bins to the middle's left and right of its three rows.
    EXPECT_EQ(seen("ward exit=90 blocked=0"), 18 * 36);
    EXPECT_EQ(seen("ward exit=90 blocked=8"), 18 * 36 - 6);
}

// A mirror's peak becomes the disc of the detector.
TEST(Instrument, TheDetectorsConeBlursAMirror) {
    const MeasurementSet set = measured_flat("mirror", {45, 90}, {40.5});
    const auto readings = read_instrument(
        make_instrument("foo source=0 detector=5 blocked=0 noise=0 floor=0 exit=90"), set);
    const IncidenceMeasurement& m = set.incidences[0];
    double light = 0., highest = 0.;
    for (std::size_t i = 0; i < m.bins.size(); ++i) {
        const double v = readings[0].value[i].x;
        light += v * m.bins.cell(i).projected_solid_angle();
        highest = std::max(highest, v);
    }
    EXPECT_NEAR(light, 1., 0.05);
    // One over its projected solid angle; the disc fills some 15 bins, with 27 points in each.
    const double disc =
        std::numbers::pi * std::pow(std::sin(5. * one_degree), 2) * std::cos(40.5 * one_degree);
    EXPECT_NEAR(highest * disc, 1., 0.25);
    EXPECT_GT(readings[0].blur, 1.5);  // all of it is elsewhere: from where it is gone and to where
    EXPECT_NEAR(readings[0].outside, 0., 1e-12);
}

TEST(Instrument, NoiseIsWhatItSays) {
    const MeasurementSet set = measured_flat("lambert reflectance=0.8", {18, 36}, {30.});
    const char* text = "ward source=0 detector=0 noise=0.04 floor=0.003 exit=90 seed=3";
    const auto readings = read_instrument(make_instrument(text), set);
    const IncidenceMeasurement& m = set.incidences[0];
    double statistic = 0.;
    int count = 0;
    for (std::size_t i = 0; i < m.bins.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const double truth = m.brdf(i, k).value;
            const double z =
                (readings[0].value[i][std::size_t(k)] - truth) / std::hypot(0.04 * truth, 0.003);
            statistic += z * z;
            ++count;
        }
    // Chi-square with 1944 degrees of freedom: five standard deviations of sqrt(2/1944).
    EXPECT_NEAR(statistic / count, 1., 5. * std::sqrt(2. / count));
    // Of |z| the mean is sqrt(2/pi): the light's share by the same measure, to four deviations.
    EXPECT_NEAR(readings[0].noise,
                std::sqrt(2. / std::numbers::pi) * std::hypot(0.04, 0.003 * std::numbers::pi / 0.8),
                0.004);
    EXPECT_EQ(read_instrument(make_instrument(text), set)[0].value[100].y,
              readings[0].value[100].y);
    EXPECT_NE(read_instrument(make_instrument("ward source=0 detector=0 noise=0.04 floor=0.003 "
                                              "exit=90 seed=4"),
                              set)[0]
                  .value[100]
                  .y,
              readings[0].value[100].y);
}

TEST(Instrument, SaysWhatIsWrong) {
    const MeasurementSet two = measured_flat("lambert reflectance=0.5", {2, 2}, {20., 20.}, 30.);
    const std::pair<std::function<void()>, const char*> wrong[] = {
        {[] { make_instrument("fo"); }, "unknown instrument 'fo'; did you mean 'foo'?"},
        {[] { make_instrument("foo detector=-1"); },
         "foo: detector = -1 is out of range: must lie within [0, 90]"},
        {[] { make_instrument("ward isotropic=perhaps"); }, "ward: unknown isotropic 'perhaps'"},
        {[&] { read_instrument(make_instrument("cornell"), two); },
         "the instrument cornell measures at one azimuth of incidence: isotropic surfaces, "
         "--turned; or isotropic=no"}};
    for (const auto& [f, expected] : wrong) {
        const std::string message = test::error_of(f);
        EXPECT_EQ(message.substr(0, std::string_view(expected).size()), expected);
    }
    EXPECT_EQ(read_instrument(make_instrument("ward"), two).size(), 2u);
}

}  // namespace nacre
