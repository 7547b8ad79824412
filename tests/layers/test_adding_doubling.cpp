#include "nacre/layers/adding_doubling.h"

#include <gtest/gtest.h>

#include <sstream>

#include "nacre/math/quadrature.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"
#include "tests/layers/slab_reference.h"

namespace nacre {

namespace {

using std::numbers::pi;
using test::cosine_of;
using test::infinite;
using test::layer_of;

constexpr AddingDoublingOptions precise{1e-9, 0};

LayerTotals at_normal(const LayerStack& stack, const AddingDoublingOptions& options = precise) {
    const double normal[] = {1.};
    return adding_doubling(stack, normal, {}, options).collimated[0];
}

LayerStack slab_of(const nlohmann::json& group) {
    LayerStack stack;
    for (const auto& l : group["layers"])
        stack.layers.push_back(layer_of(l["albedo"], l["tau"], l["g"], group["n"]));
    return stack;
}

/// Stacks with every kind of index step; `absorb` is the coefficient of all layers.
std::vector<LayerStack> mixed_stacks(double absorb) {
    return {
        {{{1., absorb, 0., 1., 1.}}, 1., 1.},
        {{{8., absorb, 0.9, 1., 1.4}}, 1., 1.},
        {{{1., absorb, 0., 1., 1.}}, 1.5, 1.5},                               // total reflection
        {{{2., absorb, 0.3, 1., 1.5}, {3., absorb, 0.8, 2., 1.2}}, 1., 1.3},  // down and up
        {{{1., absorb, -0.5, 1., 1.2}, {0., absorb, 0., 1., 1.6}}, 1.1, 1.},  // clear or filter
        {{{0., absorb, 0., 1., 1.5}, {0., absorb, 0., 1., 1.6}, {1., absorb, 0., 1., 1.3}}, 1., 1.},
        {{{20., absorb, 0.8, .02, 1.55},
          {15., absorb, 0.8, .08, 1.4},
          {20., absorb, 0.95, 2., 1.37}},
         1.,
         1.37},
    };
}

}  // namespace

TEST(AddingDoubling, SlabsAgreeWithTheReference) {
    int checked = 0;
    for (const auto& group : test::slab_reference()["slab_adding_doubling"]) {
        const LayerStack stack = slab_of(group);
        std::vector<double> cosines;
        for (const auto& row : group["incidence"]) cosines.push_back(cosine_of(row["theta_i"]));
        const auto result = adding_doubling(stack, cosines, {}, precise);
        const double tolerance = double(group["quadrature_uncertainty"]) + 1e-8;
        for (std::size_t i = 0; i < cosines.size(); ++i, ++checked) {
            const auto& row = group["incidence"][i];
            const LayerTotals& t = result.collimated[i];
            EXPECT_NEAR(t.reflectance, double(row["R_total"]), tolerance) << group["layers"];
            EXPECT_NEAR(t.transmittance, double(row["T_total"]), tolerance) << group["layers"];
            EXPECT_NEAR(t.specular, double(row["R_specular"]), 1e-14);
            EXPECT_NEAR(t.unscattered, double(row["T_unscattered"]), 1e-14);
        }
        EXPECT_NEAR(result.diffuse.reflectance, double(group["R_diffuse_incidence"]), tolerance);
        EXPECT_NEAR(result.diffuse.transmittance, double(group["T_diffuse_incidence"]), tolerance);
    }
    EXPECT_EQ(checked, 40);
}

TEST(AddingDoubling, HalfSpacesAgreeWithTheReference) {
    int exact = 0, checked = 0;
    for (const auto& row : test::slab_reference()["semi_infinite"]) {
        const LayerStack stack{{layer_of(row["albedo"], infinite, row["g"], row["n"])}};
        const std::vector<double> cosines{1., cosine_of(40.)};
        const auto result = adding_doubling(stack, cosines, {}, {1e-9, 64});
        const double tolerance = double(row["uncertainty"]) + 1e-8;
        for (std::size_t i = 0; i < 2; ++i, ++checked) {
            EXPECT_NEAR(result.collimated[i].reflectance, double(row["R_total"][i]), tolerance);
            EXPECT_EQ(result.collimated[i].transmittance, 0.);
            // Isotropic, without interface: Chandrasekhar's H function.
            if (!row.contains("R_total_Hfunction_exact")) continue;
            EXPECT_NEAR(result.collimated[i].reflectance, double(row["R_total_Hfunction_exact"][i]),
                        1e-11);
            ++exact;
        }
        EXPECT_NEAR(result.diffuse.reflectance, double(row["R_diffuse_incidence"]), tolerance);
    }
    EXPECT_EQ(checked, 50);
    EXPECT_EQ(exact, 14);
}

TEST(AddingDoubling, PublishedValues) {
    const LayerTotals hulst = at_normal({{layer_of(0.9, 2., 0.75, 1.)}});
    const LayerTotals giovanelli = at_normal({{layer_of(0.9, infinite, 0., 1.5)}});
    const auto& anchors = test::slab_reference()["published_anchors"];
    EXPECT_NEAR(hulst.reflectance, double(anchors[0]["R_diffuse"]), 5.1e-6);
    EXPECT_NEAR(hulst.transmittance, double(anchors[0]["T_total"]), 5.1e-6);
    // Giovanelli's fourth digit is off by one.
    EXPECT_NEAR(giovanelli.reflectance, double(anchors[1]["R_total"]), 1e-4);
}

TEST(AddingDoubling, DefaultAccuracyIsKept) {
    for (const auto& group : test::slab_reference()["slab_adding_doubling"])
        for (const double accuracy : {1e-3, 1e-4, 1e-6}) {
            const std::vector<double> cosines{1., cosine_of(65.)};
            const auto t = adding_doubling(slab_of(group), cosines, {}, {accuracy, 0}).collimated;
            EXPECT_NEAR(t[0].reflectance, double(group["incidence"][0]["R_total"]), accuracy);
            EXPECT_NEAR(t[0].transmittance, double(group["incidence"][0]["T_total"]), accuracy);
            EXPECT_NEAR(t[1].reflectance, double(group["incidence"][3]["R_total"]), accuracy);
        }
    const auto nodes = [](double g) {
        return adding_doubling_nodes({{{1., 0., g, 1., 1.}}}, 1e-6);
    };
    EXPECT_EQ(nodes(0.), 24);
    EXPECT_EQ(nodes(0.8), 36);
    EXPECT_EQ(nodes(-0.9), 76);
    EXPECT_EQ(nodes(0.95), 157);
}

TEST(AddingDoubling, SharedTableOfPublishedSlabs) {
    std::ifstream file(NACRE_SHARED_DIR "/data/tables/slab_ground_truth.csv");
    if (!file) GTEST_SKIP() << "needs " NACRE_SHARED_DIR "/data/tables/slab_ground_truth.csv";
    int checked = 0;
    for (std::string line; std::getline(file, line);) {
        std::vector<std::string> cell;
        std::istringstream in(line);
        for (std::string c; std::getline(in, c, ',');) cell.push_back(c);
        // One layer, of quality A: 5 digits that hold.
        if (cell.size() < 13 || cell[12] != "A" || cell[4].empty()) continue;
        const double tau = cell[5] == "inf" ? infinite : std::stod(cell[5]);
        const LayerStack stack{
            {layer_of(std::stod(cell[4]), tau, std::stod(cell[6]), std::stod(cell[1]))}};
        const double cosine[] = {std::stod(cell[7])};
        const LayerTotals t = adding_doubling(stack, cosine, {}, precise).collimated[0];
        EXPECT_NEAR(t.reflectance, std::stod(cell[8]), cell[0] == "giovanelli" ? 1e-4 : 1.1e-5);
        EXPECT_NEAR(t.transmittance, std::stod(cell[9]), 1.1e-5) << cell[0];
        ++checked;
    }
    EXPECT_EQ(checked, 4);
}

TEST(AddingDoubling, SharedTableOfVanDeHulstsAngles) {
    std::ifstream file(NACRE_SHARED_DIR "/data/tables/vdh_t35_angular.csv");
    if (!file) GTEST_SKIP() << "needs " NACRE_SHARED_DIR "/data/tables/vdh_t35_angular.csv";
    std::vector<double> mu, r, t;
    for (std::string line; std::getline(file, line);) {
        double m, a, b;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &m, &a, &b) != 3) continue;
        mu.push_back(std::max(m, 1e-7));  // his value at 0 is the limit
        r.push_back(a), t.push_back(b);
    }
    ASSERT_EQ(mu.size(), 7u);
    const double normal[] = {1.};
    const auto result = adding_doubling({{layer_of(0.9, 2., 0.75, 1.)}}, normal, mu, {1e-9, 100});
    for (std::size_t i = 0; i < mu.size(); ++i) {  // his R and T are pi times ours
        EXPECT_NEAR(pi * result.brdf[i], r[i], 1.5e-5) << mu[i];
        EXPECT_NEAR(pi * result.btdf[i], t[i], 1.5e-5) << mu[i];
    }
}

