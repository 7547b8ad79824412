// nacre data: measured files from the command line.
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.h"

namespace nacre {
namespace {

class DataVerb : public test::CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        if (IsSkipped()) return;
        std::ofstream(folder_ / "paint.txt")
            << "# blue paint\n# num wls\n2\n400 700\n0.5 0 0.25 3.0 0.1 0.2\n0.5 0 0.25 2.0 -0.1 "
               "0.2\n";
        std::ofstream(folder_ / "page.bsdf") << "<html><body>404</body></html>";
    }
};

}  // namespace

TEST_F(DataVerb, InfoSaysWhatAFileHolds) {
    const std::string text =
        "file: paint.txt\n"
        "kind: measured reflectance\n"
        "format: Cornell\n"
        "description: blue paint\n"
        "channels: 2 wavelengths, 400 to 700 nm\n"
        "wavelengths: [400.0,700.0]\n"
        "parameterisation: scattered directions theta_i, phi_i, theta_s, phi_s\n"
        "isotropic: true\n"
        "stored: BSDF\n"
        "scale: none: sr^-1\n"
        "sides:\n"
        "  - reflection front\n"
        "samples: 2\n"
        "missing: 0\n"
        "negative: 1\n"
        "largest_incidence: 28.6\n"
        "largest_exit: 14.3\n";
    EXPECT_EQ(nacre("data info paint.txt").out, text);
    // `info` knows what it is by its content, too.
    EXPECT_EQ(nacre("info paint.txt").out, text);
    const auto json = nlohmann::json::parse(nacre("data info paint.txt --json").out);
    EXPECT_EQ(json["format"], "Cornell");
    EXPECT_EQ(json["negative"], 1);
    EXPECT_EQ(json["wavelengths"], nlohmann::json::array({400., 700.}));
}

TEST_F(DataVerb, RefusesWhatIsNoData) {
    const std::string page =
        "nacre: page.bsdf: holds no measured reflectance that can be read (MERL, RGL, Klems XML, "
        "Cornell, ALTA, ASTM E1392, CSV): it is a web page, saved instead of the data; fetch the "
        "file itself\n";
    const std::pair<const char*, std::string> cases[] = {
        {"data",
         "nacre: say what to do with the data: nacre data info FILE, audit, convert, eval\n"},
        {"data info", "nacre: file is required; see 'nacre help data'\n"},
        {"data info page.bsdf", page},
        {"info page.bsdf", page},
        {"data info none.bsdf", "nacre: none.bsdf: cannot be read; check the name\n"},
        {"info none.bsdf", "nacre: none.bsdf: cannot be read; check the name\n"},
    };
    for (const auto& [arguments, message] : cases) {
        const test::Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, message) << arguments;
        EXPECT_EQ(r.out, "") << arguments;
    }
}

/// Models are fitted to a file of any format.
TEST_F(DataVerb, OtherFormatsAreTargetsOfFits) {
    std::ofstream table(folder_ / "lambert.csv");
    table << "theta_i,phi_i,theta_o,phi_o,r,g,b\n";
    for (int i = 0; i <= 80; i += 10)
        for (int o = 0; o <= 80; o += 10)
            for (int p = 0; p < 360; p += 30)
                table << fmt::format("{},0,{},{},0.1,0.05,0.2\n", i, o, p);
    table.close();
    const test::Outcome r =
        nacre("compare --models lambert --fit-to lambert.csv -o report --quiet");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto report = nlohmann::json::parse(read(folder_ / "report/report.json"));
    const std::string text = report["rows"][0].dump();
    // pi times the BRDF.
    EXPECT_NE(text.find("reflectance=0.314159,0.15708,0.628319"), std::string::npos) << text;
}

