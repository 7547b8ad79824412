// nacre profile.
#include <nlohmann/json.hpp>

#include "nacre/bssrdf/profile.h"
#include "nacre/image/image.h"
#include "nacre/layers/adding_doubling.h"
#include "nacre/layers/skin.h"
#include "tests/cli/subsurface_verbs.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using test::SubsurfaceVerbs;

TEST_F(SubsurfaceVerbs, ProfileAnswersWrongCommandLinesExactly) {
    expect_refused({
        {"profile dipole", "give one of --material, --sigma-s and --sigma-s-prime"},
        {"profile dipole --material marble --sigma-s 1",
         "give one of --material, --sigma-s and --sigma-s-prime"},
        {"profile dipole --material marble --sigma-a 1",
         "--sigma-a is the material's; leave it out"},
        {"profile dipole --sigma-s 1 --channel r", "--channel belongs to --material"},
        {"profile dipole --material marble --channel x",
         "--channel: unknown band 'x'; known are: red, green, blue"},
        {"profile dipole --sigma-s -1",
         "translucent medium: sigma_s = -1 must be finite and at "
         "least 0"},
        {"profile dipole --sigma-s-prime 1 --g 1",
         "translucent medium: g = 1 must be between -1 and 1"},
        {"profile dipole --sigma-s 1 --eta 0",
         "translucent medium: eta = 0 must be positive and finite"},
        {"profile dipole --sigma-s 0",
         "translucent medium: sigma_s + sigma_a = 0 must be positive"},
        {"profile dipole --sigma-s 1 --rmax 0", "--rmax: '0' is not a number above 0 to 1e+09"},
        {"profile dipole --sigma-s 1 --json -o a.csv", "give either --json or -o"},
        {"profile dipole --sigma-s 1 -o a.pdf",
         "cannot write 'a.pdf': a table becomes .csv, .svg or .png"},
        {"profile dipole --sigma-s 1 --set kappa=on",
         "dipole: unknown parameter 'kappa'; known are: boundary"},
        {"profile all --sigma-s 1 --set bondary=fit", "no profile has an option 'bondary'"},
        {"profile dipole --sigma-s 1 --mc 10",
         "--mc: '10' is not a whole number from 64 to 9007199254740992"},
    });
    EXPECT_TRUE(
        nacre("profile dipol --sigma-s 1")
            .err.starts_with("nacre: unknown diffusion profile 'dipol'; did you mean 'dipole'?"));
    const std::string unknown = nacre("profile dipole --material marbel").err;
    EXPECT_EQ(unknown, "nacre: unknown measured medium 'marbel'; did you mean 'Marble'?\n");
    // Where nothing is near, all are named, skin among them.
    for (const char* verb : {"profile dipole", "render flat.obj"})
        EXPECT_TRUE(nacre(fmt::format("{} --material plutonium", verb)).err.ends_with(", skin\n"));
}

TEST_F(SubsurfaceVerbs, ProfileTellsTheDipoleOfMarble) {
    ASSERT_EQ(nacre("profile dipole --material marble --channel r -o d.csv").code, 0);
    const auto table = columns("d.csv");
    const std::vector<double>&r = table.at("r_mm"), &value = table.at("dipole");
    ASSERT_GT(r.size(), 40u);
    const double t = 2.19 + 0.0021, s = std::sqrt(3. * 0.0021 * t), z_r = 1. / t;
    const double fdr = -1.440 / 2.25 + 0.710 / 1.5 + 0.668 + 0.0636 * 1.5;
    const double z_v = z_r * (1. + 4. / 3. * (1. + fdr) / (1. - fdr));
    for (std::size_t i = 0; i < r.size(); ++i) {
        double expected = 0.;
        for (const double z : {z_r, z_v}) {
            const double d = std::sqrt(r[i] * r[i] + z * z);
            expected += 2.19 / t / (4. * M_PI) * z * (1. + s * d) * std::exp(-s * d) / (d * d * d);
        }
        EXPECT_NEAR(value[i], expected, 1e-9 * expected) << r[i];
        EXPECT_TRUE(i == 0 || r[i] > r[i - 1]);
    }
    EXPECT_LT(r.front(), 0.02 / t);
    EXPECT_GT(r.back(), 10. / t);

    const json j = json::parse(nacre("profile all --material marble --channel r --json").out);
    EXPECT_EQ(j["medium"]["sigma_s_per_mm"], 2.19);
    ASSERT_EQ(j["profiles"].size(), profiles().size());
    const double total = 2.19 / t / 2. * (std::exp(-s * z_r) + std::exp(-s * z_v));
    EXPECT_EQ(j["profiles"][0]["name"], "dipole");
    EXPECT_NEAR(j["profiles"][0]["total"].get<double>(), total, 1e-12);
    // A profile's own reduced coefficients are kept for any g.
    const json narrow =
        json::parse(nacre("profile dipole --sigma-s-prime 2.19 --sigma-a 0.0021 --eta 1.5 --g 0.8 "
                          "--json")
                        .out);
    EXPECT_NEAR(narrow["medium"]["sigma_s_per_mm"].get<double>(), 2.19 / 0.2, 1e-12);
    EXPECT_NEAR(narrow["profiles"][0]["total"].get<double>(), total, 1e-12);
}

