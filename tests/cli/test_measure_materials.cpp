// nacre measure through glass and media, of materials that were measured before, and as real
// instruments see it.
#include <nlohmann/json.hpp>

#include <cmath>

#include "nacre/goniometer/hemisphere_bins.h"
#include "nacre/measured/formats.h"
#include "nacre/optics/fresnel.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

using nlohmann::json;
using test::CommandLine;
using test::Outcome;

class MeasureMaterials : public CommandLine {
  protected:
    json measured(const std::string& arguments) const {
        const Outcome r = nacre("measure " + arguments + " --quiet -o m.json");
        EXPECT_EQ(r.code, 0) << arguments << "\n" << r.err;
        return r.code == 0 ? json::parse(read(folder_ / "m.json")) : json();
    }
    void write(const char* name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }
    /// A plate one thick and wider than the tile of two by two.
    void write_plate(const char* name, const std::string& bsdf, const std::string& medium) const {
        write(name, R"(<scene version="3.0.0"><shape type="cube"><transform name="to_world">
            <scale x="3" y="3" z="0.5"/></transform><bsdf )" +
                        bsdf + "</bsdf>" + medium + "</shape></scene>");
    }
    static std::string near(const json& i, const char* share, int lane, double expected) {
        const double found = i[share][lane], error = i[std::string(share) + "_error"][lane];
        return std::abs(found - expected) <= 4. * error + 1e-6
                   ? ""
                   : fmt::format("{} {}: {} +- {}, not {}", share, lane, found, error, expected);
    }
};

constexpr const char* tile = " --tile -1,-1,2,2 --bins 4x4 --noise 0.01% --rays 100000 ";

std::string homogeneous(const char* sigma_t, const char* albedo) {
    return fmt::format(
        R"(<medium name="interior" type="homogeneous"><rgb name="sigma_t" value="{}"/>
        <rgb name="albedo" value="{}"/></medium>)",
        sigma_t, albedo);
}

}  // namespace

// What is reflected between both sides and absorbed on each way, summed.
TEST_F(MeasureMaterials, AGlassPlateIsFresnelsSlab) {
    write_plate("plate.xml",
                R"(type="dielectric"><float name="int_ior" value="1.5"/>
                <float name="ext_ior" value="1"/>)",
                homogeneous("0, 0.5, 2", "0, 0, 0"));
    const json m = measured(std::string("plate.xml --theta 0,50,80 --phi 30") + tile);
    const double sigma[3] = {0., 0.5, 2.};
    for (const json& i : m["incidences"]) {
        const double theta = i["theta"][0].get<double>() * std::numbers::pi / 180.;
        const double inside = std::sqrt(1. - std::pow(std::sin(theta) / 1.5, 2));
        const double r = fresnel_dielectric(std::cos(theta), 1.5);
        for (int k = 0; k < 3; ++k) {
            const double a = std::exp(-sigma[k] / inside), gone = 1. - r * r * a * a;
            EXPECT_EQ(near(i, "reflected", k, r + (1. - r) * (1. - r) * r * a * a / gone), "");
            EXPECT_EQ(near(i, "transmitted", k, (1. - r) * (1. - r) * a / gone), "");
        }
        // Polarisation aside: each reflection is that of unpolarised light.
        EXPECT_EQ(i["lost"][0], 0.);
    }
    // It goes straight on: all of it in the bin of -wi.
    int bins = 0;
    for (const json& b : m["incidences"][1]["btdf"]) bins += b[0] > 0.;
    EXPECT_EQ(bins, 1);
}

TEST_F(MeasureMaterials, ThinGlassIsItsClosedForm) {
    const json m = measured(
        "flat --material 'thindielectric int_ior=1.5 ext_ior=1' --theta 60 --bins 4x4 "
        "--noise 0.01% --rays 100000");
    const double r = fresnel_dielectric(0.5, 1.5);
    EXPECT_EQ(near(m["incidences"][0], "reflected", 0, 2. * r / (1. + r)), "");
    EXPECT_EQ(near(m["incidences"][0], "transmitted", 0, (1. - r) / (1. + r)), "");
}

