#include "nacre/layers/slab_monte_carlo.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "nacre/layers/adding_doubling.h"
#include "nacre/math/quadrature.h"
#include "tests/layers/slab_reference.h"
#include "tests/support/constants.h"

namespace nacre {

namespace {

using test::cosine_of;
using test::infinite;
using test::layer_of;

/// Standard errors that two independent numbers are apart.
double apart(double a, double error_a, double b, double error_b) {
    return std::abs(a - b) / std::sqrt(error_a * error_a + error_b * error_b + 1e-30);
}

/// Some 200 comparisons below use this: at 4.5 standard errors one of them fails falsely with a
/// probability of 0.1 %.
constexpr double limit = 4.5;

/// What runs are compared with: totals of the same stack, within 1e-5.
constexpr double exact_error = 1e-5;
std::vector<LayerTotals> exact(const LayerStack& stack, const std::vector<double>& cosines) {
    return adding_doubling(stack, cosines, {}, {exact_error, 0}).collimated;
}

const std::vector<LayerStack>& stacks() {
    static const std::vector<LayerStack> all{
        {{layer_of(0.9, 2., 0.75, 1.)}},
        {{layer_of(0.6, 0.5, -0.4, 1.5)}, 1., 1.33},
        {{layer_of(0.9, infinite, 0., 1.5)}},
        {{layer_of(0.99, 10., 0.95, 1.4)}},
        {{layer_of(1., 3., 0.5, 1.3)}, 1.5, 1.},  // total reflection from outside
        {{{2., 0.1, 0.3, 1., 1.5}, {3., 0.2, 0.8, 2., 1.2}}, 1., 1.3},
        {{{0., 0., 0., 1., 1.5}, {1., 0.1, 0.6, 2., 1.35}, {0., 0.2, 0., 1., 1.6}}, 1., 1.},
        {{{0., 0., 0., 1., 1.5}, {0., 0., 0., 1., 1.6}, {1., 0.1, 0., 1., 1.3}}, 1.1, 1.},
        {{{10., .1, .9, 1., 1.37}, {1., .1, 0., 1., 1.37}, {1., .2, .7, 2., 1.37}}, 1., 1.},
        {{{20., .5, .8, .02, 1.55}, {15., .4, .8, .08, 1.4}, {20., .1, .8, infinite, 1.37}},
         1.,
         1.},
        {{{1., .1, 0., 1., 1.4}, {0., 0., 0., infinite, 1.33}}, 1., 1.},  // onto water
    };
    return all;
}

void expect_same(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].mean, b[i].mean) << i;
        EXPECT_EQ(a[i].error, b[i].error) << i;
    }
}

SlabBins all_bins() {
    SlabBins b;
    b.radius = 30, b.radius_width = 0.2;
    b.depth = 25, b.depth_width = 0.2;
    b.angle = 9;
    b.pairs = true;
    return b;
}

}  // namespace

TEST(SlabMonteCarlo, AgreesWithTheReference) {
    int checked = 0;
    for (const auto& row : test::slab_reference()["monte_carlo"]) {
        LayerStack stack{{}, row["n_above"], row["n_below"]};
        for (const auto& l : row["layers"])
            stack.layers.push_back({l["sigma_s"], l["sigma_a"], l["g"],
                                    l["d"].is_string() ? infinite : double(l["d"]), l["n"]});
        SlabMonteCarloOptions options;
        options.cosine = cosine_of(row["theta_i"]);
        if (row.contains("r_edges")) options.bins.radius = 48, options.bins.radius_width = 0.25;
        const auto r = slab_monte_carlo(stack, options);
        const double diffuse = r.totals.reflectance - r.totals.specular;
        EXPECT_NEAR(r.totals.specular, double(row["R_specular"]), 1e-12);
        EXPECT_LT(apart(diffuse, r.error.reflectance, row["R_diffuse"], row["R_diffuse_se"]),
                  limit);
        EXPECT_LT(apart(r.totals.transmittance, r.error.transmittance, row["T"], row["T_se"]),
                  limit);
        EXPECT_LT(apart(r.totals.absorptance, r.error.absorptance, row["A"], row["A_se"]), limit);
        ++checked;
        if (!row.contains("r_edges")) continue;
        for (std::size_t k = 0; k + 1 < row["r_edges"].size(); ++k, ++checked) {
            const auto begin = std::size_t(4. * double(row["r_edges"][k]) + 0.5);
            const auto end = std::size_t(4. * double(row["r_edges"][k + 1]) + 0.5);
            double mean = 0., variance = 0., area = 0.;
            for (std::size_t i = begin; i < end; ++i) {
                const double ring = double(2 * i + 1);
                mean += ring * r.reflected_radius[i].mean;
                variance += std::pow(ring * r.reflected_radius[i].error, 2.);
                area += ring;
            }
            EXPECT_LT(apart(mean / area, std::sqrt(variance) / area, row["R_of_r_mean_per_area"][k],
                            row["R_of_r_se"][k]),
                      limit)
                << k;
        }
    }
    EXPECT_EQ(checked, 27);
}

