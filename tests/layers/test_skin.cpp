#include "nacre/layers/skin.h"

#include <gtest/gtest.h>

#include "nacre/math/error.h"
#include "tests/support/constants.h"

namespace nacre {

namespace {

double reduced_scattering(const Layer& layer) { return (1. - layer.g) * layer.sigma_s; }

double reduced_albedo(const Layer& layer) {
    return reduced_scattering(layer) / (reduced_scattering(layer) + layer.sigma_a);
}

SkinParameters with_melanin(double melanin) {
    SkinParameters skin;
    skin.epidermis.melanin = melanin;
    return skin;
}

/// The same matter in all five layers.
SkinParameters uniform() {
    SkinParameters skin;
    for (SkinLayer* layer : {&skin.stratum_corneum, &skin.epidermis, &skin.papillary_dermis,
                             &skin.reticular_dermis, &skin.hypodermis}) {
        layer->melanin = 0.01;
        layer->blood = 0.02;
    }
    return skin;
}

}  // namespace

TEST(Skin, LayersHoldWhatTheirParametersSay) {
    SkinParameters skin;
    skin.reticular_dermis.scattering = 0.5;
    const double nm = 580.;
    const LayerStack stack = skin_stack(skin, nm);
    EXPECT_NO_THROW(check(stack));
    ASSERT_EQ(stack.layers.size(), 5u);
    const SkinLayer* given[] = {&skin.stratum_corneum, &skin.epidermis, &skin.papillary_dermis,
                                &skin.reticular_dermis, &skin.hypodermis};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(stack.layers[i].thickness, given[i]->thickness);
        EXPECT_EQ(stack.layers[i].eta, given[i]->eta);
        EXPECT_EQ(stack.layers[i].g, skin_anisotropy(nm));
        EXPECT_NEAR(reduced_scattering(stack.layers[i]),
                    given[i]->scattering * dermis_reduced_scattering(nm), 1e-13);
    }
    EXPECT_NEAR(stack.layers[0].sigma_a, baseline_absorption(nm), 1e-13);
    EXPECT_NEAR(stack.layers[1].sigma_a, epidermis_absorption(nm, 0.03), 1e-13);
    EXPECT_NEAR(stack.layers[2].sigma_a, dermis_absorption(nm, 0.012, 0.75), 1e-13);
    EXPECT_NEAR(stack.layers[3].sigma_a, dermis_absorption(nm, 0.009, 0.75), 1e-13);
    EXPECT_NEAR(stack.layers[4].sigma_a, dermis_absorption(nm, 0.009, 0.75), 1e-13);
    EXPECT_EQ(stack.eta_above, 1.);
    EXPECT_EQ(stack.eta_below, skin.hypodermis.eta);
}

TEST(Skin, ModelsReachTheLayers) {
    SkinParameters skin;
    skin.melanin_model = MelaninModel::donner_jensen;
    skin.eumelanin = 0.25;
    skin.baseline_model = BaselineModel::power;
    skin.scattering_model = SkinScattering::donner_jensen;
    skin.haemoglobin = 120.;
    skin.oxygenation = 0.6;
    const double nm = 500., base = baseline_absorption(nm, BaselineModel::power);
    const LayerStack stack = skin_stack(skin, nm);
    EXPECT_NEAR(stack.layers[1].sigma_a,
                0.03 * melanin_absorption(nm, MelaninModel::donner_jensen, 0.25) + 0.97 * base,
                1e-13);
    EXPECT_NEAR(stack.layers[2].sigma_a, 0.012 * blood_absorption(nm, 0.6, 120.) + 0.988 * base,
                1e-13);
    EXPECT_NEAR(reduced_scattering(stack.layers[1]), 2. * reduced_scattering(stack.layers[2]),
                1e-13);
}

TEST(Skin, OneMediumOfUniformLayersIsTheirMatter) {
    // Whatever the thicknesses, equal layers are one half space.
    for (double nm = 360.; nm <= 830.; nm += 10.) {
        const Layer one = skin_coefficients(uniform(), nm);
        const Layer dermis = skin_stack(uniform(), nm).layers[3];
        EXPECT_EQ(one.thickness, inf);
        EXPECT_EQ(one.g, dermis.g);
        EXPECT_NEAR(one.sigma_s, dermis.sigma_s, 1e-12);
        EXPECT_NEAR(one.sigma_a, dermis.sigma_a, 1e-11 * dermis.sigma_a);
    }
}

TEST(Skin, OneMediumGoesFromTheLowerLayersToTheEpidermis) {
    const double nm = 550.;
    SkinParameters skin = with_melanin(0.1);
    const Layer epidermis = skin_stack(skin, nm).layers[1];
    // No light gets through a thick epidermis. It lies below the stratum corneum, made thin here.
    skin.stratum_corneum.thickness = 1e-9;
    skin.epidermis.thickness = 50.;
    EXPECT_NEAR(skin_coefficients(skin, nm).sigma_a, epidermis.sigma_a, 1e-6 * epidermis.sigma_a);
    // A thin one hardly counts.
    skin.epidermis.thickness = 1e-9;
    skin.papillary_dermis.blood = skin.reticular_dermis.blood;
    EXPECT_NEAR(skin_coefficients(skin, nm).sigma_a, dermis_absorption(nm, 0.009, 0.75), 1e-6);
}