TEST(AddingDoubling, WithoutAbsorptionNothingIsLost) {
    const std::vector<double> cosines{1., 0.5, 0.01};
    for (const LayerStack& stack : mixed_stacks(0.))
        for (const int nodes : {4, 16, 40}) {
            const auto result = adding_doubling(stack, cosines, {}, {1e-9, nodes});
            for (const LayerTotals& t : result.collimated) {
                EXPECT_NEAR(t.reflectance + t.transmittance, 1., 1e-12) << stack.eta_above;
                EXPECT_GE(t.reflectance, t.specular);
                EXPECT_GE(t.transmittance, t.unscattered);
            }
            EXPECT_NEAR(result.diffuse.absorptance, 0., 1e-12);
        }
    for (const double tau : {1e-8, 1e-3, 1e3, 1e6}) {
        const LayerTotals t = at_normal({{layer_of(1., tau, 0.95, 1.4)}}, {1e-9, 24});
        EXPECT_NEAR(t.reflectance + t.transmittance, 1., 1e-9) << tau;
    }
}

TEST(AddingDoubling, AHalfSpaceWithoutAbsorptionReflectsAll) {
    for (const double g : {0., 0.9})
        for (const double eta : {0.8, 1., 1.5}) {
            const double cosines[] = {1., 0.3};
            const auto r = adding_doubling({{layer_of(1., infinite, g, eta)}}, cosines);
            EXPECT_NEAR(r.collimated[0].reflectance, 1., 1e-10) << g << ' ' << eta;
            EXPECT_NEAR(r.collimated[1].reflectance, 1., 1e-10) << g << ' ' << eta;
            EXPECT_NEAR(r.diffuse.reflectance, 1., 1e-10) << g << ' ' << eta;
        }
    // R(1) = 1 - sqrt(1 - albedo) H(1), and H(1) = 2.9078 without absorption (Chandrasekhar).
    for (const double absorb : {1e-8, 1e-12, 1e-15}) {
        const LayerStack nearly{{{1., absorb, 0., infinite, 1.}}};
        EXPECT_NEAR(1. - at_normal(nearly).reflectance, 2.9078 * std::sqrt(absorb),
                    6. * absorb + 2e-8)
            << absorb;
    }
}

