#include "nacre/optics/tissue.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "nacre/math/error.h"
#include "nacre/optics/haemoglobin.h"
#include "tests/support/constants.h"
#include "tests/support/error_of.h"

namespace nacre {

namespace {

/// Wavelengths within [from, to] at which f has a maximum over its neighbours 1 nm away.
template <class F>
std::vector<double> maxima(double from, double to, F f) {
    std::vector<double> found;
    for (double nm = from; nm <= to; nm += 1.)
        if (f(nm) > f(nm - 1.) && f(nm) >= f(nm + 1.)) found.push_back(nm);
    return found;
}

}  // namespace

TEST(Tissue, AgreesWithTheReference) {
    std::ifstream file(NACRE_SOURCE_DIR "/tests/optics/data/tissue.json");
    const nlohmann::json reference = nlohmann::json::parse(file);
    int checked = 0;
    for (const auto& row : reference["skin_jacques"]) {
        const double nm = row["wavelength_nm"], melanin = row["f_mel"], blood = row["f_blood"],
                     oxygenation = row["sat"];
        const auto expect = [&](const char* key, double value, double per = 1.) {
            const double expected = double(row[key]) * per;
            EXPECT_NEAR(value, expected, 1e-10 * expected) << key << " at " << nm;
            ++checked;
        };
        expect("baseline_cm", baseline_absorption(nm), 0.1);
        expect("melanosome_cm", melanin_absorption(nm), 0.1);
        expect("epidermis_mua_mm", epidermis_absorption(nm, melanin));
        expect("blood_mua_cm", blood_absorption(nm, oxygenation), 0.1);
        expect("dermis_mua_mm", dermis_absorption(nm, blood, oxygenation));
        expect("mus_prime_mm", epidermis_reduced_scattering(nm));
        expect("mus_prime_mm", dermis_reduced_scattering(nm));
        expect("g_jacques", skin_anisotropy(nm));
    }
    EXPECT_EQ(checked, 16 * 8);
}

TEST(Tissue, HaemoglobinIsPrahlsCompilation) {
    // Spot checks against omlc.org/spectra/hemoglobin/summary.html: bands and isosbestic points.
    for (const auto& [nm, with, without] : {std::tuple(414., 524280., 342596.),
                                            {432., 214120., 552160.},
                                            {542., 53292., 48148.},
                                            {556., 34476.8, 54540.},
                                            {576., 55540., 40092.},
                                            {600., 3200., 14677.2},
                                            {700., 290., 1794.28},
                                            {800., 816., 761.72}}) {
        EXPECT_EQ(haemoglobin_extinction(nm).oxygenated, with) << nm;
        EXPECT_EQ(haemoglobin_extinction(nm).deoxygenated, without) << nm;
    }
    const HaemoglobinExtinction between = haemoglobin_extinction(577.);
    EXPECT_NEAR(between.oxygenated, 0.5 * (55540. + 54728.), 1e-9);
    EXPECT_NEAR(between.deoxygenated, 0.5 * (40092. + 38467.6), 1e-9);
    EXPECT_GT(haemoglobin_extinction(haemoglobin_first).oxygenated, 0.);
    EXPECT_GT(haemoglobin_extinction(haemoglobin_last).oxygenated, 0.);
}

TEST(Tissue, HaemoglobinAgreesWithTheSharedTable) {
    std::ifstream file(NACRE_SHARED_DIR "/data/tables/hemoglobin_prahl.csv");
    if (!file) GTEST_SKIP() << "no " NACRE_SHARED_DIR "/data/tables/hemoglobin_prahl.csv";
    std::string line;
    std::getline(file, line);
    std::getline(file, line);
    int checked = 0;
    for (double nm, with, without; file >> nm >> with >> without;) {
        if (nm < haemoglobin_first || nm > haemoglobin_last) continue;
        EXPECT_EQ(haemoglobin_extinction(nm).oxygenated, with) << nm;
        EXPECT_EQ(haemoglobin_extinction(nm).deoxygenated, without) << nm;
        ++checked;
    }
    EXPECT_EQ(checked, 251);
}

TEST(Tissue, BloodShowsTheDoubleBandOfHaemoglobin) {
    // Oxygenated blood has two bands in the green, at 542 and 576 nm; without oxygen they are one.
    const auto dermis = [](double blood, double oxygenation) {
        return maxima(500., 620.,
                      [=](double nm) { return dermis_absorption(nm, blood, oxygenation); });
    };
    EXPECT_EQ(dermis(0.02, 0.95), (std::vector{542., 576.}));
    EXPECT_EQ(dermis(0.02, 0.75), (std::vector{542., 576.}));
    EXPECT_EQ(dermis(1., 0.), (std::vector{556.}));  // the baseline would move so flat a top
    EXPECT_EQ(dermis(0., 0.75), std::vector<double>{});
}

TEST(Tissue, SpectraFallAndSharesAdd) {
    for (double nm = 351.; nm <= 850.; nm += 1.) {
        for (const auto model : {SkinScattering::jacques, SkinScattering::donner_jensen}) {
            EXPECT_LT(epidermis_reduced_scattering(nm, model),
                      epidermis_reduced_scattering(nm - 1., model));
            EXPECT_LT(dermis_reduced_scattering(nm, model),
                      dermis_reduced_scattering(nm - 1., model));
        }
        for (const auto model : {BaselineModel::exponential, BaselineModel::power})
            EXPECT_LT(baseline_absorption(nm, model), baseline_absorption(nm - 1., model));
        for (const auto model : {MelaninModel::exponent_3_33, MelaninModel::exponent_3_48,
                                 MelaninModel::donner_jensen})
            EXPECT_LT(melanin_absorption(nm, model, 0.5), melanin_absorption(nm - 1., model, 0.5));
        EXPECT_LT(epidermis_absorption(nm, 0.02), epidermis_absorption(nm, 0.03));
        EXPECT_EQ(epidermis_absorption(nm, 0.), baseline_absorption(nm));
        EXPECT_EQ(epidermis_absorption(nm, 1.), melanin_absorption(nm));
        EXPECT_EQ(dermis_absorption(nm, 1., 0.75), blood_absorption(nm, 0.75));
        EXPECT_NEAR(blood_absorption(nm, 0.5, 75.),
                    0.25 * (blood_absorption(nm, 0.) + blood_absorption(nm, 1.)), 1e-12 * 200.);
        const double g = skin_anisotropy(nm);
        EXPECT_TRUE(g > 0.7 && g < 0.9) << nm;
    }
}

TEST(Tissue, VariantsHaveThePublishedConstants) {
    // The published formulas at 500 nm, worked out outside this program.
    EXPECT_NEAR(baseline_absorption(500., BaselineModel::power), 0.12857860, 1e-8);
    EXPECT_NEAR(melanin_absorption(500., MelaninModel::exponent_3_48), 68.870511, 1e-6);
    EXPECT_NEAR(melanin_absorption(500., MelaninModel::donner_jensen, 0.), 43.882411, 1e-6);
    EXPECT_EQ(melanin_absorption(500., MelaninModel::donner_jensen, 1.), melanin_absorption(500.));
    // The two melanosomes are within 2 % at 500 nm; Donner and Jensen's dermis scatters half.
    EXPECT_NEAR(melanin_absorption(500., MelaninModel::exponent_3_48) / melanin_absorption(500.),
                1., 0.02);
    const auto model = SkinScattering::donner_jensen;
    EXPECT_NEAR(epidermis_reduced_scattering(500., model), 7.2759870, 1e-7);
    EXPECT_NEAR(dermis_reduced_scattering(500., model), 0.5 * 7.2759870, 1e-7);
}

TEST(Tissue, WrongInputIsExplained) {
    using Call = void (*)();
    for (const auto& [call, expected] : std::initializer_list<std::pair<Call, const char*>>{
             {[] { baseline_absorption(349.); },
              "the optics of tissue are known from 350 to 850 nm; got 349 nm"},
             {[] { melanin_absorption(851.); },
              "the optics of tissue are known from 350 to 850 nm; got 851 nm"},
             {[] { dermis_reduced_scattering(nan); },
              "the optics of tissue are known from 350 to 850 nm; got nan nm"},
             {[] { epidermis_reduced_scattering(0.); },
              "the optics of tissue are known from 350 to 850 nm; got 0 nm"},
             {[] { skin_anisotropy(-500.); },
              "the optics of tissue are known from 350 to 850 nm; got -500 nm"},
             {[] { blood_absorption(900., 0.5); },
              "the optics of tissue are known from 350 to 850 nm; got 900 nm"},
             {[] { haemoglobin_extinction(850.5); },
              "850.5 nm lies outside the table of haemoglobin, 350 to 850 nm"},
             {[] { haemoglobin_extinction(nan); },
              "nan nm lies outside the table of haemoglobin, 350 to 850 nm"},
             {[] { epidermis_absorption(500., 1.5); }, "melanin = 1.5 must lie within [0, 1]"},
             {[] { epidermis_absorption(500., nan); }, "melanin = nan must lie within [0, 1]"},
             {[] { dermis_absorption(500., -0.1, 0.5); }, "blood = -0.1 must lie within [0, 1]"},
             {[] { dermis_absorption(500., 0.1, 1.1); },
              "oxygenation = 1.1 must lie within [0, 1]"},
             {[] { blood_absorption(500., nan); }, "oxygenation = nan must lie within [0, 1]"},
             {[] { blood_absorption(500., 0.5, -150.); },
              "haemoglobin = -150 g/L must be finite and at least 0"},
             {[] { melanin_absorption(500., MelaninModel::donner_jensen, 2.); },
              "eumelanin = 2 must lie within [0, 1]"},
         })
        EXPECT_EQ(test::error_of(call), expected);
}

}  // namespace nacre
