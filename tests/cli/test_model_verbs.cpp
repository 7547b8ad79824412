// nacre models show, nacre eval, nacre check.
#include <nlohmann/json.hpp>

#include "nacre/bssrdf/profile.h"
#include "nacre/image/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;

class ModelVerbs : public test::CommandLine {
  protected:
    /// The rows of a CSV as numbers, without the heading.
    std::vector<std::vector<double>> rows(const std::string& file) const {
        std::ifstream in(folder_ / file);
        std::vector<std::vector<double>> r;
        std::string line, cell;
        std::getline(in, line);
        while (std::getline(in, line)) {
            std::istringstream cells(line);
            r.emplace_back();
            while (std::getline(cells, cell, ',')) r.back().push_back(std::stod(cell));
        }
        return r;
    }
};

TEST_F(ModelVerbs, AnswerWrongCommandLinesExactlyAndWriteNothing) {
    const std::pair<const char*, const char*> cases[] = {
        {"eval ward --wi 0,0,1",
         "give --wi and --wo, or one of --albedo, --slice, --lobe, --curve; see 'nacre help eval'"},
        {"eval ward --wi up --wo 0,0,1",
         "--wi 'up' is not a direction; write x,y,z, such as 0.6,0,0.8"},
        {"eval ward --wi 0,0,0 --wo 0,0,1", "--wi '0,0,0' has no direction"},
        {"eval ward --lobe --curve", "give one of --albedo, --slice, --lobe, --curve"},
        {"eval ward --lobe -o a.pdf", "cannot write 'a.pdf': a table becomes .csv, .svg or .png"},
        {"eval ward --lobe --wi 0,1,-1", "--wi must lie above the horizon: z > 0"},
        {"eval ward --lobe --lambda -1", "--lambda: '-1' is not a number above 0 to 1e+09"},
        {"eval ward --set alpha=0 --lobe",
         "ward: alpha_u = 0 is out of range: must lie within (0, 10]"},
        {"eval ward --set alpha --lobe",
         "'alpha' does not set a parameter; write name=value, such as alpha=0.2"},
        {"eval ward --wi 0,0,1 --wo 0,0,1 -o a.csv",
         "-o needs one of --albedo, --slice, --lobe, --curve"},
        {"check", "give the name of a model, 'all', or --vectors FILE"},
        {"check --vectors missing.json", "cannot read 'missing.json'"},
        {"check /dev/null", "'/dev/null' is data, not the name of a model; use nacre data audit"},
        {"eval /dev/null --wi 0,0,1 --wo 0,0,1",
         "'/dev/null' is data, not the name of a model; use nacre data eval"},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
        EXPECT_EQ(written(), std::vector<std::string>{}) << arguments;
    }
}

TEST_F(ModelVerbs, EvalPrintsValueAndDensity) {
    // Lambert: 0.5 / pi, times 0.8; the density is 0.8 / pi.
    const Outcome r = nacre("eval lambert --set reflectance=0.5 --wi 0.6,0,0.8 --wo 0,0,2");
    EXPECT_EQ(r.out,
              "f             0.159154943092 sr^-1\nf cos(theta)  0.127323954474 sr^-1\n"
              "pdf           0.254647908947 sr^-1\n");
    const json j = json::parse(
        nacre("eval lambert --set reflectance=0.5 --wi 0.6,0,0.8 --wo 0,0,2 --json").out);
    EXPECT_DOUBLE_EQ(j["value"].get<double>(), 0.5 / M_PI);
}

TEST_F(ModelVerbs, AlbedoOfAKnownModel) {
    const json j = json::parse(nacre("eval lambert --set rho=0.7 --albedo --wi 0,0,1 --json").out);
    EXPECT_NEAR(j["albedo"].get<double>(), 0.7, 1e-9);
    ASSERT_EQ(nacre("eval lambert --set rho=0.7 --albedo -o a.csv").code, 0);
    const auto table = rows("a.csv");
    ASSERT_EQ(table.size(), 90u);
    for (const auto& row : table) EXPECT_NEAR(row.at(1), 0.7, 1e-6);
}