TEST(AddingDoubling, AThickSlabIsAHalfSpace) {
    for (const double g : {0., 0.8}) {
        const LayerTotals half = at_normal({{layer_of(0.95, infinite, g, 1.4)}});
        const LayerTotals slab = at_normal({{layer_of(0.95, 300., g, 1.4)}});
        EXPECT_NEAR(half.reflectance, slab.reflectance, 1e-12);
        EXPECT_LT(slab.transmittance, 1e-10);
        EXPECT_GT(slab.transmittance, 0.);
    }
}

TEST(AddingDoubling, AThinLayerScattersHalfOfWhatItScattersUp) {
    const double tau = 1e-7, albedo = 0.7, mu = 0.4;
    const double cosine[] = {mu};
    const LayerTotals t =
        adding_doubling({{layer_of(albedo, tau, 0., 1.)}}, cosine, {}, precise).collimated[0];
    EXPECT_NEAR(t.reflectance / (0.5 * albedo * tau / mu), 1., 1e-5);
    EXPECT_NEAR(t.absorptance / ((1. - albedo) * tau / mu), 1., 1e-5);
}

TEST(AddingDoubling, HowALayerIsCutDoesNotMatter) {
    const Layer whole{9., 1., 0.6, 1., 1.4};
    Layer part = whole;
    part.thickness = 0.25;
    const Layer rest{9., 1., 0.6, 0.75, 1.4};
    const LayerTotals one = at_normal({{whole}}), two = at_normal({{part, rest}});
    EXPECT_NEAR(one.reflectance, two.reflectance, 1e-13);
    EXPECT_NEAR(one.transmittance, two.transmittance, 1e-13);
    // Indices that differ by next to nothing
    Layer close = rest;
    close.eta = 1.4 + 1e-10;
    EXPECT_NEAR(at_normal({{part, close}}).reflectance, one.reflectance, 1e-8);
    close.eta = 1.4 + 1e-6;
    EXPECT_NEAR(at_normal({{part, close}}).reflectance, one.reflectance, 1e-5);
}

