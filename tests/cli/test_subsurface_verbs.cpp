// nacre profile, nacre slab, and what nacre models says of profiles, techniques and skin.
#include <nlohmann/json.hpp>

#include "nacre/bssrdf/profile.h"
#include "nacre/layers/adding_doubling.h"
#include "nacre/layers/skin.h"
#include "nacre/scene/image.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;

class SubsurfaceVerbs : public test::CommandLine {
  protected:
    /// The columns of a CSV of numbers by their names.
    std::map<std::string, std::vector<double>> columns(const std::string& file) const {
        std::ifstream in(folder_ / file);
        std::string line, cell;
        std::vector<std::string> names;
        std::getline(in, line);
        for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
        std::map<std::string, std::vector<double>> r;
        while (std::getline(in, line)) {
            std::istringstream cells(line);
            for (const std::string& name : names) {
                std::getline(cells, cell, ',');
                r[name].push_back(std::stod(cell));
            }
        }
        return r;
    }
    void expect_refused(std::initializer_list<std::pair<const char*, const char*>> cases) const {
        const std::vector<std::string> before = written();
        for (const auto& [arguments, message] : cases) {
            const Outcome r = nacre(arguments);
            EXPECT_EQ(r.code, 2) << arguments;
            EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
            EXPECT_EQ(r.out, "") << arguments;
            EXPECT_EQ(written(), before) << arguments;
        }
    }
    static bool has_gnuplot() { return std::system("gnuplot --version > /dev/null 2>&1") == 0; }
};

// The folders in a run's name are its author's, not ours to write to.
constexpr const char* mci = R"(1.0 # version
1   # runs
../up/here.mco A
20000
0.01 0.02
5 6 3
1
1.0
1.0 1.0 9.0 0.75 0.2
1.0
)";

TEST_F(SubsurfaceVerbs, ProfileAnswersWrongCommandLinesExactly) {
    expect_refused({
        {"profile dipole", "give one of --material, --sigma-s and --sigma-s-prime"},
        {"profile dipole --material marble --sigma-s 1",
         "give one of --material, --sigma-s and --sigma-s-prime"},
        {"profile dipole --material marble --sigma-a 1",
         "--sigma-a is the material's; leave it out"},
        {"profile dipole --sigma-s 1 --channel r", "--channel belongs to --material"},
        {"profile dipole --material marble --channel x",
         "--channel 'x' is unknown; known are: r, g, b"},
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
         "dipole: unknown option \"kappa\": known are boundary"},
        {"profile all --sigma-s 1 --set bondary=fit", "no profile has an option 'bondary'"},
        {"profile dipole --sigma-s 1 --mc 10",
         "--mc: '10' is not a whole number from 64 to 9007199254740992"},
    });
    EXPECT_TRUE(nacre("profile dipol --sigma-s 1")
                    .err.starts_with("nacre: unknown diffusion profile \"dipol\": did you mean "
                                     "\"dipole\"? known are dipole, "));
    const std::string unknown = nacre("profile dipole --material marbel").err;
    EXPECT_TRUE(unknown.starts_with("nacre: unknown measured medium \"marbel\": did you mean"));
    EXPECT_TRUE(unknown.ends_with(", skin\n")) << unknown;
    EXPECT_TRUE(nacre("render flat.obj --material marbel").err.ends_with(", skin\n"));
}

// The closed forms of Jensen et al. 2001 for marble, in its red band.
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

// Photon beam diffusion with its exact single scattering is within a tenth of the truth beyond a
// quarter of a mean free path (Habel et al. 2013), so the simulation must be, to 5 standard errors.
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

