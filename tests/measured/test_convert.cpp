#include "nacre/measured/convert.h"

#include <cmath>

#include "nacre/math/random.h"
#include "nacre/measured/half_angle.h"
#include "nacre/measured/merl_measured.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/views.h"
#include "tests/measured/made_files.h"
#include "tests/measured/made_source.h"
#include "tests/support/constants.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

using test::MadeSource;

const MeasuredFormat& format_named(std::string_view name) { return measured_formats().find(name); }

std::shared_ptr<MadeSource> grey_wall() {
    return std::make_shared<MadeSource>(
        [](int c, const Vec3d&, const Vec3d&) { return 0.1 * (c + 1); });
}

}  // namespace

/// What does not depend on directions comes back exactly, in every format, with no error found.
TEST(Convert, AMatteSurfaceComesBackFromEveryFormat) {
    for (const std::string_view name : writable_formats()) {
        const Converted c = convert(grey_wall(), format_named(name), {});
        EXPECT_EQ(c.data->info().format, name);
        EXPECT_TRUE(c.data->info().isotropic) << name;
        EXPECT_TRUE(c.lost.empty()) << name;
        ASSERT_EQ(c.errors.size(), 3u);
        for (const ResamplingError& e : c.errors)
            EXPECT_TRUE(name == "rgl" || e.percentile95 < 1e-6) << name << " " << e.where;
        EXPECT_LT(c.errors[0].mean, 0.005) << name;
        const auto v = test::value_at(*c.data, test::towards(30., 0.), test::towards(40., 70.));
        ASSERT_EQ(v.size(), 3u) << name;
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(v[k], 0.1 * (k + 1), 2e-3) << name;
    }
    EXPECT_EQ(writable_formats(), (std::vector<std::string_view>{"merl", "rgl", "alta", "csv"}));
}

/// The error is what it says: against a file that is a tenth too bright.
TEST(Convert, TheErrorIsTheDifference) {
    const auto wall = grey_wall();
    const MadeSource brighter([](int c, const Vec3d&, const Vec3d&) { return 0.11 * (c + 1); });
    for (const ResamplingError& e : resampling_errors(*wall, brighter)) {
        EXPECT_NEAR(e.mean, 0.1, 1e-9);
        EXPECT_NEAR(e.percentile95, 0.1, 1e-9);
        EXPECT_EQ(e.pairs, 4096u);
    }
    // Half as much again in a tenth or a fiftieth of all azimuths.
    for (const double part : {0.1, 0.02}) {
        const MadeSource sector([&](int c, const Vec3d& i, const Vec3d&) {
            const double turn = std::atan2(i.y, i.x) / (2. * pi) + 0.5;
            return 0.1 * (c + 1) * (turn < part ? 1.5 : 1.);
        });
        for (const ResamplingError& e : resampling_errors(*wall, sector)) {
            EXPECT_NEAR(e.mean, 0.5 * part, 0.26 * part) << e.where;  // four standard errors
            EXPECT_NEAR(e.percentile95, part == 0.1 ? 0.5 : 0., 1e-9) << e.where;
        }
    }
    MadeSource half([](int c, const Vec3d&, const Vec3d&) { return 0.1 * (c + 1); });
    half.known = [](const Vec3d& wi, const Vec3d&) { return wi.x > 0.; };
    const auto few = resampling_errors(*wall, half), more = resampling_errors(half, *wall);
    EXPECT_NEAR(double(few[0].unknown), 2048., 200.);
    EXPECT_EQ(few[0].added, 0u);
    EXPECT_EQ(more[0].added, few[0].unknown);
    EXPECT_EQ(more[0].pairs, 4096u - more[0].added);
}

TEST(Convert, MerlNodesHaveTheValuesOfTheSource) {
    const auto f = [](const Vec3d& i, const Vec3d& o) {
        return 0.2 + dot(i, o) * dot(i, o) * i.z * o.z;
    };
    const auto source = std::make_shared<MadeSource>(
        [&](int c, const Vec3d& i, const Vec3d& o) { return (c + 1) * f(i, o); });
    const Converted c = convert(source, format_named("merl"), {});
    std::size_t missing = 0, compared = 0;
    c.data->for_each_sample([&](const MeasuredSample& s) {
        const double lower = std::min(s.wi.z, s.wo.z);
        if (s.state == SampleState::missing) {
            ++missing;
            ASSERT_LT(lower, 0.);
        } else if (lower > 0.01) {
            ++compared;
            for (int k = 0; k < 3; ++k) ASSERT_NEAR(s.value[k], (k + 1) * f(s.wi, s.wo), 1e-6);
        }
    });
    EXPECT_GT(missing, 0u);
    EXPECT_GT(compared, 500000u);
}

