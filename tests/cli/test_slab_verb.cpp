// nacre slab.
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
         "layer 1: unknown parameter 'sigma_x'; did you mean 'sigma_s'?"},
        {"slab --layer 'g=0 g=0 thickness=1'", "layer 1: g is given twice"},
        {"slab --layer thick", "layer 1: 'thick' is not of the form name=value"},
        {"slab --layer thickness=1x", "layer 1: thickness = '1x' is not a number"},
        {"slab --layer thickness=1 --eta-below 0",
         "the index of refraction below the layers is 0; it must be positive and finite"},
        {"slab --layer thickness=1 --angle 90", "--angle: '90' is not a number from 0 to below 90"},
        {"slab --layer thickness=1 --angle 9 --diffuse", "give either --angle or --diffuse"},
        {"slab --layer thickness=1 --method mcc", "unknown method 'mcc'; did you mean 'mc'?"},
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
         "--skin: unknown parameter 'melanine'; did you mean 'melanin'?"},
        {"slab --skin --lambda 900",
         "the optics of tissue are known from 350 to 850 nm; got 900 nm"},
        {"slab flat.obj", "'flat.obj' is no .mci file; give layers by --layer"},
        {"slab none.mci", "none.mci: cannot be read"},
        {"slab none.mci --angle 3", "none.mci: the file says all of a run; --angle is for layers"},
    });
}

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
}  // namespace nacre