TEST_F(SubsurfaceVerbs, SlabAnswersWrongCommandLinesExactly) {
    const char* empty =
        "an empty stack: give --layer for each layer, or --skin, or an .mci file; see 'nacre help "
        "slab'";
    expect_refused({
        {"slab", empty},
        {"slab --skin --layer thickness=1", empty},
        {"slab --layer 'sigma_s=-1 thickness=1'",
         "layer 1: sigma_s = -1 must be finite and at least 0"},
        {"slab --layer thickness=1 --layer 'sigma_a=-2 thickness=1'",
         "layer 2: sigma_a = -2 must be finite and at least 0"},
        {"slab --layer 'albedo=1.2 tau=1'", "layer 1: albedo = 1.2 must be between 0 and 1"},
        {"slab --layer 'albedo=0.5 tau=0'", "layer 1: tau = 0 must be positive"},
        {"slab --layer 'albedo=0.5 tau=inf thickness=1'",
         "layer 1: tau = inf does not go with thickness = 1"},
        {"slab --layer 'albedo=0.5 tau=1 sigma_s=1'",
         "layer 1: give sigma_s and sigma_a, or albedo and tau"},
        {"slab --layer albedo=0.5", "layer 1: give sigma_s and sigma_a, or albedo and tau"},
        {"slab --layer 'g=1 thickness=1'", "layer 1: g = 1 must be between -1 and 1"},
        {"slab --layer 'eta=0 thickness=1'", "layer 1: eta = 0 must be positive and finite"},
        {"slab --layer thickness=0", "layer 1: thickness = 0 must be positive"},
        {"slab --layer thickness=inf --layer thickness=1",
         "layer 1: thickness = inf must be finite, except in the last layer"},
        {"slab --layer sigma_s=1",
         "layer 1: thickness is missing, in mm; thickness=inf is a half space"},
        {"slab --layer 'sigma_x=1 thickness=1'",
         "layer 1: unknown parameter \"sigma_x\": did you mean \"sigma_s\"? known are sigma_s, "
         "sigma_a, g, thickness, eta, albedo, tau"},
        {"slab --layer 'g=0 g=0 thickness=1'", "layer 1: g is given twice"},
        {"slab --layer thick", "layer 1: 'thick' is not of the form name=value"},
        {"slab --layer thickness=1x", "layer 1: thickness = '1x' is not a number"},
        {"slab --layer thickness=1 --eta-below 0",
         "the index of refraction below the layers is 0; it must be positive and finite"},
        {"slab --layer thickness=1 --angle 90", "--angle: '90' is not a number from 0 to below 90"},
        {"slab --layer thickness=1 --angle 9 --diffuse", "give either --angle or --diffuse"},
        {"slab --layer thickness=1 --method mcc",
         "unknown method \"mcc\": known are km, hk, ad, mc, all"},
        {"slab --layer thickness=1 --photons 3 --method mc",
         "--photons: '3' is not a whole number from 64 to 9007199254740992"},
        {"slab --layer 'sigma_s=1 thickness=inf' --method mc",
         "layer 1: walks in a half space that absorbs 0 of the light per collision need not end; "
         "give it more absorption or a finite thickness"},
        {"slab --layer thickness=1 --angle 9 --method km",
         "Kubelka and Munk know diffuse light and a beam along the normal"},
        {"slab --layer thickness=1 --spectrum",
         "--spectrum belongs to --skin: given layers have no wavelength"},
        {"slab --layer thickness=1 --lambda 500",
         "--lambda belongs to --skin, and --spectrum goes over all"},
        {"slab --skin --step 5", "--step belongs to --spectrum"},
        {"slab --skin --spectrum --step 0.5", "--step: '0.5' is not a number from 1 to 300"},
        {"slab --skin --rmax 5", "--rmax belongs to --radial"},
        {"slab --skin --bins 5", "--bins belongs to --radial and --angular"},
        {"slab --skin --radial --bins 0", "--bins: '0' is not a whole number from 1 to 10000"},
        {"slab --skin --radial --rmax -1", "--rmax: '-1' is not a number above 0 to 1e+09"},
        {"slab --skin --radial --angular",
         "give one of --spectrum, --radial, --angular and --lobe"},
        {"slab --skin --radial --diffuse",
         "--radial, --angular and --lobe need a beam: leave out --diffuse"},
        {"slab --skin --angular --method km",
         "--angular is told by the methods ad and mc; --method has neither"},
        {"slab --skin -o a.svg",
         "a picture needs one of --spectrum, --radial, --angular and --lobe"},
        {"slab --skin --spectrum -o a.pdf",
         "cannot write 'a.pdf': a table becomes .csv, .svg or .png"},
        {"slab --skin --json -o a.csv", "give either --json or -o"},
        {"slab --skin melanin=2", "epidermis: melanin = 2 must lie within [0, 1]"},
        {"slab --skin eumelanin=0.5",
         "--skin: eumelanin needs optics=donner_jensen; jacques has one melanin"},
        {"slab --skin 'melanine=0.1'",
         "--skin: unknown parameter \"melanine\": did you mean \"melanin\"? known are melanin, "
         "blood, oxygenation, haemoglobin, eumelanin, optics"},
        {"slab --skin --lambda 900",
         "the optics of tissue are known from 350 to 850 nm; got 900 nm"},
        {"slab flat.obj", "'flat.obj' is no .mci file; give layers by --layer"},
        {"slab none.mci", "none.mci: cannot be read"},
        {"slab none.mci --angle 3", "none.mci: the file says all of a run; --angle is for layers"},
    });
}

