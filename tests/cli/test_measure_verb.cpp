// nacre measure: surfaces by name and from scenes, its files, going on, and what it refuses.
#include <nlohmann/json.hpp>

#include "nacre/measured/formats.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

using nlohmann::json;
using test::CommandLine;
using test::Outcome;

/// A flat square of two units.
constexpr const char* flat_scene = R"(<scene version="3.0.0">
    <default name="albedo" value="0.5"/>
    <shape type="rectangle">
        <bsdf type="diffuse"><rgb name="reflectance" value="$albedo, 0.25, 0"/></bsdf>
    </shape>
</scene>
)";

class MeasureVerb : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        if (!folder_.empty()) std::ofstream(folder_ / "flat.xml") << flat_scene;
    }
    json measurement(const std::string& name) const { return json::parse(read(folder_ / name)); }
};

}  // namespace

TEST_F(MeasureVerb, ASceneIsAPeriodOfASurface) {
    const Outcome r = nacre(
        "measure flat.xml -D albedo=0.75 --theta 20,50 --noise 10% --bins 4x4 "
        "--quiet -o m.json");
    ASSERT_EQ(r.code, 0) << r.err;
    const json m = measurement("m.json");
    EXPECT_EQ(m["complete"], true);
    ASSERT_EQ(m["incidences"].size(), 2u);
    for (const json& i : m["incidences"]) {
        EXPECT_NEAR(i["reflected"][0].get<double>(), 0.75, 1e-5);
        EXPECT_NEAR(i["reflected"][1].get<double>(), 0.25, 1e-5);
        EXPECT_EQ(i["reflected"][2], 0.);
        EXPECT_EQ(i["brdf"].size(), 16u);
    }
    EXPECT_EQ(m["incidences"][1]["theta"], json({50., 50.}));
}

TEST_F(MeasureVerb, TablesHaveOneRowABinAndIncidence) {
    const Outcome r = nacre(
        "measure 'v_grooves angle=45' --material mirror --orders 1 --phi 0,90 "
        "--theta 20 --noise 10% --bins 3x4 -o m.csv");
    ASSERT_EQ(r.code, 0) << r.err;
    const std::string text = read(folder_ / "m.csv");
    EXPECT_NE(text.find("# material: mirror\n"), std::string::npos) << text;
    const std::size_t names = text.find("theta_i,phi_i,theta_o,phi_o,r,g,b\n");
    ASSERT_NE(names, std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin() + names, text.end(), '\n'), 1 + 2 * 12);
    EXPECT_NE(text.find("\n20,90,15,45,"), std::string::npos) << text;
    const std::string errors = read(folder_ / "m.error.csv");
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'),
              std::count(text.begin(), text.end(), '\n'));
    EXPECT_NE(r.out.find("blocked"), std::string::npos);
}

// What is measured is a measured BRDF like any other, through the cloth too.
TEST_F(MeasureVerb, TablesAreReadAsMeasuredData) {
    ASSERT_EQ(nacre("measure 'weave warp=0.5 weft=0.5 pieces=16' --material 'lambert "
                    "reflectance=0.8,0.4,0.2' --full --turned --bins 4x8 --noise 50% --rays 16384 "
                    "--quiet -o cloth.csv")
                  .code,
              0);
    const std::unique_ptr<Measured> cloth = read_measured(folder_ / "cloth.csv");
    EXPECT_EQ(cloth->info().channels, 3);
    EXPECT_TRUE(cloth->info().transmission_front);
    double f[3];
    const Vec3d wi = normalize(Vec3d{0.2, 0., 1.});
    ASSERT_TRUE(cloth->eval(wi, normalize(Vec3d{-0.5, 0.4, 1.}), f));
    EXPECT_GT(f[0], 1.5 * f[1]);
    EXPECT_LT(f[0], 0.8);
    const Outcome r = nacre("data info cloth.csv");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("csv"), std::string::npos) << r.out;
}

TEST_F(MeasureVerb, GoesOnWithTheSameRays) {
    const std::string rest = " cylinders --theta 30 --bins 4x4 --quiet ";
    ASSERT_EQ(nacre("measure" + rest + "--noise 0.1% --rays 8192 -o once.json").code, 0);
    ASSERT_EQ(nacre("measure" + rest + "--noise 0.1% --rays 4096 -o twice.json").code, 0);
    EXPECT_NE(read(folder_ / "once.json"), read(folder_ / "twice.json"));
    ASSERT_EQ(nacre("measure" + rest + "--noise 0.1% --rays 8192 -o twice.json --resume").code, 0);
    EXPECT_EQ(read(folder_ / "once.json"), read(folder_ / "twice.json"));
    // Threads change nothing.
    ASSERT_EQ(nacre("measure" + rest + "--noise 0.1% --rays 8192 -t 3 -o three.json").code, 0);
    EXPECT_EQ(read(folder_ / "once.json"), read(folder_ / "three.json"));
    const Outcome other = nacre("measure" + rest + "--seed 1 --rays 8192 -o once.json --resume");
    EXPECT_EQ(other.code, 2);
    EXPECT_EQ(other.err, "nacre: once.json is of another measurement: its seed is 0, not 1\n");
}