// A Lambert surface is the same everywhere above the horizon; a highlight is where the mirror is.
TEST_F(ModelVerbs, PlotsComeWithTheirNumbers) {
    ASSERT_EQ(nacre("eval lambert --set rho=0.5 --slice -o s.csv").code, 0);
    const auto slice = rows("s.csv");
    ASSERT_EQ(slice.size(), 90u * 90u);
    for (const auto& row : slice) EXPECT_NEAR(row.at(2), 0.5 / M_PI, 1e-9);

    ASSERT_EQ(nacre("eval phong --set kd=0 ks=1 n=100 --curve --wi 0.5,0,0.8660254 -o c.csv").code,
              0);
    std::vector<double> best{0., 0.};
    for (const auto& row : rows("c.csv"))
        if (row.at(1) > best[1]) best = row;
    EXPECT_NEAR(best[0], 30., 0.5);

    if (std::system("gnuplot --version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "no gnuplot: no pictures";
    for (const char* kind : {"--albedo", "--slice", "--lobe", "--curve"}) {
        ASSERT_EQ(nacre(fmt::format("eval ward {} -o p.png", kind)).code, 0) << kind;
        EXPECT_EQ(written(), (std::vector<std::string>{"c.csv", "p.png", "p.png.csv", "s.csv"}));
        EXPECT_GT(read_image(folder_ / "p.png").width, 500) << kind;
    }
    ASSERT_EQ(nacre("eval ward --lobe -o p.svg").code, 0);
    EXPECT_NE(read(folder_ / "p.svg").find("<svg"), std::string::npos);
}

TEST_F(ModelVerbs, IlluminationModelsAreListedAndShownByNumber) {
    const json all = json::parse(nacre("models --json").out);
    ASSERT_EQ(all["illumination"].size(), 23u);
    EXPECT_EQ(all["illumination"][12]["name"], "phong");
    EXPECT_NE(nacre("models").out.find("23 hall_transparency "), std::string::npos);
    const Outcome thirteen = nacre("models show 13");
    EXPECT_EQ(thirteen.code, 0);
    EXPECT_EQ(thirteen.out.substr(0, 9), "13 phong:") << thirteen.out;
    EXPECT_EQ(json::parse(nacre("models show crow-transparency --json").out)["number"], 22);
    // A name that the reflectance models have too is theirs.
    EXPECT_NE(nacre("models show phong").out.substr(0, 9), "13 phong:");
    EXPECT_EQ(nacre("models show 24").code, 2);
}

TEST_F(ModelVerbs, ModelsListsAndShowsProfilesTechniquesAndSkin) {
    const std::string list = nacre("models").out;
    const json all = json::parse(nacre("models --json").out);
    ASSERT_EQ(all["profile"].size(), profiles().size());
    ASSERT_GE(all["technique"].size(), 4u);
    EXPECT_EQ(all["spectral_medium"][0]["name"], "skin");
    const auto shown = [&](std::string_view name, std::initializer_list<std::string_view> parts) {
        EXPECT_NE(list.find(fmt::format("\n  {} ", name)), std::string::npos) << name;
        const Outcome r = nacre(fmt::format("models show {}", name));
        EXPECT_EQ(r.code, 0) << r.err;
        for (const std::string_view part : parts)
            EXPECT_NE(r.out.find(part.substr(0, 40)), std::string::npos) << name << part << r.out;
    };
    for (const ProfileDescription* p : profiles()) {
        shown(p->name, {p->title, p->authors, p->paper, std::to_string(p->year)});
        const json j = json::parse(nacre(fmt::format("models show {} --json", p->name)).out);
        EXPECT_EQ(j["kind"], "profile");
        EXPECT_EQ(j["parameters"].size(), p->options.size());
        EXPECT_EQ(j["errata"].size(), p->errata.size());
    }
    shown("dipole", {"z_r = 1/sigma_t'", "boundary", "two_moment", "errata of the literature"});
    for (const json& t : all["technique"])
        shown(t["name"].get<std::string>(),
              {t["title"].get<std::string>(), t["authors"].get<std::string>(),
               t["paper"].get<std::string>()});
    shown("two_pass", {"precomputes surface points", "may change  view", "--technique two_pass",
                       "irradiance_samples"});
    EXPECT_EQ(json::parse(nacre("models show two-pass --json").out)["kind"], "technique");
    shown("skin", {"Skin Optics", "nacre slab --skin"});
    EXPECT_TRUE(nacre("models show dipol")
                    .err.starts_with("nacre: unknown model 'dipol'; did you mean 'dipole'?"));
}

// Whatever it is, programs find the same facts under the same names, and parameters alike.
TEST_F(ModelVerbs, EveryDescriptionHasOneShapeAsJson) {
    const char* heading[] = {"name", "kind", "title", "authors", "year", "paper", "parameters"};
    for (const char* name : {"ward", "13", "dipole", "two_pass", "marble", "skin", "mitsuba", "hg",
                             "diffuse", "path", "volpath"}) {
        const Outcome r = nacre(fmt::format("models show {} --json", name));
        ASSERT_EQ(r.code, 0) << r.err;
        const auto j = nlohmann::ordered_json::parse(r.out);
        auto at = j.begin();
        for (const char* key : heading) {
            ASSERT_NE(at, j.end()) << name;
            EXPECT_EQ((at++).key(), key) << name;
        }
        for (const auto& p : j["parameters"]) {
            for (const char* key : {"name", "meaning", "kind", "default", "aliases"})
                EXPECT_TRUE(p.contains(key)) << name << key;
            EXPECT_TRUE(p.contains("choices") || p.contains("high")) << name;
        }
    }
    const json spacing = json::parse(nacre("models show two_pass --json").out)["parameters"][3];
    EXPECT_EQ(spacing["name"], "spacing");
    EXPECT_EQ(spacing["high"], 100.);
    EXPECT_EQ(spacing["default"], 1.);
}

TEST_F(ModelVerbs, ShowPrintsTheManualPage) {
    const Outcome r = nacre("models show ward");
    for (const char* part : {"Measuring and Modeling Anisotropic Reflection", "alpha_u", "(0, 10]",
                             "also alpha, alphaU, ax", "kd + ks must not exceed 1", "errata"})
        EXPECT_NE(r.out.find(part), std::string::npos) << part;
    const json j = json::parse(nacre("models show ward --json").out);
    EXPECT_EQ(j["year"], 1992);
    EXPECT_EQ(j["parameters"][0]["choices"].size(), 4u);
    EXPECT_EQ(j["parameters"][3]["low_allowed"], false);
}

TEST_F(ModelVerbs, CheckFindsWrongVectors) {
    const auto file = [](double value) {
        return fmt::format(
            R"({{"models": {{"lambert": {{"vectors": [{{"id": "a", "params": {{"kd": 0.5}},
            "wi": [0, 0, 1], "wo": [0, 0, 1], "value": {:.15g}}}]}}, "marble": {{}}}}}})",
            value);
    };
    std::ofstream(folder_ / "right.json") << file(0.5 / M_PI);
    std::ofstream(folder_ / "wrong.json") << file(0.5 / M_PI * (1. + 2e-6));
    const Outcome right = nacre("check --vectors right.json");
    EXPECT_EQ(right.code, 0);
    EXPECT_NE(right.out.find("not covered: marble"), std::string::npos) << right.out;
    const Outcome wrong = nacre("check --vectors wrong.json");
    EXPECT_EQ(wrong.code, 1);
    EXPECT_NE(wrong.out.find("WRONG at a"), std::string::npos) << wrong.out;
}

// The file from which the tests' own values are taken: everything is answered.
TEST_F(ModelVerbs, CheckAnswersTheReferenceFile) {
    const std::string file = NACRE_SHARED_DIR "/reference/reflectance_vectors.json";
    if (!fs::exists(file)) GTEST_SKIP() << "no shared reference data";
    const Outcome r = nacre(fmt::format("check --vectors '{}'", file));
    EXPECT_EQ(r.code, 0) << r.out;
    // A heading, 58 models, 11 functions, measured files and matrices.
    EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 1 + 58 + 11 + 2) << r.out;
    EXPECT_EQ(r.out.find("not covered"), std::string::npos) << r.out;
}

TEST_F(ModelVerbs, CheckOfAModelSaysWhatItChecked) {
    const Outcome r = nacre("check phong");
    EXPECT_EQ(r.code, 0) << r.out;
    for (const char* part : {"phong: vectors modified_phong", "variant=classic: reciprocity",
                             "said not to be reciprocal", "furnace", "sampling", "horizon"})
        EXPECT_NE(r.out.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace nacre