// van de Hulst 1980: albedo 0.9, optical thickness 2, g 0.75: R 0.09739, T 0.66096 (as printed).
TEST_F(SubsurfaceVerbs, SlabSetsMethodsSideBySide) {
    const char* layer = "--layer 'albedo=0.9 tau=2 g=0.75'";
    const json j = json::parse(nacre(fmt::format("slab {} --json", layer)).out);
    EXPECT_NEAR(j["ad"]["reflectance"].get<double>(), 0.09739, 6e-6);
    EXPECT_NEAR(j["ad"]["transmittance"].get<double>(), 0.66096, 6e-6);
    for (const char* name : {"reflectance", "transmittance", "absorptance"}) {
        const double error = j["mc"][std::string(name) + "_error"];
        EXPECT_NEAR(j["mc"][name].get<double>(), j["ad"][name].get<double>(), 5. * error) << name;
        EXPECT_LT(error, 1e-3);
    }
    // Only what is scattered once: less than all. Two streams do not tell what was not scattered.
    EXPECT_LT(j["hk"]["reflectance"], j["ad"]["reflectance"]);
    EXPECT_NEAR(j["hk"]["unscattered"].get<double>(), std::exp(-2.), 1e-12);
    EXPECT_FALSE(j["km"].contains("unscattered"));
    // The same layer in the other spelling, in a table.
    const Outcome text = nacre("slab --layer 'sigma_s=0.9 sigma_a=0.1 thickness=2 g=0.75'");
    EXPECT_NE(text.out.find("adding-doubling                 0.097395            0.660958"),
              std::string::npos)
        << text.out;
    // Diffuse light, of which the vectors have R 0.19109022662 and T 0.50181605832.
    const json d = json::parse(nacre(fmt::format("slab {} --diffuse --json", layer)).out);
    EXPECT_NEAR(d["ad"]["reflectance"].get<double>(), 0.19109022662, 1e-8);
    for (const char* name : {"reflectance", "transmittance", "absorptance"})
        EXPECT_NEAR(d["mc"][name].get<double>(), d["ad"][name].get<double>(),
                    5. * d["mc"][std::string(name) + "_error"].get<double>())
            << name;
    // What a method refuses is said, and the others go on.
    const json h = json::parse(nacre("slab --layer 'sigma_s=1 thickness=inf' --json").out);
    EXPECT_TRUE(h["mc"].contains("refused"));
    EXPECT_NEAR(h["ad"]["reflectance"].get<double>(), 1., 1e-8);
    // Light from the side of the larger index, part of which is reflected totally.
    const json dense = json::parse(
        nacre(fmt::format("slab {} --diffuse --eta-above 1.5 --eta-below 1.2 --json", layer)).out);
    EXPECT_NEAR(dense["mc"]["reflectance"].get<double>(), dense["ad"]["reflectance"].get<double>(),
                5. * dense["mc"]["reflectance_error"].get<double>());
    EXPECT_NEAR(dense["mc"]["specular"].get<double>(), dense["ad"]["specular"].get<double>(), 1e-6);
    ASSERT_EQ(nacre(fmt::format("slab {} --angle 60 --method ad,mc -o t.csv", layer)).code, 0);
    EXPECT_TRUE(read(folder_ / "t.csv").starts_with("method,reflectance,transmittance,"));
}

