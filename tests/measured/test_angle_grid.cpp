#include "nacre/measured/angle_grid.h"

#include "nacre/math/random.h"
#include "tests/measured/made_files.h"

namespace nacre {
namespace {

using test::parsed;
using test::towards;
using test::value_at;

/// Linear in each angle (degrees), but for the azimuth, which goes round.
double made_linear(double ti, double to, double around) {
    return (1. + 0.02 * ti) * (2. - 0.01 * to) + 0.003 * std::abs(around - 180.);
}

/// theta 0 to 80 by 10, azimuths in steps of 20 up to `last`.
std::string made_grid(int last) {
    std::string text = "theta_i,phi_i,theta_o,phi_o,y\n";
    for (int p = 0; p <= last; p += 20)  // in any order
        for (int i = 80; i >= 0; i -= 10)
            for (int o = 0; o <= 80; o += 10)
                text += fmt::format("{},15,{},{},{:.15g}\n", i, o, 15 + p, made_linear(i, o, p));
    return text;
}

}  // namespace

TEST(AngleGrid, IsLinearBetweenItsNodes) {
    for (const int last : {340, 180}) {  // the whole circle; half of it, which is mirrored
        const auto m = parsed(made_grid(last));
        EXPECT_EQ(
            m->info().parameterisation,
            fmt::format("grid of theta_i (9), phi_i (1), theta_o (9), phi_o ({})", last / 20 + 1));
        Random random(stream_key(27, 30));
        for (int k = 0; k < 2000; ++k) {
            const double ti = 80. * random.next(), to = 80. * random.next();
            const double around = 360. * random.next(), turn = 360. * random.next();
            const auto v = value_at(*m, towards(ti, turn), towards(to, turn + around));
            ASSERT_EQ(v.size(), 1u);
            ASSERT_NEAR(v[0], made_linear(ti, to, around), 1e-9)
                << ti << " " << to << " " << around;
        }
        // Half a step beyond the last theta its values hold, then there are none.
        EXPECT_NEAR(value_at(*m, towards(84., 0.), towards(40., 90.))[0],
                    made_linear(80., 40., 90.), 1e-9);
        EXPECT_TRUE(value_at(*m, towards(86., 0.), towards(40., 90.)).empty());
        EXPECT_TRUE(value_at(*m, towards(40., 0.), towards(140., 90.)).empty());
    }
}

TEST(AngleGrid, AnisotropyTransmissionAndGaps) {
    std::string text = "theta_i,phi_i,theta_o,phi_o,y\n";
    for (int i = 0; i <= 80; i += 20)
        for (int p = 0; p < 360; p += 60)
            for (int o = 0; o <= 180; o += 20)
                for (int q = 0; q < 360; q += 60) {
                    if (o == 80 && i == 80)
                        text += fmt::format("{},{},{},{},nan\n", i, p, o, q);
                    else
                        text += fmt::format("{},{},{},{},{}\n", i, p, o, q,
                                            (o > 90 ? 1000 : 0) + p + 0.001 * q);
                }
    const auto m = parsed(text);
    EXPECT_FALSE(m->info().isotropic);
    EXPECT_TRUE(m->info().reflection_front && m->info().transmission_front);
    EXPECT_EQ(m->info().samples, 5u * 6u * 10u * 6u);
    EXPECT_EQ(m->info().missing, 36u);
    EXPECT_NEAR(value_at(*m, towards(30., 90.), towards(50., 210.))[0], 90.21, 1e-9);
    EXPECT_NEAR(value_at(*m, towards(30., 330.), towards(50., 210.))[0], 150.21, 1e-9);
    // Both sides of the horizon keep to themselves.
    EXPECT_NEAR(value_at(*m, towards(30., 90.), towards(89., 210.))[0], 90.21, 1e-9);
    EXPECT_NEAR(value_at(*m, towards(30., 90.), towards(91., 210.))[0], 1090.21, 1e-9);
    // Missing nodes are left out while others hold half of the weight.
    EXPECT_NEAR(value_at(*m, towards(65., 60.), towards(65., 60.))[0], 60.06, 1e-9);
    EXPECT_TRUE(value_at(*m, towards(78., 60.), towards(78., 60.)).empty());
    EXPECT_TRUE(value_at(*m, {std::nan(""), 0., 1.}, towards(30., 0.)).empty());
}

TEST(AngleGrid, HalfACircleStandsForTheOtherOfIsotropicSurfacesOnly) {
    std::string text = "theta_i,phi_i,theta_o,phi_o,y\n";
    for (int i = 0; i <= 60; i += 20)
        for (int p = 0; p <= 180; p += 60)
            for (int o = 0; o <= 60; o += 20)
                for (int q = 0; q <= 180; q += 60)
                    text += fmt::format("{},{},{},{},{}\n", i, p, o, q, 1 + p + q);
    const auto m = parsed(text);
    ASSERT_FALSE(m->info().isotropic);
    ASSERT_EQ(m->info().parameterisation.substr(0, 4), "grid");
    EXPECT_NEAR(value_at(*m, towards(30., 90.), towards(30., 30.))[0], 121., 1e-9);
    EXPECT_TRUE(value_at(*m, towards(30., 90.), towards(30., 330.)).empty());
    EXPECT_TRUE(value_at(*m, towards(30., 270.), towards(30., 30.)).empty());
}

TEST(AngleGrid, HoldsHalfAStepBeforeItsFirstNode) {
    std::string text = "theta_i,phi_i,theta_o,phi_o,y\n";
    for (int i = 20; i <= 60; i += 20)
        for (int o = 0; o <= 60; o += 20)
            for (int p = 0; p < 360; p += 60) text += fmt::format("{},0,{},{},{}\n", i, o, p, i);
    const auto m = parsed(text);
    EXPECT_NEAR(value_at(*m, towards(11., 0.), towards(30., 50.))[0], 20., 1e-12);
    EXPECT_TRUE(value_at(*m, towards(9., 0.), towards(30., 50.)).empty());
}

TEST(AngleGrid, OtherTablesAreScattered) {
    const std::string good = made_grid(340);
    const auto kind = [](const std::string& text) {
        return parsed(text)->info().parameterisation.substr(0, 4);
    };
    EXPECT_EQ(kind(good), "grid");
    EXPECT_EQ(kind(good + "40,15,40,35,1\n"), "scat");  // a pair twice
    const std::size_t row = good.find('\n') + 1;
    EXPECT_EQ(kind(good.substr(0, row) + good.substr(good.find('\n', row) + 1)), "scat");
    // A pair twice and another not at all.
    EXPECT_EQ(kind(good.substr(0, row) + "0,15,0,15,1\n" + good.substr(good.find('\n', row) + 1)),
              "scat");
    // Light and view in one plane, and incidences far from each other.
    EXPECT_EQ(kind("theta_i,phi_i,theta_o,phi_o,y\n0,0,0,0,1\n0,0,0,180,1\n20,0,0,0,1\n"
                   "20,0,0,180,1\n0,0,20,0,1\n0,0,20,180,1\n20,0,20,0,1\n20,0,20,180,1\n"),
              "scat");
    EXPECT_EQ(
        kind("theta_i,phi_i,theta_o,phi_o,y\n0,0,0,0,1\n60,0,0,0,1\n0,0,20,0,1\n60,0,20,0,1\n"),
        "scat");
    // A section through a highlight says nothing of the sides, however fine it is.
    std::string section = "theta_i,phi_i,theta_o,phi_o,y\n";
    for (int i = 0; i <= 80; i += 10)
        for (int o = 0; o <= 80; o += 10) section += fmt::format("{},0,{},180,1\n", i, o);
    EXPECT_EQ(kind(section), "scat");
    EXPECT_TRUE(value_at(*parsed(section), towards(60., 0.), towards(60., 90.)).empty());
}

}  // namespace nacre