TEST(SlabMonteCarlo, AgreesWithAddingDoubling) {
    const std::vector<double> cosines{1., 0.4};
    for (std::size_t k = 0; k < stacks().size(); ++k) {
        const auto expected = exact(stacks()[k], cosines);
        for (std::size_t i = 0; i < 2; ++i)
            for (const bool lateral : {false, true}) {
                SlabMonteCarloOptions options;
                options.photons = 200'000;
                options.cosine = cosines[i];
                options.seed = lateral;
                if (lateral) options.bins.radius = 1, options.bins.radius_width = 1.;
                const auto r = slab_monte_carlo(stacks()[k], options);
                const LayerTotals &t = expected[i], &m = r.totals, &e = r.error;
                const auto where = [&] { return fmt::format("{} {} {}", k, cosines[i], lateral); };
                EXPECT_LT(apart(m.reflectance, e.reflectance, t.reflectance, exact_error), limit)
                    << where();
                EXPECT_LT(apart(m.transmittance, e.transmittance, t.transmittance, exact_error),
                          limit)
                    << where();
                EXPECT_NEAR(m.specular, t.specular, 1e-12) << where();
                EXPECT_NEAR(m.unscattered, t.unscattered, 1e-12) << where();
            }
    }
}

TEST(SlabMonteCarlo, EveryShareIsAccountedFor) {
    for (const LayerStack& stack : stacks()) {
        SlabMonteCarloOptions options;
        options.photons = 20'000;
        options.cosine = 0.8;
        options.bins = all_bins();
        const auto r = slab_monte_carlo(stack, options);
        double absorbed = 0., reflected = r.totals.specular, transmitted = 0.;
        for (const Estimate& e : r.absorbed) absorbed += e.mean;
        for (int i = 0; i < 9; ++i) {
            const double cone = 2. * pi * (std::cos(i * pi / 18.) - std::cos((i + 1) * pi / 18.));
            reflected += cone * r.reflected_angle[std::size_t(i)].mean;
            transmitted += cone * r.transmitted_angle[std::size_t(i)].mean;
        }
        // Weights are floats whose differences are summed.
        EXPECT_NEAR(absorbed, r.totals.absorptance, 1e-7);
        EXPECT_NEAR(reflected, r.totals.reflectance, 1e-12);
        EXPECT_NEAR(transmitted, r.totals.transmittance, 1e-12);
        // A table over two is the profile over one, summed.
        for (std::size_t i = 0; i < 30; ++i) {
            double sum = 0.;
            for (std::size_t a = 0; a < 9; ++a)
                sum += r.reflected_radius_angle[9 * i + a].mean * 2. * pi *
                       (std::cos(double(a) * pi / 18.) - std::cos(double(a + 1) * pi / 18.));
            EXPECT_NEAR(sum, r.reflected_radius[i].mean, 1e-12);
        }
    }
}

TEST(SlabMonteCarlo, ProfilesOverDepthAndRadiusAddUp) {
    const LayerStack stack{{{9., 1., 0.5, 0.7, 1.4}, {2., 0.5, 0., 1.3, 1.2}}};
    SlabMonteCarloOptions options;
    options.photons = 200'000;
    options.bins = {40, 1., 20, 0.1, 0, true};
    const auto r = slab_monte_carlo(stack, options);
    double upper = 0., lower = 0., variance = 0.;
    for (std::size_t z = 0; z < 20; ++z) {
        (z < 7 ? upper : lower) += 0.1 * r.absorbed_depth[z].mean;
        variance += std::pow(0.1 * r.absorbed_depth[z].error, 2.);
        double sum = 0.;
        for (std::size_t i = 0; i < 40; ++i)
            sum += pi * double(2 * i + 1) * r.absorbed_radius_depth[20 * i + z].mean;
        EXPECT_NEAR(sum, r.absorbed_depth[z].mean, 1e-3 * sum);  // a little lies beyond 40 mm
    }
    // By depth, roulette does not count; by layer, it does.
    EXPECT_LT(apart(upper, std::sqrt(variance), r.absorbed[0].mean, r.absorbed[0].error), limit);
    EXPECT_LT(apart(lower, std::sqrt(variance), r.absorbed[1].mean, r.absorbed[1].error), limit);
    double reflected = 0.;
    for (std::size_t i = 0; i < 40; ++i)
        reflected += pi * double(2 * i + 1) * r.reflected_radius[i].mean;
    EXPECT_NEAR(reflected, r.totals.reflectance - r.totals.specular, 1e-4);
}

