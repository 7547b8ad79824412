#include "nacre/measured/measured.h"

#include "nacre/measured/merl_measured.h"
#include "nacre/measured/target.h"
#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"
#include "tests/measured/made_files.h"

namespace nacre {
namespace {

/// A file of MERL's format: 1500 everywhere, some nodes without a measurement.
std::string made_merl() {
    constexpr std::size_t count = 90 * 90 * 180;
    std::string bytes(12 + 24 * count, '\0');
    const std::int32_t n[3] = {90, 90, 180};
    std::memcpy(bytes.data(), n, 12);
    for (std::size_t i = 0; i < 3 * count; ++i) {
        const double v = i % count < 1000 ? -1. : 1500.;
        std::memcpy(bytes.data() + 12 + 8 * i, &v, 8);
    }
    return bytes;
}

}  // namespace

TEST(ChannelColours, OfBandsGreyAndWavelengths) {
    MeasuredInfo info;
    const double bands[3] = {0.1, 0.2, 0.3};
    EXPECT_EQ(ChannelColours(info)(bands), Vec3d(0.1, 0.2, 0.3));
    info.channels = 1;
    const double grey[1] = {0.7};
    EXPECT_EQ(ChannelColours(info)(grey), Vec3d(0.7, 0.7, 0.7));
    info.wavelengths = {550.};  // a laser: one number says no colour
    EXPECT_EQ(ChannelColours(info)(grey), Vec3d(0.7, 0.7, 0.7));
    // Two wavelengths: a ramp between them, constant beyond.
    info.channels = 2;
    info.wavelengths = {500., 600.};
    const double ramp[2] = {0.2, 0.8};
    const Vec3f xyz = integrate_xyz([](float nm) {
        return d65_unit(nm) * std::clamp(0.2f + 0.006f * (nm - 500.f), 0.2f, 0.8f);
    });
    const Vec3d want(xyz_to_rgb(xyz)), found = ChannelColours(info)(ramp);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], want[c], 1e-4);
    const double white[2] = {0.5, 0.5};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ChannelColours(info)(white)[c], 0.5, 1e-12);
}

TEST(MerlMeasured, IsAMeasuredFile) {
    const auto m = test::parsed(made_merl());
    const MeasuredInfo& info = m->info();
    EXPECT_EQ(info.format, "merl");
    EXPECT_EQ(info.channels, 3);
    EXPECT_EQ(info.samples, 1458000u);
    EXPECT_EQ(info.missing, 1000u);
    EXPECT_EQ(info.negative, 0u);
    const auto v = test::value_at(*m, test::towards(60., 0.), test::towards(20., 90.));
    ASSERT_EQ(v.size(), 3u);
    EXPECT_NEAR(v[0], 1., 1e-6);
    EXPECT_NEAR(v[1], 1.15, 1e-6);
    EXPECT_NEAR(v[2], 1.66, 1e-6);
    std::size_t seen = 0, missing = 0;
    m->for_each_sample([&](const MeasuredSample& s) {
        ++seen;
        missing += s.state == SampleState::missing;
    });
    EXPECT_EQ(seen, info.samples);
    EXPECT_EQ(missing, info.missing);
}

/// The reader of MERL's files keeps its own messages, and other sizes of grid are named.
TEST(MerlMeasured, RefusesOtherGrids) {
    EXPECT_EQ(test::refusal(made_merl().substr(0, 1000)),
              "x.data: has 1000 bytes, but a BRDF of MERL's format has 34992012; it is incomplete "
              "or of another format: fetch it again");
    std::string small(12 + 24 * 6, '\0');
    const std::int32_t n[3] = {1, 2, 3};
    std::memcpy(small.data(), n, 12);
    EXPECT_EQ(test::refusal(small),
              "x.data: the header says 1 x 2 x 3 values, not 90 x 90 x 180: it is not an isotropic "
              "BRDF of MERL's format");
}

TEST(MeasuredTarget, IsAnyFileInThreeBands) {
    const auto target = MeasuredTarget(
        test::parsed("theta_i,phi_i,theta_o,phi_o,y\n30,0,40,180,0.25\n30,90,40,180,0.5\n"), "x");
    EXPECT_EQ(target.name(), "x");
    EXPECT_FALSE(target.isotropic());
    EXPECT_EQ(*target.value(test::towards(30., 0.), test::towards(40., 180.)),
              Vec3d(0.25, 0.25, 0.25));
    EXPECT_FALSE(target.value(test::towards(80., 0.), test::towards(40., 180.)));
    EXPECT_FALSE(target.value(test::towards(30., 0.), test::towards(140., 180.)));
}

}  // namespace nacre