TEST_F(SubsurfaceVerbs, SlabTellsRadiusAndAngle) {
    const char* layer = "--layer 'albedo=0.9 tau=2 g=0.5 eta=1.3' --photons 300000";
    ASSERT_EQ(nacre(fmt::format("slab {} --angular --bins 15 -o a.csv", layer)).code, 0);
    const auto a = columns("a.csv");
    for (std::size_t i = 1; i < 14; ++i) {  // the first holds what was not scattered
        const double error = a.at("mc_reflected_error")[i], ad = a.at("ad_reflected")[i];
        // The middle of a bin of 6 degrees is within 0.3 % of its mean.
        EXPECT_NEAR(a.at("mc_reflected")[i], ad, 5. * error + 0.003 * ad) << i;
    }
    ASSERT_EQ(nacre(fmt::format("slab {} --radial --rmax 40 --bins 400 -o r.csv", layer)).code, 0);
    const auto r = columns("r.csv");
    const json totals = json::parse(nacre(fmt::format("slab {} --json", layer)).out)["ad"];
    double reflected = 0., transmitted = 0.;
    for (std::size_t i = 0; i < 400; ++i) {
        const double area = 2. * M_PI * r.at("r_mm")[i] * 0.1;
        reflected += area * r.at("reflected")[i];
        transmitted += area * r.at("transmitted")[i];
    }
    // Standard error below 0.001.
    EXPECT_NEAR(reflected, totals["reflectance"].get<double>() - totals["specular"].get<double>(),
                0.005);
    EXPECT_NEAR(transmitted, totals["transmittance"].get<double>(), 0.005);
    if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot: no pictures";
    ASSERT_EQ(nacre(fmt::format("slab {} --radial -o r.svg", layer)).code, 0);
    EXPECT_NE(read(folder_ / "r.svg").find("<svg"), std::string::npos);
}

TEST_F(SubsurfaceVerbs, SlabTellsTheSpectrumOfSkin) {
    ASSERT_EQ(nacre("slab --skin 'melanin=0.06 blood=0.05 oxygenation=0.9' --spectrum --step 20 "
                    "--method ad,mc --photons 20000 -o s.csv")
                  .code,
              0);
    const auto s = columns("s.csv");
    ASSERT_EQ(s.at("nm").size(), 16u);
    SkinParameters skin;
    skin.epidermis.melanin = 0.06;
    skin.papillary_dermis.blood = 0.05;
    skin.reticular_dermis.blood = skin.hypodermis.blood = 0.009 / 0.012 * 0.05;
    skin.oxygenation = 0.9;
    const std::vector<double> normal{1.};
    for (std::size_t i = 0; i < 16; ++i) {
        const double nm = 400. + 20. * double(i);
        EXPECT_EQ(s.at("nm")[i], nm);
        const double expected =
            adding_doubling(skin_stack(skin, nm), normal).collimated.front().reflectance;
        EXPECT_NEAR(s.at("ad")[i], expected, 1e-10) << nm;
        EXPECT_NEAR(s.at("mc")[i], expected, 5. * s.at("mc_error")[i]) << nm;
    }
    // Blood is dark in the green, light beyond 600 nm.
    EXPECT_GT(s.at("ad")[15], 1.5 * s.at("ad")[7]);
}

TEST_F(SubsurfaceVerbs, SlabRunsTheFilesOfMcml) {
    const fs::path sub = folder_ / "sub";
    fs::create_directory(sub);
    std::ofstream(sub / "in.mci") << mci;
    const Outcome r = nacre("slab sub/in.mci");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(r.out.starts_with("sub/here.mco: R 0.09")) << r.out;
    const std::string mco = read(sub / "here.mco");
    EXPECT_TRUE(mco.starts_with("A1")) << mco;
    EXPECT_NE(mco.find("RAT #Reflectance"), std::string::npos);
    ASSERT_EQ(nacre("slab sub/in.mci -o own.mco --seed 1").code, 0);
    EXPECT_NE(read(folder_ / "own.mco"), mco);
    ASSERT_EQ(nacre("slab sub/in.mci -o own.csv --photons 1000").code, 0);
    EXPECT_TRUE(read(folder_ / "own.csv").starts_with("quantity,unit,layer,radius"));

    std::ofstream(folder_ / "bad.mci") << "1.0\n1\nout.mco A\n-5\n";
    std::string two = mci;
    two[two.find("1   # runs")] = '2';
    two += std::string(mci).substr(std::string(mci).find("../up"));
    std::ofstream(folder_ / "two.mci") << two;
    expect_refused({
        {"slab bad.mci",
         "bad.mci:4: the number of photons is '-5'; it must be a whole number from 1 to "
         "9007199254740992"},
        {"slab two.mci", "two.mci: two runs write to '../up/here.mco'"},
        {"slab two.mci -o one.mco", "two.mci holds 2 runs: give -o a folder for their files"},
        {"slab sub/in.mci -o nowhere", "'nowhere' is no folder, nor a file .mco or .csv"},
    });
}

}  // namespace
/// Rings that no photon met, and 0 has no place on a logarithmic axis, do not break the line.
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

}  // namespace nacre