TEST(SlabMonteCarlo, AbsorptionFallsByBeersLawWithoutScattering) {
    const LayerStack stack{{{0., 0.5, 0., infinite, 1.}}};
    SlabMonteCarloOptions options;
    options.cosine = 0.5;
    options.bins.depth = 10, options.bins.depth_width = 0.3;
    const auto r = slab_monte_carlo(stack, options);
    for (std::size_t i = 0; i < 10; ++i) {
        const double a = 0.3 * double(i), b = a + 0.3;  // depth over cosine times 0.5 is depth
        EXPECT_LT(apart(r.absorbed_depth[i].mean, r.absorbed_depth[i].error,
                        (std::exp(-a) - std::exp(-b)) / 0.3, 0.),
                  limit);
    }
}

TEST(SlabMonteCarlo, AnglesAgreeWithAddingDoubling) {
    const LayerStack stack{{{2., 0.1, 0.5, 1., 1.4}}, 1., 1.2};
    SlabMonteCarloOptions options;
    options.bins.angle = 9;
    const auto r = slab_monte_carlo(stack, options);
    const GaussLegendre rule(8);
    const double in[] = {1.};
    for (std::size_t bin = 0; bin < 9; ++bin) {
        const double low = cosine_of(10. * double(bin + 1)), high = cosine_of(10. * double(bin));
        std::vector<double> out;
        for (const double x : rule.node) out.push_back(low + 0.5 * (high - low) * (1. + x));
        const auto t = adding_doubling(stack, in, out, {1e-7, 0});
        double reflected = 0., transmitted = 0.;
        for (std::size_t i = 0; i < 8; ++i) {
            reflected += 0.5 * rule.weight[i] * out[i] * t.brdf[i];
            transmitted += 0.5 * rule.weight[i] * out[i] * t.btdf[i];
        }
        // The unscattered beams leave along the normal.
        if (bin == 0) continue;
        EXPECT_LT(apart(r.reflected_angle[bin].mean, r.reflected_angle[bin].error, reflected, 0.),
                  limit);
        EXPECT_LT(
            apart(r.transmitted_angle[bin].mean, r.transmitted_angle[bin].error, transmitted, 0.),
            limit);
    }
}

TEST(SlabMonteCarlo, ALeaningBeamLeavesWhereRefractionSendsIt) {
    // Nearly clear: x = d tan(refracted angle) through glass between air and water.
    const double sine = 0.8 / 1.5;
    const LayerStack stack{{{0., 0., 0., 2., 1.5}, {1e-9, 0., 0., 1., 1.2}}, 1., 1.33};
    SlabMonteCarloOptions options;
    options.photons = 10'000;
    options.cosine = 0.6;
    options.bins.radius = 10000, options.bins.radius_width = 0.001;
    options.bins.angle = 900;
    const auto r = slab_monte_carlo(stack, options);
    const double lower = 0.8 / 1.2;
    const double x =
        2. * sine / std::sqrt(1. - sine * sine) + lower / std::sqrt(1. - lower * lower);
    // Most light passes straight; of the rest each reflection comes out elsewhere.
    const auto largest = [](const std::vector<Estimate>& e, auto size) {
        std::size_t best = 0;
        for (std::size_t i = 0; i < e.size(); ++i)
            if (e[i].mean * size(i) > e[best].mean * size(best)) best = i;
        return double(best) + 0.5;
    };
    EXPECT_NEAR(
        0.001 * largest(r.transmitted_radius, [](std::size_t i) { return 2. * double(i) + 1.; }), x,
        0.001);
    EXPECT_NEAR(0.1 * largest(r.transmitted_angle, [](std::size_t i) { return double(i) + 0.5; }),
                std::asin(0.8 / 1.33) * 180. / pi, 0.1);
}