TEST(AddingDoubling, ClearLayersOnlyHaveInterfaces) {
    const Layer glass{0., 0., 0., 3., 1.5};
    for (const double c : {1., 0.5, 0.05}) {
        const double f = fresnel_dielectric(c, 1.5), cosine[] = {c};
        const LayerTotals pane = adding_doubling({{glass}}, cosine).collimated[0];
        EXPECT_NEAR(pane.reflectance, 2. * f / (1. + f), 1e-13);
        EXPECT_NEAR(pane.transmittance, (1. - f) / (1. + f), 1e-13);
        EXPECT_NEAR(pane.unscattered, pane.transmittance, 1e-13);
        EXPECT_NEAR(pane.specular, f, 1e-15);
    }
    // Several panes: the matrices and the recursion for one beam must agree.
    const LayerStack panes{{glass, {0., 0.1, 0., 1., 1.2}, {0., 0., 0., 1., 1.8}}, 1., 1.4};
    for (const double c : {1., 0.5, 0.05}) {
        const double cosine[] = {c};
        const LayerTotals t = adding_doubling(panes, cosine).collimated[0];
        EXPECT_NEAR(t.unscattered, t.transmittance, 1e-13);
        EXPECT_GT(t.absorptance, 0.01);
    }
    // The mean of 2 F / (1 + F) has no closed form; that of one interface has.
    const Layer endless{0., 0., 0., infinite, 1.5};
    const auto surface = adding_doubling({{endless}}, {}, {}, {1e-9, 64});
    EXPECT_NEAR(surface.diffuse.reflectance, diffuse_reflectance_external(1.5), 1e-8);
    EXPECT_NEAR(surface.diffuse.transmittance, 1. - diffuse_reflectance_external(1.5), 1e-8);
    // A filter: Beer's law along the refracted way.
    const Layer filter{0., 0.7, 0., 2., 1.};
    const double cosine[] = {0.5};
    EXPECT_NEAR(adding_doubling({{filter}}, cosine).collimated[0].transmittance, std::exp(-2.8),
                1e-13);
    // Air between is not nothing, but a clear layer of the neighbour's index is.
    const Layer matter = layer_of(0.9, 2., 0.5, 1.4);
    Layer clear = glass;
    clear.eta = 1.4;
    EXPECT_NEAR(at_normal({{matter, clear}}).reflectance, at_normal({{matter}}).reflectance, 1e-13);
}

TEST(AddingDoubling, IsReciprocal) {
    const std::vector<double> cosines{1., 0.6, 0.2, 0.02};
    for (const LayerStack& stack : mixed_stacks(0.1)) {
        LayerStack turned{
            {stack.layers.rbegin(), stack.layers.rend()}, stack.eta_below, stack.eta_above};
        const auto a = adding_doubling(stack, cosines, cosines),
                   b = adding_doubling(turned, cosines, cosines);
        const double ratio = std::pow(stack.eta_below / stack.eta_above, 2.);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t o = 0; o < 4; ++o) {
                const double r = a.brdf[4 * i + o], t = a.btdf[4 * i + o];
                EXPECT_NEAR(r, a.brdf[4 * o + i], 1e-11 * (1. + r)) << i << o;
                EXPECT_NEAR(t, ratio * b.btdf[4 * o + i], 1e-11 * (1. + t)) << i << o;
            }
    }
}

TEST(AddingDoubling, DistributionsAddUpToTotals) {
    const GaussLegendre rule(64);
    std::vector<double> out;
    for (const double x : rule.node) out.push_back(0.5 * (1. + x));
    // Matched outside, so that nothing but scattering turns light; an index step within.
    const LayerStack stack{{{2., 0.2, 0.4, 1., 1.3}, {3., 0.1, 0.2, 1., 1.3}}, 1.3, 1.3};
    const double in[] = {0.7};
    const auto result = adding_doubling(stack, in, out, precise);
    double r = 0., t = 0.;
    for (std::size_t i = 0; i < out.size(); ++i) {
        r += 0.5 * rule.weight[i] * 2. * pi * out[i] * result.brdf[i];
        t += 0.5 * rule.weight[i] * 2. * pi * out[i] * result.btdf[i];
    }
    const LayerTotals& totals = result.collimated[0];
    EXPECT_NEAR(r, totals.reflectance, 1e-8);
    EXPECT_NEAR(t, totals.transmittance - totals.unscattered, 1e-8);
}