TEST_F(DataVerb, EvalAsksAtDirections) {
    std::string table = "theta_i,phi_i,theta_o,phi_o,r,g,b\n";
    for (int i = 0; i <= 60; i += 20)
        for (int o = 0; o <= 60; o += 20)
            for (int phi = 0; phi <= 180; phi += 60)
                table += fmt::format("{},0,{},{},0.3,0.2,0.1\n", i, o, phi);
    std::ofstream(folder_ / "matte.csv") << table;
    EXPECT_EQ(nacre("data eval matte.csv --wi 0,0,2 --wo 0.6,0,0.8").out, "r,g,b\n0.3,0.2,0.1\n");
    // Beyond what was measured the data say nothing, and a renderer holds the last value.
    std::ofstream(folder_ / "pairs.csv") << "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0,0,1,0,0,1\n"
                                            "0.6,0,0.8,-0.96,0,0.28\n# below\n0,0,1,0,0,-1\n";
    EXPECT_EQ(nacre("data eval matte.csv --pairs pairs.csv").out,
              "r,g,b\n0.3,0.2,0.1\nnan,nan,nan\nnan,nan,nan\n");
    nacre("data eval matte.csv --pairs pairs.csv --rendered -o seen.csv");
    std::ifstream file(folder_ / "seen.csv");
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "r,g,b,pdf");
    const double cosines[] = {1., 0.8, 0.};
    for (const double cosine : cosines) {
        std::getline(file, line);
        double v[4] = {};
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", v, v + 1, v + 2, v + 3), 4) << line;
        EXPECT_NEAR(v[0], 0.3 * cosine, 1e-6);
        EXPECT_NEAR(v[2], 0.1 * cosine, 1e-6);
        EXPECT_EQ(v[3] > 0., cosine > 0.);
    }
    const std::string where = "nacre: say where: --wi and --wo, or --pairs FILE\n";
    const std::pair<const char*, std::string> wrong[] = {
        {"", where},
        {" --wi 0,0,1", where},
        {" --wi 0,0,1 --wo 0,0,1 --pairs pairs.csv", where},
        {" --wi 0,0 --wo 0,0,1",
         "nacre: --wi '0,0' is not a direction; write x,y,z, such as 0.6,0,0.8\n"},
        {" --pairs none.csv", "nacre: none.csv: cannot be read; check the name\n"},
        {" --pairs page.bsdf",
         "nacre: page.bsdf, line 1: two directions are expected, wi_x,wi_y,wi_z,wo_x,wo_y,wo_z; "
         "got "
         "'<html><body>404</body></html>'\n"},
        {" --pairs pairs.csv -o matte.csv",
         "nacre: matte.csv: is read as well: it would be overwritten; name another output by "
         "-o\n"}};
    for (const auto& [arguments, message] : wrong) {
        const auto r = nacre(std::string("data eval matte.csv") + arguments);
        EXPECT_EQ(r.err, message);
        EXPECT_EQ(r.code, 2) << arguments;
    }
}

TEST_F(DataVerb, ConvertWritesOtherFormats) {
    const auto r = nacre("data convert 'lambert reflectance=0.6,0.3,0.1' -o wall.bsdf --json");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto json = nlohmann::json::parse(r.out);
    EXPECT_EQ(json["format"], "rgl");
    EXPECT_EQ(json["bytes"], std::filesystem::file_size(folder_ / "wall.bsdf"));
    EXPECT_EQ(json["lost"], nlohmann::json::array());
    ASSERT_EQ(json["errors"].size(), 3u);
    EXPECT_LT(json["errors"][0]["mean"], 0.01);
    EXPECT_EQ(nlohmann::json::parse(nacre("data info wall.bsdf --json").out)["format"], "RGL");

    // By --to, whatever the name ends in; wavelengths of a model and of a file.
    EXPECT_EQ(nacre("data convert lambert --to csv -o wall.txt --wavelengths 400..700/100").code,
              0);
    EXPECT_NE(read(folder_ / "wall.txt").find("theta_i,phi_i,theta_o,phi_o,400,500,600,700\n"),
              std::string::npos);
    const auto paint = nacre("data convert paint.txt -o paint.csv --rgb");
    EXPECT_NE(paint.out.find("lost: 2 wavelengths: red, green and blue under D65 are written\n"),
              std::string::npos)
        << paint.out;
    EXPECT_NE(read(folder_ / "paint.csv").find("# blue paint\ntheta_i,phi_i,theta_o,phi_o,r,g,b\n"),
              std::string::npos);
    const auto mirror = nacre("data convert he_torrance -o he.csv");
    EXPECT_NE(mirror.out.find("lost: what the model mirrors without blur"), std::string::npos)
        << mirror.out << mirror.err;
}

TEST_F(DataVerb, ConvertRefusesAndWritesNothing) {
    const std::pair<const char*, std::string> cases[] = {
        {"lambert", "nacre: say where to: -o FILE\n"},
        {"lambert -o x.abc",
         "nacre: x.abc: the ending says no format that can be written (.binary, .bsdf, .alta, "
         ".csv); say --to merl, rgl, alta, csv\n"},
        {"lambert -o x.xml --to klems",
         "nacre: --to klems: Klems XML cannot be written; known are merl, rgl, alta, csv\n"},
        {"lambert -o x.csv --to cvs",
         "nacre: unknown format of measured reflectance 'cvs'; did you mean 'csv'?\n"},
        {"paint.txt --to csv -o paint.txt",
         "nacre: paint.txt: is read as well: it would be overwritten; name another output by -o\n"},
        {"paint.txt -o x.csv --wavelengths 400,500",
         "nacre: --wavelengths is for models; paint.txt has wavelengths of its own\n"},
        {"lambert -o x.csv --wavelengths 400..700",
         "nacre: --wavelengths '400..700': write 400,500,600, or 400..700/10 for steps of 10 nm\n"},
        {"lambert -o x.csv --step 40", "nacre: --step: '40' is not a number from 1 to 15\n"},
        {"'ward alpha_u=0.1 alpha_v=0.4' -o x.binary",
         "nacre: MERL holds isotropic surfaces, and this one is anisotropic; --isotropic writes "
         "its "
         "mean over turns about the normal\n"},
        {"lambert -o x.binary --resolution 16",
         "nacre: --resolution is for RGL; MERL has no use for it\n"},
        {"lambert -o x.bsdf --step 5",
         "nacre: --step is for text formats; RGL has no use for it\n"},
        {"none.bsdf -o x.csv", "nacre: none.bsdf: cannot be read; check the name\n"},
    };
    for (const auto& [arguments, message] : cases) {
        const test::Outcome r = nacre(std::string("data convert ") + arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, message) << arguments;
        EXPECT_EQ(r.out, "") << arguments;
        for (const char* file : {"x.abc", "x.xml", "x.csv", "x.binary", "x.bsdf"})
            EXPECT_FALSE(std::filesystem::exists(folder_ / file)) << arguments;
    }
    EXPECT_EQ(read(folder_ / "paint.txt").substr(0, 12), "# blue paint");
}