// Nothing is lost between rough glass and bright media.
TEST_F(MeasureMaterials, WhiteFurnacesThatTransmit) {
    write_plate("milk.xml", R"(type="dielectric"><float name="int_ior" value="1.33"/>)",
                homogeneous("1, 3, 6", "1, 1, 1"));
    write("clear.xml", R"(<scene version="3.0.0"><shape type="sphere">
        <bsdf type="dielectric"/></shape></scene>)");
    for (const std::string& text :
         {std::string("gaussian points=64 lengths=8 alpha=0.6 --material dielectric"),
          std::string("fractal points=64 shortest=8 --material 'thindielectric'"),
          std::string("weave pieces=12 --material dielectric"), std::string("clear.xml"),
          std::string("milk.xml --tile -1,-1,2,2")}) {
        const std::size_t options = text.find(" --");
        const std::string surface = text.substr(0, options);
        const json m =
            measured("'" + surface + "'" + (options == text.npos ? "" : text.substr(options)) +
                     " --theta 40 --bins 4x4 --noise 0.01% --rays 20000");
        for (int k = 0; k < 3; ++k) {
            const json& i = m["incidences"][0];
            const double r = i["reflected"][k], t = i["transmitted"][k];
            const double error = i["reflected_error"][k], other = i["transmitted_error"][k];
            EXPECT_NEAR(r + t, 1., 4. * std::min(error + other, 0.01) + 1e-5) << text << " " << k;
            EXPECT_GT(t, 0.05) << text;
        }
    }
}

// Isotropic scattering without boundary: half of what collides once goes to either side of a thin
// layer, and e^-tau passes as it came.
TEST_F(MeasureMaterials, AThinCloudScattersOnce) {
    write_plate("cloud.xml", R"(type="null">)", homogeneous("0.01, 0.02, 0.04", "1, 0.5, 0"));
    const json m = measured(std::string("cloud.xml --theta 0 --orders 1") + tile);
    const json& i = m["incidences"][0];
    const double tau[3] = {0.01, 0.02, 0.04}, albedo[3] = {1., 0.5, 0.};
    for (int k = 0; k < 3; ++k) {
        // Reflected once: the integral over depth z and cosines of the light that comes back to the
        // top, albedo / 2 (1 - ...); by quadrature.
        double once = 0.;
        const int n = 400;
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                const double z = tau[k] * (a + 0.5) / n, mu = (b + 0.5) / n;
                once += tau[k] * std::exp(-z - z / mu) * 0.5 * albedo[k] / (n * n);
            }
        EXPECT_EQ(near(i, "reflected", k, once), "");
    }
}