/// Light and viewer have one value in MERL's files: the mean of both.
TEST(Convert, MerlSaysWhatExchangesAndWhatIsNegative) {
    const auto source = std::make_shared<MadeSource>(
        [](int, const Vec3d& i, const Vec3d& o) { return 1. + 0.5 * (i.z - o.z); });
    const Converted c = convert(source, format_named("merl"), {});
    ASSERT_EQ(c.lost.size(), 1u);
    EXPECT_NE(c.lost[0].find("light and viewer exchanged"), std::string::npos) << c.lost[0];
    EXPECT_NEAR(test::value_at(*c.data, test::towards(60., 0.), test::towards(5., 90.)).at(0), 1.,
                1e-6);
    const auto negative = std::make_shared<MadeSource>(
        [](int c, const Vec3d&, const Vec3d&) { return c == 1 ? -0.1 : 0.1; });
    const Converted n = convert(negative, format_named("merl"), {});
    ASSERT_EQ(n.lost.size(), 1u);
    EXPECT_NE(n.lost[0].find("negative values are 0"), std::string::npos) << n.lost[0];
    EXPECT_EQ(test::value_at(*n.data, test::towards(60., 0.), test::towards(5., 90.)).at(1), 0.);
}

/// Gaps of the source are gaps of MERL's file, and `nan` of CSV.
TEST(Convert, GapsStay) {
    const auto gap = grey_wall();
    gap->known = [](const Vec3d& wi, const Vec3d& wo) { return wi.z > 0.5 && wo.z > 0.5; };
    gap->info_to_change().largest_incidence = gap->info_to_change().largest_exit = 60.;
    for (const char* name : {"merl", "csv", "alta"}) {
        const Converted c = convert(gap, format_named(name), {});
        EXPECT_TRUE(test::value_at(*c.data, test::towards(70., 0.), test::towards(20., 0.)).empty())
            << name;
        EXPECT_EQ(test::value_at(*c.data, test::towards(40., 0.), test::towards(20., 0.)).size(),
                  3u)
            << name;
        EXPECT_EQ(c.lost.size(), name == std::string("alta") ? 1u : 0u) << name;
    }
}

/// Samples at directions of their own are written as they are, in either text format.
TEST(Convert, OwnSamplesComeBack) {
    const std::string cornell =
        "# paint\n# num wls\n2\n400 700\n0.5 0.1 0.25 3.0 0.125 0.2\n0.5 0.1 0.4 2.0 -0.1 0.2\n"
        "0.2 2.1 0.7 1.0 0.5 0.25\n";
    const std::shared_ptr<const Measured> source = test::parsed(cornell);
    const Converted c = convert(source, format_named("csv"), {});
    EXPECT_EQ(c.data->info().wavelengths, (std::vector<double>{400., 700.}));
    EXPECT_EQ(c.data->info().samples, 3u);
    EXPECT_EQ(c.data->info().negative, 1u);
    EXPECT_EQ(c.data->info().description, "paint");
    source->for_each_sample([&](const MeasuredSample& s) {
        const auto v = test::value_at(*c.data, s.wi, s.wo);
        ASSERT_EQ(v.size(), 2u);
        for (int k = 0; k < 2; ++k) EXPECT_NEAR(v[k], s.value[k], 1e-7);
    });
    const Converted alta = convert(source, format_named("alta"), {});
    EXPECT_EQ(alta.data->info().channels, 3);
    ASSERT_EQ(alta.lost.size(), 1u);
    EXPECT_EQ(alta.lost[0], "2 wavelengths: red, green and blue under D65 are written");
    // One wavelength alone is a column of its own, and grey elsewhere.
    const std::shared_ptr<const Measured> laser =
        test::parsed("# num wls\n1\n633\n0.5 0.1 0.25 3.0 0.125\n0.2 0.1 0.4 2.0 0.2\n");
    const Converted column = convert(laser, format_named("csv"), {});
    EXPECT_TRUE(column.lost.empty());
    EXPECT_EQ(column.data->info().wavelengths, std::vector<double>{633.});
    const Converted grey = convert(laser, format_named("alta"), {});
    ASSERT_EQ(grey.lost.size(), 1u);
    EXPECT_EQ(grey.lost[0], "the wavelength: a single one is written as grey");
    EXPECT_EQ(grey.data->info().channels, 1);
    ConvertOptions grid;
    grid.write.samples = false;
    grid.write.step = 15.;
    EXPECT_GT(convert(source, format_named("csv"), grid).data->info().samples, 500u);
}