TEST_F(SubsurfaceVerbs, ProfilePrintsValuesAndTotals) {
    const Outcome one = nacre("profile better_dipole --material skin1");
    EXPECT_EQ(one.code, 0);
    for (const char* part : {"skin1, green band: sigma_s 0.88, sigma_a 0.17 mm^-1, g 0, eta 1.3\n",
                             "\nR(r), mm^-2\n", "\nlight that leaves within r\n", "\n     total "})
        EXPECT_NE(one.out.find(part), std::string::npos) << part << one.out;
    const Outcome all = nacre("profile all --material skin --cumulative");
    for (const ProfileDescription* p : profiles())
        EXPECT_NE(all.out.find(p->name), std::string::npos) << p->name;
    EXPECT_EQ(all.out.find("R(r)"), std::string::npos);
    // The multipole takes no slab thinner than a free path of the medium: it is left out, the
    // others are not.
    const Outcome thin = nacre("profile all --sigma-s 0.01 --sigma-a 0.001 --json");
    EXPECT_EQ(thin.code, 0);
    EXPECT_TRUE(thin.err.starts_with("nacre: left out: multipole: ")) << thin.err;
    EXPECT_EQ(json::parse(thin.out)["profiles"].size(), profiles().size() - 1);
}

TEST_F(SubsurfaceVerbs, ProfileStandsBesideASimulation) {
    ASSERT_EQ(nacre("profile photon_beam_diffusion --set single=on --sigma-s 1 --sigma-a 0.1 --mc "
                    "300000 -o mc.csv")
                  .code,
              0);
    const auto table = columns("mc.csv");
    int compared = 0;
    for (std::size_t i = 0; i < table.at("r_mm").size(); ++i) {
        const double r = table.at("r_mm")[i], error = table.at("monte_carlo_error")[i];
        if (r < 0.25 || r > 5.) continue;
        const double truth = table.at("monte_carlo")[i];
        EXPECT_GT(error, 0.);
        EXPECT_NEAR(table.at("photon_beam_diffusion")[i], truth, 0.1 * truth + 5. * error) << r;
        ++compared;
    }
    EXPECT_GT(compared, 20);
    const json j = json::parse(
        nacre("profile dipole --sigma-s 1 --sigma-a 0.1 --mc 300000 --rmax 40 --json").out);
    const json& simulated = j["profiles"][1];
    EXPECT_EQ(simulated["name"], "monte_carlo");
    // Of the light that entered: scattering.md's simulation of this medium, 0.30130 of all light
    // (standard error 0.00014), and all of it leaves within 40 mm.
    const double entered = 1. - 0.0170132325141777, expected = 0.30130397528930575 / entered;
    const double error = simulated["total_error"];
    EXPECT_NEAR(simulated["total"].get<double>(), expected, 5. * std::hypot(error, 0.00015));
    EXPECT_NEAR(simulated["within"].back().get<double>(), simulated["total"].get<double>(), 1e-6);
    EXPECT_EQ(j["ring_edges_mm"].size(), j["r_mm"].size() + 1);

    if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot: no pictures";
    ASSERT_EQ(nacre("profile all --material marble --mc 10000 -o p.png").code, 0);
    EXPECT_GT(read_image(folder_ / "p.png").width, 500);
    EXPECT_EQ(written(), (std::vector<std::string>{"mc.csv", "p.png", "p.png.csv"}));
}

TEST_F(SubsurfaceVerbs, ASimulationIsOneLineInABand) {
    if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot: no pictures";
    ASSERT_EQ(nacre("profile dipole --material marble --mc 2000 -o p.svg").code, 0);
    const std::string svg = read(folder_ / "p.svg");
    for (const char* words : {"distance from entry / mm", "slab Monte Carlo, ±2 standard errors"})
        EXPECT_NE(svg.find(words), std::string::npos) << words;
    EXPECT_NE(svg.find("fill-opacity"), std::string::npos) << "no band";
    // The line is the longest path in the colour of a simulation.
    std::string longest;
    for (std::size_t at = 0; (at = svg.find("<path", at)) != svg.npos; ++at) {
        const std::string path = svg.substr(at, svg.find("/>", at) - at);
        if (path.find("28,  29,  31") != path.npos && path.size() > longest.size()) longest = path;
    }
    EXPECT_EQ(std::count(longest.begin(), longest.end(), 'M'), 2)
        << longest;  // its sample in the legend
    EXPECT_GT(std::count(longest.begin(), longest.end(), 'L'), 10);
}

}  // namespace
}  // namespace nacre