TEST(SlabMonteCarlo, IsTheSameForAnyNumberOfThreads) {
    SlabMonteCarloOptions options;
    options.photons = 70'000;
    options.bins = all_bins();
    for (const LayerStack& stack : {stacks()[0], stacks()[5]}) {
        const auto many = slab_monte_carlo(stack, options);
        tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
        const auto one = slab_monte_carlo(stack, options);
        EXPECT_EQ(one.totals.reflectance, many.totals.reflectance);
        EXPECT_EQ(one.totals.transmittance, many.totals.transmittance);
        EXPECT_EQ(one.error.absorptance, many.error.absorptance);
        expect_same(one.absorbed, many.absorbed);
        expect_same(one.reflected_radius, many.reflected_radius);
        expect_same(one.transmitted_angle, many.transmitted_angle);
        expect_same(one.absorbed_radius_depth, many.absorbed_radius_depth);
        expect_same(one.reflected_radius_angle, many.reflected_radius_angle);
        options.seed = 1;
        EXPECT_NE(slab_monte_carlo(stack, options).totals.reflectance, one.totals.reflectance);
        options.seed = 0;
    }
}

TEST(SlabMonteCarlo, MorePhotonsAreOtherPhotons) {
    // The second half of the batches must not repeat the first.
    SlabMonteCarloOptions options;
    options.photons = 1 << 20;
    const auto half = slab_monte_carlo(stacks()[0], options);
    options.photons = 1 << 21;
    const auto whole = slab_monte_carlo(stacks()[0], options);
    EXPECT_EQ(whole.photons, 2 * half.photons);
    EXPECT_NE(whole.totals.reflectance, half.totals.reflectance);
    EXPECT_NEAR(whole.error.reflectance, half.error.reflectance / std::sqrt(2.),
                0.3 * half.error.reflectance);
}

TEST(SlabMonteCarlo, StandardErrorsAreHonest) {
    // 100 runs: the mean of the squared standardised deviations is 1 +- 0.14 (three sigma: 0.42).
    const LayerStack stack{{layer_of(0.8, 2., 0.5, 1.4)}};
    const LayerTotals t = exact(stack, {1.})[0];
    double r2 = 0., t2 = 0., a2 = 0.;
    SlabMonteCarloOptions options;
    options.photons = 10'000;
    for (options.seed = 0; options.seed < 100; ++options.seed) {
        const auto r = slab_monte_carlo(stack, options);
        r2 += std::pow((r.totals.reflectance - t.reflectance) / r.error.reflectance, 2.) / 100.;
        t2 +=
            std::pow((r.totals.transmittance - t.transmittance) / r.error.transmittance, 2.) / 100.;
        a2 += std::pow((r.totals.absorptance - t.absorptance) / r.error.absorptance, 2.) / 100.;
    }
    EXPECT_NEAR(r2, 1., 0.42);
    EXPECT_NEAR(t2, 1., 0.42);
    EXPECT_NEAR(a2, 1., 0.42);
}

TEST(SlabMonteCarlo, RouletteKeepsMeans) {
    const LayerStack stack{{layer_of(0.7, infinite, 0.3, 1.3)}};
    const LayerTotals t = exact(stack, {1.})[0];
    for (const auto& [weight, gain] :
         {std::pair{1e-6, 2.}, {1e-4, 10.}, {0.1, 5.}, {0.5, 20.}, {1., 1.5}}) {
        SlabMonteCarloOptions options;
        options.photons = 500'000;
        options.roulette_weight = weight;
        options.roulette_gain = gain;
        const auto r = slab_monte_carlo(stack, options);
        EXPECT_LT(apart(r.totals.reflectance, r.error.reflectance, t.reflectance, 0.), limit)
            << weight;
    }
}

TEST(LongSlabMonteCarlo, HasNoBiasAtManyPhotons) {
    // 3e7 photons: errors of 1e-4 of the values, where single precision would begin to show.
    for (const LayerStack& stack :
         {LayerStack{{layer_of(0.9, 2., 0.75, 1.)}}, LayerStack{{layer_of(0.999, 500., 0.9, 1.4)}},
          LayerStack{{layer_of(0.9, infinite, 0., 1.5)}}}) {
        for (const bool lateral : {false, true}) {
            SlabMonteCarloOptions options;
            options.photons = 30'000'000;
            if (lateral) options.bins.radius = 1, options.bins.radius_width = 1.;
            const auto r = slab_monte_carlo(stack, options);
            const double normal[] = {1.};
            const LayerTotals t = adding_doubling(stack, normal, {}, {1e-7, 0}).collimated[0];
            EXPECT_LT(apart(r.totals.reflectance, r.error.reflectance, t.reflectance, 0.), 4.);
            EXPECT_LT(apart(r.totals.transmittance, r.error.transmittance, t.transmittance, 0.),
                      4.);
        }
    }
}

}  // namespace nacre