TEST(Skin, ThinFilterIsPassedTwice) {
    // To first order in its thickness a layer takes sigma_a d from the flux for every fluence, so
    // that Y grows by sigma_a d less what its own half space would lead: dY = (sigma_a - 3 sigma_t'
    // Y^2) d, from Fick's law and the balance of energy.
    const double nm = 600., d = 1e-6;
    SkinParameters skin = with_melanin(0.2);
    skin.papillary_dermis.blood = skin.reticular_dermis.blood;
    skin.stratum_corneum.thickness = skin.epidermis.thickness = 1e-12;
    const auto admittance = [&] {
        return std::sqrt((1. - reduced_albedo(skin_coefficients(skin, nm))) / 3.);
    };
    const double y = admittance();
    skin.epidermis.thickness = d;
    const Layer layer = skin_stack(skin, nm).layers[1];
    const double sigma_t = reduced_scattering(layer) + layer.sigma_a;
    const double slope = (layer.sigma_a - 3. * sigma_t * y * y);
    EXPECT_NEAR((admittance() - y) / d, slope, 1e-4 * slope);
}

TEST(Skin, MelaninDarkensAtEveryWavelength) {
    for (double nm = 360.; nm <= 830.; nm += 10.) {
        double before = 1.;
        for (const double melanin : {0., 0.013, 0.03, 0.063, 0.16, 0.3, 0.43, 1.}) {
            const double albedo = reduced_albedo(skin_coefficients(with_melanin(melanin), nm));
            EXPECT_LT(albedo, before) << melanin << " at " << nm;
            EXPECT_GT(albedo, 0.);
            before = albedo;
        }
    }
}

TEST(Skin, BloodShowsItsDoubleBand) {
    // Minima of the albedo at 542 and 576 nm, and none without blood.
    SkinParameters skin = with_melanin(0.013);
    const auto minima = [&] {
        std::vector<double> found;
        const auto albedo = [&](double nm) { return reduced_albedo(skin_coefficients(skin, nm)); };
        for (double nm = 500.; nm <= 620.; nm += 1.)
            if (albedo(nm) < albedo(nm - 1.) && albedo(nm) <= albedo(nm + 1.)) found.push_back(nm);
        return found;
    };
    EXPECT_EQ(minima(), (std::vector{542., 576.}));
    for (SkinLayer* layer : {&skin.papillary_dermis, &skin.reticular_dermis, &skin.hypodermis})
        layer->blood = 0.;
    EXPECT_EQ(minima(), std::vector<double>{});
}

TEST(Skin, AnInfiniteHypodermisIsAllowed) {
    SkinParameters skin;
    const Layer deep = skin_coefficients(skin, 700.);
    skin.hypodermis.thickness = inf;
    EXPECT_NO_THROW(check(skin_stack(skin, 700.)));
    EXPECT_EQ(skin_coefficients(skin, 700.).sigma_a, deep.sigma_a);
}

TEST(Skin, WrongInputIsExplained) {
    using Change = void (*)(SkinParameters&);
    for (const auto& [change, expected] : std::initializer_list<std::pair<Change, const char*>>{
             {[](SkinParameters& s) { s.epidermis.melanin = 1.5; },
              "epidermis: melanin = 1.5 must lie within [0, 1]"},
             {[](SkinParameters& s) { s.epidermis.melanin = nan; },
              "epidermis: melanin = nan must lie within [0, 1]"},
             {[](SkinParameters& s) { s.papillary_dermis.blood = -0.01; },
              "papillary dermis: blood = -0.01 must lie within [0, 1]"},
             {[](SkinParameters& s) { s.hypodermis.blood = 0.6, s.hypodermis.melanin = 0.6; },
              "hypodermis: melanin + blood = 1.2 must be at most 1"},
             {[](SkinParameters& s) { s.stratum_corneum.thickness = -0.01; },
              "stratum corneum: thickness = -0.01 must be positive"},
             {[](SkinParameters& s) { s.epidermis.thickness = 0.; },
              "epidermis: thickness = 0 must be positive"},
             {[](SkinParameters& s) { s.hypodermis.thickness = nan; },
              "hypodermis: thickness = nan must be positive"},
             {[](SkinParameters& s) { s.reticular_dermis.thickness = inf; },
              "reticular dermis: thickness = inf must be finite, except in the hypodermis"},
             {[](SkinParameters& s) { s.reticular_dermis.eta = 0.9; },
              "reticular dermis: eta = 0.9 must lie within [1, 2]"},
             {[](SkinParameters& s) { s.epidermis.eta = nan; },
              "epidermis: eta = nan must lie within [1, 2]"},
             {[](SkinParameters& s) { s.hypodermis.scattering = 0.; },
              "hypodermis: scattering = 0 must be positive and finite"},
             {[](SkinParameters& s) { s.hypodermis.scattering = inf; },
              "hypodermis: scattering = inf must be positive and finite"},
             {[](SkinParameters& s) { s.oxygenation = 1.01; },
              "skin: oxygenation = 1.01 must lie within [0, 1]"},
             {[](SkinParameters& s) { s.haemoglobin = -1.; },
              "skin: haemoglobin = -1 must be finite and at least 0"},
             {[](SkinParameters& s) { s.eumelanin = nan; },
              "skin: eumelanin = nan must lie within [0, 1]"},
         }) {
        SkinParameters skin;
        change(skin);
        for (const bool stack : {true, false}) {
            std::string error = "no error";
            try {
                stack ? void(skin_stack(skin, 500.)) : void(skin_coefficients(skin, 500.));
            } catch (const InputError& e) {
                error = e.what();
            }
            EXPECT_EQ(error, expected);
        }
    }
    EXPECT_THROW(skin_stack({}, 300.), InputError);
}

}  // namespace nacre