TEST_F(MeasureMaterials, MediaThatAreNotFollowed) {
    write("half.xml",
          R"(<scene version="3.0.0"><shape type="rectangle"><bsdf type="dielectric"/>)" +
              homogeneous("1, 1, 1", "0, 0, 0") + "</shape></scene>");
    write_plate("fog.xml", R"(type="null">)",
                R"(<medium name="interior" type="heterogeneous"><volume name="sigma_t"
                type="gridvolume"><string name="filename" value="fog.vol"/></volume></medium>)");
    std::ofstream vol(folder_ / "fog.vol", std::ios::binary);
    const std::int32_t head[5] = {1, 2, 2, 2, 1};
    const float box[6] = {-3, -3, -0.5, 3, 3, 0.5}, values[8] = {1, 1, 1, 1, 0, 0, 0, 0};
    vol.write("VOL\3", 4);
    vol.write(reinterpret_cast<const char*>(head), sizeof head);
    vol.write(reinterpret_cast<const char*>(box), sizeof box);
    vol.write(reinterpret_cast<const char*>(values), sizeof values);
    vol.close();
    write("prism.xml", R"(<scene version="3.0.0"><shape type="cube"><bsdf type="dielectric">
        <string name="int_ior" value="sf11"/></bsdf></shape></scene>)");
    const std::pair<const char*, const char*> wrong[] = {
        {"half.xml",
         "light leaves the patch within the medium of 'rectangle': close its shape, so that the "
         "medium ends at a surface"},
        {"fog.xml", "varies in space; light is followed through homogeneous media only"},
        {"flat --material dielectrc", "unknown material 'dielectrc'; did you mean 'dielectric'?"},
        {"flat --material none.csv", "--material: cannot find the file 'none.csv'"},
        {"flat --material 'dielectric int_iro=1.5'",
         "--material: <bsdf type=\"dielectric\"> has no parameter 'int_iro'; did you mean "
         "'int_ior'?"},
        {"flat --material 'measured filename=none.csv'",
         "--material: cannot find 'none.csv'; searched in: ."},
        {"flat --instrument fo", "unknown instrument 'fo'; did you mean 'foo'?"},
        {"flat --phi 0,90 --instrument foo",
         "the instrument foo measures at one azimuth of incidence: isotropic surfaces, --turned; "
         "or isotropic=no"},
    };
    for (const auto& [arguments, expected] : wrong) {
        const Outcome r = nacre(std::string("measure --bins 2x2 --rays 4096 ") + arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_NE(r.err.find(expected), std::string::npos) << arguments << "\n" << r.err;
    }
}

// Grooves whose sides are finely grooved themselves, once as one surface and once in two steps. The
// table's bins of 15 by 30 degrees and its noise are the error: 3 % of the light in a bin of the
// second step, and of all light what rays say and half a percent.
TEST_F(MeasureMaterials, TwoScalesAreOne) {
    constexpr double coarse = 25., fine = 35.;
    const double a = coarse * std::numbers::pi / 180., b = fine * std::numbers::pi / 180.;
    constexpr int pieces = 40;
    std::vector<Vec2<double>> points;
    for (const double side : {-1., 1.}) {
        const Vec2<double> along{std::cos(a), side * std::sin(a)}, up{-along.y, along.x};
        const Vec2<double> from{side < 0. ? 0. : 0.5, side < 0. ? 0. : -0.5 * std::tan(a)};
        const double width = 0.5 / std::cos(a) / pieces;
        for (int i = 0; i < 2 * pieces; ++i) {
            const double t = 0.5 * width * i, down = i % 2 == 0 ? 0. : 0.5 * width * std::tan(b);
            points.push_back(from + along * t - up * down);
        }
    }
    points.push_back({1., 0.});
    points.push_back({1. + points[1].x, points[1].y});
    points.insert(points.begin(), {points[std::size_t(4 * pieces - 1)].x - 1.,
                                   points[std::size_t(4 * pieces - 1)].y});
    std::string obj;
    for (const Vec2<double>& p : points)
        for (const double x : {-0.1, 1.1}) obj += fmt::format("v {} {:.9f} {:.9f}\n", x, p.x, p.y);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        obj += fmt::format("f {} {} {} {}\n", 2 * i + 1, 2 * i + 2, 2 * i + 4, 2 * i + 3);
    write("both.obj", obj);
    write("both.xml", R"(<scene version="3.0.0"><shape type="obj">
        <string name="filename" value="both.obj"/><boolean name="face_normals" value="true"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.7, 0.7"/></bsdf></shape></scene>)");
    ASSERT_EQ(nacre(fmt::format("measure 'v_grooves angle={}' --material 'lambert reflectance=0.7' "
                                "--full --bins 6x12 --noise 4% --rays 20000 --quiet -o fine.csv",
                                fine))
                  .code,
              0);
    const std::string how = " --theta 20,65 --phi 0,90 --bins 4x6 --noise 0.5% --rays 40000";
    const json one = measured("both.xml --tile 0,0,1,1" + how);
    const json two =
        measured(fmt::format("'v_grooves angle={}' --material fine.csv", coarse) + how);
    // What is measured is part of the file's facts, so that --resume sees another table.
    EXPECT_TRUE(two["facts"].contains("file fine.csv")) << two["facts"];
    const HemisphereBins bins{4, 6};
    for (std::size_t n = 0; n < 4; ++n) {
        const json &i = one["incidences"][n], &j = two["incidences"][n];
        EXPECT_NEAR(i["reflected"][0].get<double>(), j["reflected"][0].get<double>(),
                    0.005 + 4. * std::hypot(i["reflected_error"][0].get<double>(),
                                            j["reflected_error"][0].get<double>()))
            << n;
        double difference = 0., noise = 0., light = 0.;
        for (std::size_t k = 0; k < 24; ++k) {
            const double cosine = bins.cell(k).projected_solid_angle();
            difference +=
                cosine * std::abs(i["brdf"][k][0].get<double>() - j["brdf"][k][0].get<double>());
            noise += cosine * std::hypot(i["brdf_error"][k][0].get<double>(),
                                         j["brdf_error"][k][0].get<double>());
            light += cosine * i["brdf"][k][0].get<double>();
        }
        EXPECT_LT(difference / light, 0.03 + noise / light) << n;
        // The coarse grooves alone are another surface.
        EXPECT_LT(j["reflected"][0].get<double>(), 0.68);
    }
}

TEST_F(MeasureMaterials, InstrumentsReportBesideTheTruth) {
    const std::string arguments =
        "measure 'flat' --material 'lambert reflectance=0.5' --theta 10,84 --bins 9x18 --noise 5% "
        "--instrument 'cornell detector=2' -o m.csv";
    const Outcome r = nacre(arguments);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("as the instrument cornell reads it"), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("no light from there"), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("bins of 20 degrees are wider than its cones"), std::string::npos);
    const std::string text = read(folder_ / "m.cornell.csv");
    EXPECT_NE(text.find("as the instrument 'cornell detector=2' would have reported"),
              std::string::npos);
    EXPECT_NE(text.find("\n84,0,5,10,nan,nan,nan\n"), std::string::npos) << text;
    const std::unique_ptr<Measured> table = read_measured(folder_ / "m.cornell.csv");
    EXPECT_EQ(table->info().samples, 2u * 9u * 18u);
    EXPECT_GT(table->info().missing, 9u * 18u);
    EXPECT_NE(nacre("models show ward_instrument").out.find("half-silvered"), std::string::npos);
    ASSERT_EQ(nacre(arguments).code, 0);
    EXPECT_EQ(text, read(folder_ / "m.cornell.csv"));
}

}  // namespace nacre