TEST(Convert, LightThatGoesThrough) {
    const auto pane = grey_wall();
    pane->info_to_change().transmission_front = true;
    const Converted csv = convert(pane, format_named("csv"), {});
    EXPECT_TRUE(csv.lost.empty());
    EXPECT_NEAR(test::value_at(*csv.data, test::towards(30., 0.), test::towards(150., 10.)).at(1),
                0.2, 1e-6);
    for (const char* name : {"merl", "rgl", "alta"}) {
        const Converted c = convert(pane, format_named(name), {});
        ASSERT_EQ(c.lost.size(), 1u) << name;
        EXPECT_EQ(c.lost[0], "light that goes through: the format holds reflection alone");
    }
    pane->info_to_change().reflection_front = false;
    EXPECT_EQ(test::error_of([&] { convert(pane, format_named("merl"), {}); }),
              "MERL holds light reflected in front, and the data have none; csv holds more");
}

TEST(Convert, AnisotropyIsRefusedOrTurnedAround) {
    const auto brushed = std::make_shared<MadeSource>(
        [](int, const Vec3d& i, const Vec3d&) { return 1. + i.x * i.x; }, false);
    EXPECT_EQ(test::error_of([&] { convert(brushed, format_named("merl"), {}); }),
              "MERL holds isotropic surfaces, and this one is anisotropic; --isotropic writes its "
              "mean over turns about the normal");
    ConvertOptions options;
    options.turned_around = true;
    const Converted c = convert(brushed, format_named("csv"), options);
    EXPECT_TRUE(c.data->info().isotropic);
    ASSERT_EQ(c.lost.size(), 1u);
    EXPECT_EQ(c.lost[0], "anisotropy: the mean over turns about the normal is written");
    // The mean of cos^2 is a half.
    const Vec3d wi = test::towards(60., 25.), wo = test::towards(30., 80.);
    EXPECT_NEAR(test::value_at(*c.data, wi, wo).at(0), 1. + 0.5 * (1. - wi.z * wi.z), 2e-3);
    // What has samples of its own has none once it is turned: a grid is written.
    test::MadeKlems file;
    file.blocks = {{"Reflection Front", "1 1 1 1 1\n1 2 1 1 1\n1 1 3 1 1\n1 1 1 4 1\n1 1 1 1 5"}};
    const std::shared_ptr<const Measured> klems = test::parsed(file.text());
    EXPECT_GT(convert(klems, format_named("csv"), options).data->info().samples, 5000u);
    for (const char* name : {"csv", "alta"})
        EXPECT_FALSE(convert(brushed, format_named(name), {}).data->info().isotropic) << name;
}

TEST(Convert, FormatsThatCannotBeWrittenSaySo) {
    EXPECT_EQ(test::error_of([] { convert(grey_wall(), format_named("klems"), {}); }),
              "Klems XML cannot be written; known are merl, rgl, alta, csv");
}

TEST(Views, SpectraOfModels) {
    const AnyModel lambert = make_model("lambert", parse_settings("reflectance=0.5"));
    const auto view = view_of(lambert, "lambert", {450., 550., 650.});
    EXPECT_EQ(view->info().channels, 3);
    EXPECT_EQ(view->info().wavelengths.size(), 3u);
    for (const double v : test::value_at(*view, test::towards(10., 0.), test::towards(20., 0.)))
        EXPECT_NEAR(v, 0.5 / pi, 1e-6);
    EXPECT_EQ(test::error_of([&] {
                  view_of(lambert, "x", {500., 400.});
              }),
              "wavelengths must be positive and ascend, but 400 follows 500");
    EXPECT_EQ(test::error_of([&] { view_of(lambert, "x", {}); }),
              "0 wavelengths; there must be 1 to 1024");
}

}  // namespace nacre