/// What nacre factor writes is taken wherever a measured file is.
TEST_F(DataVerb, FoldersOfFactorsAreData) {
    ASSERT_EQ(nacre("factor 'lambert kd=0.3' -R 6 -J 1 -o wall").code, 0);
    const auto info = nacre("data info wall --json");
    ASSERT_EQ(info.code, 0) << info.err;
    EXPECT_EQ(nlohmann::json::parse(info.out)["samples"], 36 * 36);
    EXPECT_EQ(nacre("data eval wall --wi 0,0.6,0.8 --wo 0,0,1").out.substr(0, 14),
              "r,g,b\n0.095492");
    const auto audit = nacre("data audit wall --json");
    ASSERT_EQ(audit.code, 0) << audit.err;
    EXPECT_NEAR(nlohmann::json::parse(audit.out)["albedo"][0]["reflected"][1].get<double>(), 0.3,
                1e-3);
    const auto measured =
        nacre("measure flat --material wall --bins 4x4 --noise 1% --quiet -o m.json");
    ASSERT_EQ(measured.code, 0) << measured.err;
    EXPECT_NE(read(folder_ / "m.json").find("g01.exr"), std::string::npos);
    // What is refused leaves no folder.
    for (const char* refused :
         {"data audit none.csv -o out", "fit 'lambert kd=0' --model ward -o out",
          "factor lambert none.binary -R 6 -o out"}) {
        EXPECT_EQ(nacre(refused).code, 2) << refused;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << refused;
    }
}

TEST_F(DataVerb, AuditSaysWhatCanBeTrusted) {
    std::ofstream table(folder_ / "wall.csv");
    table << "theta_i,phi_i,theta_o,phi_o,r,g,b\n";
    for (int i = 0; i <= 80; i += 10)
        for (int o = 0; o <= 80; o += 10)
            for (int p = 0; p <= 180; p += 30)
                table << fmt::format("{},0,{},{},{},0.05,0.1\n", i, o, p,
                                     i == 30 && o == 20 && p == 60 ? 0.9 : 0.1);
    table.close();
    const std::string text = nacre("data audit wall.csv").out;
    for (const char* line :
         {"format: CSV\n", "  mean: 0.0838", "doubtful:\n", "trusted:\n",
          "  - 1 of 567 samples lie far from their neighbours, by error or because a highlight is "
          "narrower than the samples are apart; the farthest, 0.35 among 0.0833 sr^-1, at theta_i "
          "30.0, theta_o 20.0, phi 60.0 degrees\n",
          "  - no value is negative\n"})
        EXPECT_NE(text.find(line), std::string::npos) << line << text;
    const auto r = nacre("data audit wall.csv --json -o audit");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto json = nlohmann::json::parse(r.out);
    EXPECT_EQ(json["outliers"]["count"], 1);
    EXPECT_EQ(json["albedo"].size(), 18u);
    EXPECT_NEAR(json["albedo"][0]["reflected"][1].get<double>(), 3.14159265 * 0.05 * 0.9924, 1e-3);
    EXPECT_EQ(json, nlohmann::json::parse(read(folder_ / "audit/audit.json")));
    for (const char* picture : {"coverage.svg", "albedo.svg", "lobes.svg"})
        EXPECT_NE(read(folder_ / "audit" / picture).find("</svg>"), std::string::npos) << picture;
    // Exits are known up to 85 degrees.
    const std::string coverage = read(folder_ / "audit/coverage.svg");
    EXPECT_NE(coverage.find(">99 % known<"), std::string::npos);
    // Nothing was measured of light that passes.
    EXPECT_NE(coverage.find(">reflected<"), std::string::npos);
    EXPECT_EQ(coverage.find(">through<"), std::string::npos);
    EXPECT_EQ(nacre("data audit page.bsdf").code, 2);
    EXPECT_EQ(nacre("data audit wall.csv -o wall.csv").code, 2);
}

}  // namespace nacre