TEST_F(MeasureVerb, InterruptedItKeepsWhatItHas) {
    const pid_t child = start({"measure", "cylinders", "--noise", "0.01%", "--bins", "6x6",
                               "--theta", "10,20", "-o", "m.json"},
                              "log");
    wait_for("log", "rays");
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 130);
    const json m = measurement("m.json");
    EXPECT_EQ(m["complete"], false);
    EXPECT_GT(m["incidences"][0]["rays"], 0);
    EXPECT_EQ(m["incidences"][1]["rays"], 0);
    EXPECT_FALSE(m["incidences"][1].contains("brdf"));
}

TEST_F(MeasureVerb, OneWavelengthOfASpectrum) {
    const Outcome r = nacre(
        "measure flat --material 'lambert reflectance=0.8,0.1,0.1' --lambda 650 "
        "--theta 0 --bins 2x2 --noise 10% -o m.json");
    ASSERT_EQ(r.code, 0) << r.err;
    const json m = measurement("m.json");
    EXPECT_EQ(m["lanes"], json({"650nm"}));
    EXPECT_GT(m["incidences"][0]["reflected"][0], 0.5);
}

TEST_F(MeasureVerb, RefusesExactly) {
    std::ofstream(folder_ / "wall.xml") <<
        R"(<scene version="3.0.0"><shape type="rectangle">
        <transform name="to_world"><rotate x="1" angle="90"/></transform></shape></scene>)";
    std::ofstream(folder_ / "odd.json") << "{\"format\": 3}";
    std::ofstream(folder_ / "other.json") << "{\"format\": \"picture\"}";
    const auto file = [&](const char* name, int bins) {
        std::ofstream(folder_ / name) << fmt::format(
            R"({{"format": "nacre measurement 1", "complete": true, "facts": {{}}, "lanes": ["r"],
            "bins": [{0}, {0}], "incidences": [{{"rays": 1, "sums": {{"incidence": [0, 0, 0, 0],
            "shares": [], "bins": [0, 0, 0]}}}}]}})",
            bins);
    };
    file("short.json", 2);
    file("many.json", 100'000);
    const std::pair<const char*, const char*> wrong[] = {
        {"measure velvet", "unknown microgeometry 'velvet'"},
        {"measure 'v_grooves angle=95'",
         "v_grooves: angle = 95 is out of range: must lie within [0, 89]"},
        {"measure 'v_grooves angle=30 m=0.2'",
         "v_grooves: give either angle, for grooves that are alike, or m"},
        {"measure 'gaussian points=64'",
         "gaussian: 64 points do not resolve 24 correlation lengths: at least 96, or fewer "
         "lengths"},
        {"measure flat --material velvet", "unknown material 'velvet'"},
        {"measure flat --material 'mirror ks=1'", "mirror: unknown parameter 'ks'; it has none"},
        {"measure flat.xml --material mirror",
         "--material is for generated surfaces: a scene says what it is made of"},
        {"measure flat --tile 0,0,1,1",
         "--tile is for scenes: generated surfaces have a period of their own"},
        {"measure flat.xml --tile 0,0,1",
         "--tile: '0,0,1' is not x,y,width,height, with a width and a height above 0"},
        {"measure flat.xml --tile 0,0,1,0",
         "--tile: '0,0,1,0' is not x,y,width,height, with a width and a height above 0"},
        {"measure wall.xml", "has no area: its mean normal is +z, the tile lies in x and y"},
        {"measure flat --theta 90", "--theta: '90' is not a number from 0 to 90 (and less)"},
        {"measure flat --phi x", "--phi: 'x' is not a number from -360 to 360"},
        {"measure flat --bins 18",
         "--bins: '18' is not of the form POLARxAROUND, 18x36, each from 1 to 1000"},
        {"measure flat --bins 0x4",
         "--bins: '0x4' is not of the form POLARxAROUND, 18x36, each from 1 to 1000"},
        {"measure flat --full --theta 10",
         "--full takes light from all bins: leave out --theta and --phi"},
        {"measure flat --full --bins 100x200",
         "20000 incidences of 100x200 bins take 51 GB: fewer bins, --turned, or parts of them"},
        {"measure flat -o m.exr", "-o 'm.exr': a measurement is a .csv or a .json"},
        {"measure flat --resume", "--resume needs -o FILE.json, the measurement that goes on"},
        {"measure flat --resume -o other.json",
         "other.json: this is no measurement of 'nacre measure'"},
        {"measure flat --resume -o odd.json", "odd.json: "},
        {"measure flat --resume -o short.json", "short.json: 3 sums stand where 4 bins need 8"},
        {"measure flat --resume -o many.json", "many.json: 100000 by 100000 bins are impossible"},
    };
    for (const auto& [arguments, expected] : wrong) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_NE(r.err.find(expected), std::string::npos) << arguments << "\n" << r.err;
    }
}

}  // namespace nacre
