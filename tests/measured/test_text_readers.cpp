// Scattered measurements as text: what stands in the files comes back.
#include <numbers>

#include "nacre/math/random.h"
#include "nacre/measured/half_angle.h"
#include "nacre/spectrum/color.h"
#include "tests/measured/made_files.h"

namespace nacre {
namespace {

using test::parsed;
using test::towards;
using test::value_at;

constexpr double radian = 180. / std::numbers::pi;

}  // namespace

TEST(TextReaders, CornellReturnsItsNumbers) {
    const auto m = parsed(
        "# Cornell University\n# blue paint\n\n# num wls\n3\n# wls\n400 500\n600 # the last\n\n"
        "0.5 0.1 0.25 3.0 0.25 0.5 0.75\r\n"
        "0.5 0.1 0.75 -2.0 -0.01 1.5 1.75\n"
        "1.0 0.0 0.25 3.0 nan 2.5 2.75\n"
        "0.2 0.0 0.4 1.0 7 8 9");
    const MeasuredInfo& info = m->info();
    EXPECT_EQ(info.format, "cornell");
    EXPECT_EQ(info.description, "Cornell University; blue paint");
    EXPECT_EQ(info.wavelengths, (std::vector<double>{400., 500., 600.}));
    EXPECT_TRUE(info.isotropic);
    EXPECT_FALSE(info.cosine);
    EXPECT_EQ(info.samples, 4u);
    EXPECT_EQ(info.missing, 1u);
    EXPECT_EQ(info.negative, 1u);
    EXPECT_NEAR(info.largest_incidence, 0.5 * radian, 1e-9);  // missing and negative do not count
    const auto at = [](double theta, double phi) { return towards(theta * radian, phi * radian); };
    const Vec3d wi = at(0.5, 0.1);
    EXPECT_EQ(value_at(*m, wi, at(0.25, 3.)), (std::vector<double>{0.25, 0.5, 0.75}));
    EXPECT_EQ(value_at(*m, wi, at(0.75, -2.)), (std::vector<double>{-0.01, 1.5, 1.75}));
    // Turned about the normal, and mirrored at the plane of incidence.
    EXPECT_EQ(value_at(*m, at(0.5, 1.1), at(0.25, 4.)), (std::vector<double>{0.25, 0.5, 0.75}));
    EXPECT_EQ(value_at(*m, at(0.5, 0.), at(0.25, -2.9)), (std::vector<double>{0.25, 0.5, 0.75}));
    // Beyond what was measured there is nothing.
    EXPECT_TRUE(value_at(*m, at(1.2, 0.), at(0.25, 3.)).empty());
    EXPECT_TRUE(value_at(*m, wi, at(1.3, 3.)).empty());
    EXPECT_TRUE(value_at(*m, wi, -at(0.25, 3.)).empty());
    EXPECT_TRUE(value_at(*m, -wi, at(0.25, 3.)).empty());
}

/// Between measurements of a smooth function the mixture stays near it, is one function of the
/// pair, and has no steps.
TEST(TextReaders, BetweenMeasurementsValuesAreSmooth) {
    const auto truth = [](const Vec3d& wi, const Vec3d& wo) {
        const HalfAngle a = to_half_angle(wi, wo);
        return 0.3 + 0.5 * std::exp(-4. * a.theta_h) + 0.1 * wi.z * wo.z;
    };
    std::string text = "theta_i,phi_i,theta_o,phi_o,y\n";
    for (int i = 0; i <= 80; i += 8)
        for (int o = 0; o <= 80; o += 8)
            for (int p = 0; p <= 180; p += 15)
                text += fmt::format("{},30,{},{},{:.12g}\n", i, o, 30 + p,
                                    truth(towards(i, 30), towards(o, 30 + p)));
    text += "33,30,44,31,0.5\n";  // this one makes it no grid
    text.replace(text.rfind("0.5\n"), 3,
                 fmt::format("{:.12g}", truth(towards(33, 30), towards(44, 31))));
    const auto m = parsed(text);
    EXPECT_TRUE(m->info().isotropic);
    EXPECT_EQ(m->info().parameterisation, "scattered directions theta_i, phi_i, theta_o, phi_o");
    Random random(stream_key(27, 9));
    double sum = 0.;
    for (int k = 0; k < 2000; ++k) {
        const double ti = 78. * random.next(), to = 78. * random.next(), p = 360. * random.next();
        const auto v = value_at(*m, towards(ti, 0.), towards(to, p));
        ASSERT_EQ(v.size(), 1u);
        const double want = truth(towards(ti, 0.), towards(to, p));
        ASSERT_NEAR(v[0], want, 0.12) << ti << " " << to << " " << p;
        sum += std::abs(v[0] - want);
        const auto near = value_at(*m, towards(ti, 0.), towards(to + 1e-3, p));
        ASSERT_NEAR(near[0], v[0], 1e-3);
    }
    EXPECT_LT(sum / 2000., 0.02);
    // No steps, as the nearest sample alone would make.
    double before = value_at(*m, towards(33., 0.), towards(0., 50.))[0];
    for (double to = 0.; to < 78.; to += 0.02) {
        const double now = value_at(*m, towards(33., 0.), towards(to, 50.))[0];
        ASSERT_NEAR(now, before, 2e-3) << to;
        before = now;
    }
}

/// Half vector and difference angle do not tell a pair from the same one the other way round: data
/// that are not reciprocal are not made so.
TEST(TextReaders, LightAndViewAreNotExchanged) {
    const auto m = parsed("theta_i,phi_i,theta_o,phi_o,y\n30,0,60,0,1\n60,0,30,0,2\n");
    EXPECT_EQ(value_at(*m, towards(30., 0.), towards(60., 0.)), (std::vector<double>{1.}));
    EXPECT_EQ(value_at(*m, towards(60., 0.), towards(30., 0.)), (std::vector<double>{2.}));
}

TEST(TextReaders, AltaNamesItsCoordinates) {
    // One pair of directions, light at 30 degrees and the view at 50, 100 degrees apart.
    const Vec3d light = towards(30., 0.), view = towards(50., 100.);
    const HalfAngle a = to_half_angle(light, view);
    const double v = 50. / radian, l = 30. / radian, d = 100. / radian;
    struct Case {
        int count;
        const char* name;
        std::string row;
        bool isotropic;
    };
    for (const Case& c :
         {Case{3, "RUSIN_TH_TD_PD", fmt::format("{} {} {}", a.theta_h, a.theta_d, a.phi_d), true},
          {4, "RUSIN_TH_PH_TD_PD",
           fmt::format("{} {} {} {}", a.theta_h, a.phi_h, a.theta_d, a.phi_d), false},
          {3, "ISOTROPIC_TV_TL_DPHI", fmt::format("{} {} {}", v, l, -d), true},
          {3, "ISOTROPIC_TL_TV_PROJ_DPHI",
           fmt::format("{} {} {}", l, v * std::cos(d), v * std::sin(d)), true},
          {4, "SPHERICAL_TL_PL_TV_PV", fmt::format("{} 0 {} {}", l, v, d), false},
          {6, "CARTESIAN",
           fmt::format("{} {} {} {} {} {}", view.x, view.y, view.z, light.x, light.y, light.z),
           false}}) {
        const std::string head =
            fmt::format("#SAMPLE \"tape\"\n#DIM {} 1\n#PARAM_IN {}\n", c.count, c.name);
        const auto plain = parsed(head + "#PARAM_OUT INV_STERADIAN\n" + c.row + " 0.625\n");
        const auto found = value_at(*plain, light, view);
        ASSERT_EQ(found.size(), 1u) << c.name;
        EXPECT_NEAR(found[0], 0.625, 1e-12) << c.name;
        EXPECT_EQ(plain->info().isotropic, c.isotropic) << c.name;
        EXPECT_EQ(plain->info().description, "tape");
        // What holds the cosine holds that of the view.
        const auto cosine =
            parsed(head + "#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n" + c.row + " 0.625\n");
        EXPECT_TRUE(cosine->info().cosine);
        EXPECT_NEAR(value_at(*cosine, light, view)[0], 0.625 / view.z, 1e-10) << c.name;
    }
}

TEST(TextReaders, AltaSlicesBoundsAndUnits) {
    const auto slice = parsed(
        "#DIM 1 3\n#PARAM_IN COS_TH\n#PARAM_OUT RGB_COLOR\n"
        "1 0.1 0.2 0.3\n0.99 0.2 0.3 0.4\n0.98 0.3 0.4 0.5\n");
    EXPECT_EQ(slice->info().channels, 3);
    const Vec3d w{std::sqrt(1. - 0.99 * 0.99), 0., 0.99};
    EXPECT_EQ(value_at(*slice, w, w), (std::vector<double>{0.2, 0.3, 0.4}));
    // Away from theta_d = 0 a slice knows nothing.
    EXPECT_TRUE(value_at(*slice, towards(20., 0.), towards(20., 180.)).empty());
    // Bounds of the values stand behind them and are left alone.
    const auto bounds =
        parsed("#DIM 1 1\n#VS 2\n#PARAM_IN COS_TH\n#PARAM_OUT INV_STERADIAN\n1 5 4 6\n");
    EXPECT_EQ(value_at(*bounds, {0., 0., 1.}, {0., 0., 1.}), (std::vector<double>{5.}));
    // Without a unit the file's numbers are taken as they are, and it is said.
    const auto unknown = parsed("#DIM 1 1\n#PARAM_IN COS_TH\n1 5\n");
    EXPECT_NE(unknown->info().notes.back().find("does not say what its values are"),
              std::string::npos);
    // At the horizon f cannot be had from f cos.
    const auto horizon = parsed(
        "#DIM 3 1\n#PARAM_IN ISOTROPIC_TL_TV_PROJ_DPHI\n"
        "#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n"
        "0.3 0.2 0 1\n0.3 1.5707963267948966 0 0.001\n");
    EXPECT_EQ(horizon->info().samples, 2u);
    EXPECT_EQ(horizon->info().missing, 1u);
    EXPECT_EQ(horizon->info().notes.back(),
              "1 samples at the horizon are missing: f cannot be had from f cos there");
}

TEST(TextReaders, AstmReadsItsKeywordsAndColours) {
    const auto rgb = parsed(
        "ASTM E 1392\nMATERIAL garnet red\nNUM_POINTS 2\n"
        "VARS theta_i,phi_i,theta_s,phi_s,R,G,B\n"
        "0.5,0,0.25,3.0,0.1,0.2,0.3\n0.5,0,0.75,3.0,0.4,0.5,0.6\n");
    EXPECT_EQ(rgb->info().format, "astm");
    EXPECT_EQ(rgb->info().description, "garnet red");
    EXPECT_EQ(value_at(*rgb, towards(0.5 * radian, 0.), towards(0.75 * radian, 3. * radian)),
              (std::vector<double>{0.4, 0.5, 0.6}));
    // XYZ of D65's white, columns of angles in another order, degrees by the header's word.
    const Vec3f white = rgb_to_xyz({1.f, 1.f, 1.f});
    const auto xyz =
        parsed(fmt::format("UNITS degrees\nVARS theta_s,phi_s,theta_i,phi_i,X,Y,Z\n"
                           "40,180,30,0,{},{},{}\n",
                           white.x, white.y, white.z));
    const auto v = value_at(*xyz, towards(30., 0.), towards(40., 180.));
    ASSERT_EQ(v.size(), 3u);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(v[c], 1., 1e-5);
    const auto grey = parsed(
        "VARS theta_i,phi_i,theta_s,phi_s,Integrated Luminance\n"
        "0.5,0,0.25,3.0,0.125\n");
    EXPECT_EQ(grey->info().channels, 1);
}

TEST(TextReaders, CsvKnowsTransmissionAnisotropyAndWavelengths) {
    const auto m = parsed(
        "# blind, both ways\ntheta_i, phi_i, theta_o, phi_o, 450nm, 550nm\n"
        "30,0,40,180,1,2\n30,90,40,270,3,4\n30,0,140,180,5,6\n");
    const MeasuredInfo& info = m->info();
    EXPECT_EQ(info.description, "blind, both ways");
    EXPECT_FALSE(info.isotropic);
    EXPECT_TRUE(info.reflection_front && info.transmission_front);
    EXPECT_FALSE(info.reflection_back || info.transmission_back);
    EXPECT_EQ(info.wavelengths, (std::vector<double>{450., 550.}));
    EXPECT_EQ(value_at(*m, towards(30., 0.), towards(40., 180.)), (std::vector<double>{1., 2.}));
    EXPECT_EQ(value_at(*m, towards(30., 90.), towards(40., 270.)), (std::vector<double>{3., 4.}));
    EXPECT_EQ(value_at(*m, towards(30., 0.), towards(140., 180.)), (std::vector<double>{5., 6.}));
}

/// Each file is of one format and no other.
TEST(TextReaders, FormatsAreToldApart) {
    test::MadeKlems klems;
    std::string numbers;
    for (int i = 0; i < 25; ++i) numbers += "1 ";
    klems.blocks = {{"Reflection Front", numbers}};
    const std::pair<const char*, std::string> files[] = {
        {"cornell", "# num wls\n2\n400 500\n0.5 0 0.2 3 1 2\n"},
        {"cornell", "2\n400 500\n0.5 0 0.2 3 1 2\n"},  // without a word about it
        {"cornell", "# paint\r\n1 550\r\n0.5 0 0.2 3 1\r\n"},
        {"alta", "# a slice\n#DIM 1 1\n#PARAM_IN COS_TH\n1 5\n"},
        {"alta", "#PARAM_IN COS_TH\n#PARAM_OUT INV_STERADIAN\n#DIM 1 1\n1 5\n"},
        {"astm", "ASTM E 1392-90\nVARS theta_i,phi_i,theta_s,phi_s,Y\n0.5,0,0.2,3,1\n"},
        {"astm",
         "MATERIAL paint\nNUM_POINTS 1\nVARS theta_i,phi_i,theta_s,phi_s,Y\n0.5,0,0.2,3,1\n"},
        {"csv", "\xef\xbb\xbf# table\n\ntheta_i,phi_i,theta_o,phi_o,y\n30,0,40,180,1\n"},
        {"klems", klems.text()},
        {"rgl", test::MadeRgl().file().bytes()}};
    for (const auto& [name, bytes] : files) {
        const FileStart start{std::string_view(bytes).substr(0, FileStart::length), bytes.size()};
        for (const MeasuredFormat* format : measured_formats())
            EXPECT_EQ(format->recognise(start), format->name == name)
                << name << " " << format->name;
        EXPECT_EQ(parsed(bytes)->info().format, name);
    }
}

}  // namespace nacre