TEST(AddingDoubling, DiffuseLightIsTheMeanOfBeams) {
    const GaussLegendre rule(48);
    for (const LayerStack& stack : mixed_stacks(0.1)) {
        // Cut at the critical angles, above which totals begin like a square root.
        std::vector<double> cuts{0., 1.}, in, weight, eta{stack.eta_below};
        for (const Layer& l : stack.layers) eta.push_back(l.eta);
        for (const double e : eta)
            if (e < stack.eta_above)
                cuts.push_back(std::sqrt(1. - std::pow(e / stack.eta_above, 2.)));
        std::ranges::sort(cuts);
        for (std::size_t k = 1; k < cuts.size(); ++k)
            for (std::size_t i = 0; i < rule.node.size(); ++i) {
                const double x = 0.5 * (1. + rule.node[i]), part = cuts[k] - cuts[k - 1];
                in.push_back(cuts[k - 1] + part * x * x);
                weight.push_back(part * rule.weight[i] * x * 2. * in.back());
            }
        const auto result = adding_doubling(stack, in, {}, {1e-9, 48});
        LayerTotals mean;
        for (std::size_t i = 0; i < in.size(); ++i) {
            mean.reflectance += weight[i] * result.collimated[i].reflectance;
            mean.specular += weight[i] * result.collimated[i].specular;
            mean.unscattered += weight[i] * result.collimated[i].unscattered;
        }
        EXPECT_NEAR(result.diffuse.reflectance, mean.reflectance, 2e-5);
        EXPECT_NEAR(result.diffuse.specular, mean.specular, 2e-5);
        EXPECT_NEAR(result.diffuse.unscattered, mean.unscattered, 2e-5);
    }
}

TEST(AddingDoubling, ScatteringOnceIsHanrahanAndKrueger) {
    const double albedo = 1e-7, tau = 1.3, in[] = {0.8}, out[] = {0.3, 0.9};
    const auto r = adding_doubling({{layer_of(albedo, tau, 0., 1.)}}, in, out, precise);
    for (int o = 0; o < 2; ++o) {
        const double i = in[0], m = out[o], w = albedo / (4. * pi);
        EXPECT_NEAR(r.brdf[std::size_t(o)] / albedo,
                    w / (i + m) * (1. - std::exp(-tau * (1. / i + 1. / m))) / albedo, 1e-7);
        EXPECT_NEAR(r.btdf[std::size_t(o)] / albedo,
                    w / (i - m) * (std::exp(-tau / i) - std::exp(-tau / m)) / albedo, 1e-7);
    }
}

TEST(AddingDoubling, LightThatCannotEnterIsReflected) {
    const double c[] = {0.3};  // beyond the critical angle of 1.5 to 1
    const auto r = adding_doubling({{layer_of(0.9, 1., 0., 1.)}, 1.5, 1.5}, c, c);
    EXPECT_NEAR(r.collimated[0].reflectance, 1., 1e-14);
    EXPECT_EQ(r.collimated[0].specular, 1.);
    EXPECT_EQ(r.brdf[0], 0.);
    EXPECT_EQ(r.btdf[0], 0.);
}

TEST(AddingDoubling, WrongInputIsExplained) {
    const LayerStack good{{layer_of(0.9, 1., 0., 1.)}};
    const auto fails = [&](double in, double out, AddingDoublingOptions options = {}) {
        const double i[] = {in}, o[] = {out};
        return test::error_of([&] { adding_doubling(good, i, o, options); });
    };
    EXPECT_EQ(fails(0., 1.), "the incident cosine 0 must be above 0 and at most 1");
    EXPECT_EQ(fails(1., 1.5), "the outgoing cosine 1.5 must be above 0 and at most 1");
    EXPECT_EQ(fails(std::nan(""), 1.), "the incident cosine nan must be above 0 and at most 1");
    EXPECT_EQ(fails(1., 1., {1e-10, 0}), "accuracy 1e-10 must be from 1e-9 to 0.01");
    EXPECT_EQ(fails(1., 1., {1e-4, 3}),
              "3 quadrature nodes: must be from 4 to 512, or 0 for the default");
    EXPECT_EQ(fails(1., 1., {1e-4, 513}),
              "513 quadrature nodes: must be from 4 to 512, or 0 for the default");
    EXPECT_EQ(test::error_of([&] { adding_doubling({}, {}); }), "a stack needs at least one layer");
    EXPECT_EQ(fails(1., 1.), "no error");
}

}  // namespace nacre
