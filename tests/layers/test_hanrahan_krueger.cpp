#include "nacre/layers/hanrahan_krueger.h"

#include <limits>

#include "nacre/layers/layer_walk.h"
#include "nacre/math/quadrature.h"
#include "nacre/optics/phase.h"
#include "tests/layers/layer_vectors.h"
#include "tests/reflectance/chi_square.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

using test::degree;
using test::direction;
using Slab = HanrahanKrueger<double>;

Vec3d below(const Vec3d& w) { return {w.x, w.y, -w.z}; }

Slab slab(double albedo, double tau, double g, double eta = 1.) { return {albedo, tau, {g}, eta}; }

LayerStack stack_of(const Slab& s) {
    return {{{.sigma_s = s.albedo,
              .sigma_a = 1. - s.albedo,
              .g = s.phase.g,
              .thickness = s.tau,
              .eta = s.eta}}};
}

/// Three layers of different indices between different half spaces, one of them rarer than air.
LayerStack uneven_stack() {
    return {{{.sigma_s = 2., .sigma_a = 0.5, .g = 0.7, .thickness = 0.2, .eta = 1.5},
             {.sigma_s = 1., .sigma_a = 0.1, .g = -0.4, .thickness = 0.5, .eta = 0.9},
             {.sigma_s = 0.5, .sigma_a = 0.3, .g = 0.2, .thickness = 0.3, .eta = 1.3}},
            1.,
            1.2};
}

TEST(HanrahanKrueger, AgreesWithTheReference) {
    int checked = 0;
    for (const auto& row : test::layer_vectors("hanrahan_krueger")["slabs"]) {
        const Slab s = slab(row["W"], row["tau"], row["g"], row["n"]);
        const HanrahanKruegerStack stack(stack_of(s));
        const Vec3d wi = direction(row["theta_i"], 0.);
        for (const auto& sample : row["samples"]) {
            // The vectors' azimuth is that of propagation: phi = 0 is the mirror side.
            const Vec3d wo = direction(sample["theta_o"], double(sample["phi"]) + 180.);
            const double f_r = sample["f_r"], f_t = sample["f_t"];
            EXPECT_NEAR(s.eval(wi, wo), f_r, 1e-9 * f_r) << row;
            EXPECT_NEAR(s.eval(wi, below(wo)), f_t, 1e-9 * f_t) << row;
            EXPECT_NEAR(stack.eval(wi, wo), f_r, 1e-9 * f_r) << row;
            EXPECT_NEAR(stack.eval(wi, below(wo)), f_t, 1e-9 * f_t) << row;
            ++checked;
        }
        if (!row.contains("rho_r_1")) continue;
        const LayerTotals t = stack.totals(wi.z);
        EXPECT_NEAR(t.reflectance, double(row["rho_r_1"]), 1e-9) << row;
        EXPECT_NEAR(t.transmittance - t.unscattered, double(row["rho_t_1"]), 1e-9) << row;
        EXPECT_NEAR(t.unscattered, double(row["unscattered_T"]), 1e-9);
        EXPECT_NEAR(s.unscattered(wi.z), double(row["unscattered_T"]), 1e-9);
        EXPECT_EQ(t.specular, 0.);
    }
    EXPECT_EQ(checked, 54 * 6);
}

// The renderer's types: directions in single precision, four thicknesses and albedos at once.
TEST(HanrahanKrueger, FourWavelengthsAgreeWithDoublePrecision) {
    const Spectral albedo(0.2f, 0.9f, 1.f, 0.f),
        tau(1e-7f, 0.3f, 40.f, std::numeric_limits<float>::infinity());
    for (const float eta : {1.f, 1.4f}) {
        const HanrahanKrueger<float, Spectral, PhaseFunction> four{
            albedo, tau, PhaseFunction::henyey_greenstein(0.3f), eta};
        for (const double theta : {0., 3., 30., 30.001, 80., 89.})
            for (const bool through : {false, true}) {
                const Vec3d wi = direction(30., 10.);
                const Vec3d wo = through ? below(direction(theta, 10.)) : direction(theta, 10.);
                const Spectral f = four.eval(Vec3f(wi), Vec3f(wo));
                for (int c = 0; c < 4; ++c) {
                    const double expected =
                        slab(albedo[c], tau[c], 0.3f, eta).eval(Vec3d(Vec3f(wi)), Vec3d(Vec3f(wo)));
                    EXPECT_NEAR(f[c], expected, 2e-5 * expected + 1e-12) << theta << " " << c;
                }
            }
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(four.unscattered(0.6f)[c], slab(0., tau[c], 0.3, eta).unscattered(0.6f),
                        1e-6);
    }
}

TEST(HanrahanKrueger, IsReciprocal) {
    const HanrahanKruegerStack stack(uneven_stack());
    for (const double eta : {1., 1.5, 0.8})
        for (const double a : {0., 25., 60., 85.})
            for (const double b : {10., 25., 75.})
                for (const bool through : {false, true}) {
                    const Vec3d wi = direction(a, 20.);
                    const Vec3d wo = through ? below(direction(b, 130.)) : direction(b, 130.);
                    const Slab s = slab(0.8, 1.3, 0.5, eta);
                    EXPECT_NEAR(s.eval(wi, wo), s.eval(wo, wi), 1e-14);
                    const double n2 = through ? 1.2 * 1.2 : 1.;
                    EXPECT_NEAR(stack.eval(wi, wo) / n2, stack.eval(wo, wi), 1e-14);
                }
}

TEST(HanrahanKrueger, ThinLayersScatterInProportionToTheirThickness) {
    for (const double tau : {1e-4, 1e-8, 1e-12, 1e-300})
        for (const double theta : {0., 20., 70.}) {
            const Vec3d wi = direction(40., 0.), wo = direction(theta, 60.);
            const Slab s = slab(0.6, tau, 0.4);
            const auto expected = [&](const Vec3d& out) {
                return 0.6 * tau * s.phase.eval(-dot(wi, out)) / (wi.z * wo.z);
            };
            EXPECT_NEAR(s.eval(wi, wo) / expected(wo), 1., 8. * tau + 1e-14);
            EXPECT_NEAR(s.eval(wi, below(wo)) / expected(below(wo)), 1., 8. * tau + 1e-14);
        }
    EXPECT_EQ(slab(0.6, 0., 0.4).eval(direction(40., 0.), direction(20., 0.)), 0.);
}

TEST(HanrahanKrueger, ThickLayersReflectAsHalfSpaces) {
    const Vec3d wi = direction(40., 0.), wo = direction(70., 50.);
    for (const double tau : {60., 1e5, inf}) {
        const Slab s = slab(0.9, tau, 0.);
        // Lommel and Seeliger's law.
        EXPECT_NEAR(s.eval(wi, wo), 0.9 / (4. * std::numbers::pi) / (wi.z + wo.z), 1e-15);
        EXPECT_NEAR(s.eval(wi, below(wo)), 0., 1e-20);
        EXPECT_NEAR(s.unscattered(wi.z), 0., 1e-20);
    }
    // Isotropic half space: rho = W/2 (1 - m ln(1 + 1/m)).
    const double m = wi.z;
    const HanrahanKruegerStack half(
        LayerStack{{{.sigma_s = 0.9, .sigma_a = 0.1, .thickness = inf}}});
    EXPECT_NEAR(half.totals(m).reflectance, 0.45 * (1. - m * std::log1p(1. / m)), 1e-10);
    EXPECT_EQ(half.totals(m).transmittance, 0.);
}

// The quotient of differences and its limit are one formula here; the textbook form confirms it
// from afar and the limit at equal cosines.
TEST(HanrahanKrueger, TransmissionIsSmoothAtEqualCosines) {
    const double mi = std::cos(40. * degree), tau = 1.7;
    const auto factor = [&](double mo) { return single_scattering(mi, mo, tau, 0.); };
    EXPECT_NEAR(factor(mi), tau * std::exp(-tau / mi) / (mi * mi), 1e-15);
    for (double step = 1e-15; step < 0.1; step *= 10.) {
        // Taylor's second term has the same size for both signs.
        EXPECT_NEAR(0.5 * (factor(mi + step) + factor(mi - step)), factor(mi),
                    2. * step * step + 1e-15);
        if (step > 1e-3) {
            const double mo = mi + step;
            EXPECT_NEAR(factor(mo), (std::exp(-tau / mi) - std::exp(-tau / mo)) / (mi - mo), 1e-12);
        }
    }
}

TEST(HanrahanKrueger, IsFiniteEverywhere) {
    for (const double tau : {0., 1e-300, 1., 1e300, inf})
        for (const double eta : {1., 1.5, 0.6})
            for (const double theta : {0., 89.999999, 90.})
                for (const bool through : {false, true}) {
                    const Vec3d wi = direction(theta, 0.), wo = direction(theta, 180.);
                    const double f = slab(1., tau, 0.9, eta).eval(wi, through ? below(wo) : wo);
                    EXPECT_TRUE(std::isfinite(f)) << tau << " " << eta << " " << theta;
                    EXPECT_GE(f, 0.);
                    EXPECT_TRUE(std::isfinite(slab(1., tau, 0.9, eta).unscattered(wi.z)));
                }
    EXPECT_EQ(slab(1., 1., 0.).eval({1., 0., 0.}, direction(10., 0.)), 0.);
}

TEST(HanrahanKrueger, GroupingOfEqualLayersDoesNotMatter) {
    const Layer l{.sigma_s = 2., .sigma_a = 0.7, .g = 0.6, .thickness = 0.9, .eta = 1.4};
    Layer a = l, b = l, c = l;
    a.thickness = 0.2, b.thickness = 0.5, c.thickness = 0.2;
    const Layer other{.sigma_s = 1., .g = -0.2, .thickness = 0.4, .eta = 1.2};
    const HanrahanKruegerStack whole(LayerStack{{l, other}, 1., 1.1}),
        cut(LayerStack{{a, b, c, other}, 1., 1.1});
    for (const double theta : {5., 40., 80.}) {
        const Vec3d wi = direction(40., 0.), wo = direction(theta, 100.);
        EXPECT_NEAR(cut.eval(wi, wo), whole.eval(wi, wo), 1e-14);
        EXPECT_NEAR(cut.eval(wi, below(wo)), whole.eval(wi, below(wo)), 1e-14);
    }
    EXPECT_NEAR(cut.totals(0.5).reflectance, whole.totals(0.5).reflectance, 1e-12);
    EXPECT_NEAR(cut.totals(0.5).transmittance, whole.totals(0.5).transmittance, 1e-12);
}

TEST(HanrahanKrueger, ALayerBeneathIsSeenThroughTheOneAbove) {
    // An absorbing layer above: the BSDF below it times the attenuation on the way in and out.
    const Layer filter{.sigma_a = 1.5, .thickness = 0.3};
    const Layer matter{.sigma_s = 1., .sigma_a = 0.2, .g = 0.3, .thickness = 0.8};
    const HanrahanKruegerStack both(LayerStack{{filter, matter}}), one(LayerStack{{matter}});
    const Vec3d wi = direction(30., 0.), wo = direction(60., 90.);
    const double in = std::exp(-0.45 / wi.z), out = std::exp(-0.45 / wo.z);
    EXPECT_NEAR(both.eval(wi, wo), in * out * one.eval(wi, wo), 1e-15);
    EXPECT_NEAR(both.eval(wi, below(wo)), in * one.eval(wi, below(wo)), 1e-15);
    EXPECT_NEAR(both.eval(below(wi), below(wo)), one.eval(wi, wo), 1e-15);
}

TEST(HanrahanKrueger, TotalReflectionHidesWhatLiesBeneath) {
    // From glass onto a layer of index 1.1: critical angle 47.2 degrees.
    const HanrahanKruegerStack stack(
        LayerStack{{{.sigma_s = 1., .thickness = 1., .eta = 1.1}}, 1.5, 1.5});
    EXPECT_GT(stack.eval(direction(47., 0.), direction(10., 0.)), 0.);
    EXPECT_EQ(stack.eval(direction(48., 0.), direction(10., 0.)), 0.);
    EXPECT_EQ(stack.eval(direction(10., 0.), direction(48., 0.)), 0.);
    const LayerTotals t = stack.totals(std::cos(48. * degree));
    EXPECT_EQ(t.specular, 1.);
    EXPECT_EQ(t.reflectance, 1.);
    EXPECT_EQ(t.transmittance, 0.);
}

// Hemispherical totals against a plain product rule over both angles, without the closed form of
// the azimuth and the graded panels.
TEST(HanrahanKrueger, TotalsAreTheIntegralOfTheBsdf) {
    const GaussLegendre nodes(64);
    for (const LayerStack& layers :
         {uneven_stack(), stack_of(slab(0.9, 0.7, 0.5, 1.5)), stack_of(slab(1., 2., 0.2))}) {
        const HanrahanKruegerStack stack(layers);
        const Vec3d wi = direction(50., 0.);
        const auto hemisphere = [&](bool through) {
            // In the angle; two panels end where the rarer middle layer of index 0.9 mirrors all.
            const auto ring = [&](double theta) {
                return std::sin(theta) * std::cos(theta) *
                       nodes.integrate(0., std::numbers::pi, [&](double phi) {
                           const Vec3d wo = direction(theta / degree, phi / degree);
                           return 2. * stack.eval(wi, through ? below(wo) : wo);
                       });
            };
            double sum = 0., from = 0.;
            const double n = through ? layers.eta_below : layers.eta_above;
            for (const double to : {std::asin(std::min(1., 0.9 / n)),
                                    std::asin(std::min(1., 1. / n)), std::numbers::pi / 2.})
                sum += nodes.integrate(from, to, ring), from = to;
            return sum;
        };
        const LayerTotals t = stack.totals(wi.z);
        EXPECT_NEAR(t.reflectance - t.specular, hemisphere(false), 2e-6);
        EXPECT_NEAR(t.transmittance - t.unscattered, hemisphere(true), 2e-6);
        EXPECT_GT(t.absorptance, 0.);
        EXPECT_NEAR(t.reflectance + t.transmittance + t.absorptance, 1., 1e-15);
    }
}

// All light of a nearly black slab that was scattered at all was scattered once.
TEST(HanrahanKrueger, IsTheWalkOfANearlyBlackSlab) {
    for (const double eta : {1., 1.4}) {
        const Slab s = slab(0.004, 1., 0.4, eta);
        const LayerWalkResult walk = layer_walk(stack_of(s), {.photons = 200000,
                                                              .seed = 11,
                                                              .cosine = std::cos(40. * degree),
                                                              .cosine_bins = 4,
                                                              .azimuth_bins = 4});
        const Vec3d wi = direction(40., 0.);
        const GaussLegendre nodes(8);
        int wrong = 0;
        for (const bool through : {false, true})
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 4; ++column) {
                    const double first = nodes.integrate(row / 4., (row + 1) / 4., [&](double z) {
                        return nodes.integrate(column * 90., (column + 1) * 90., [&](double p) {
                            const Vec3d wo = direction(std::acos(z) / degree, p);
                            return z * degree * s.eval(wi, through ? below(wo) : wo);
                        });
                    });
                    const Estimate bin = (through ? walk.transmitted : walk.reflected)
                                             .at(std::size_t(row), std::size_t(column));
                    // Scattered again is at most W = 0.4 % of what is scattered once. With
                    // boundaries the walk has what they mirror back as well, so the first order is
                    // a part.
                    const double noise = 4. * bin.error;
                    wrong += bin.mean < first - noise;
                    if (eta == 1.) wrong += bin.mean > first * 1.004 + noise;
                }
        // 4 sigma: one of 32 bins fails by chance with probability 0.2 %.
        EXPECT_EQ(wrong, 0) << eta;
    }
}

TEST(HanrahanKrueger, SamplesWhatItsDensitySays) {
    const auto check = [](const auto& s, const char* name) {
        for (const Vec3d& wo :
             {direction(10., 30.), direction(70., -60.), below(direction(35., 0.))}) {
            const Vec3f viewer(wo);
            const auto result = test::chi_square(
                [&](Random& random) -> std::optional<Vec3f> {
                    const Vec3f w = s.sample(viewer, random.next2());
                    return w.z != 0.f ? std::optional(w) : std::nullopt;
                },
                [&](const Vec3f& wi) { return s.pdf(wi, viewer); }, 5, 30000, 24, 24);
            EXPECT_GT(result.p, test::sidak(12)) << name << " " << wo.z;
            EXPECT_NEAR(result.integral, result.drawn, 0.015) << name << " " << wo.z;
        }
    };
    using Any = HanrahanKrueger<float, float, PhaseFunction>;
    check(Any{0.9f, 1.f, PhaseFunction::isotropic()}, "isotropic");
    check(Any{0.9f, 1.f, PhaseFunction::mie_hazy()}, "mie_hazy");
    check(Any{0.9f, 1.f, PhaseFunction::henyey_greenstein(-0.4f), 1.5f}, "hg in glass");
    check(Any{0.9f, 1.f, PhaseFunction::schlick(0.5f), 1.1f}, "schlick in water");
}

// In single precision: without boundaries every sample has a direction, however grazing.
TEST(HanrahanKrueger, SamplesKeepGrazingDirections) {
    const HanrahanKrueger<float, float, PhaseFunction> fog{0.9f, 1.f, PhaseFunction::isotropic()};
    const Slab exact = slab(0.9, 1., 0.);
    const Vec3f wo(direction(70., 0.));
    Random random(stream_key(6, 1));
    int lost = 0;
    double worst = 0.;
    for (int i = 0; i < 200000; ++i) {
        const Vec2f u = random.next2();
        const Vec3f w = fog.sample(wo, u);
        lost += w.z == 0.f;
        worst = std::max(worst, std::abs(w.z - exact.sample(direction(70., 0.), {u.x, u.y}).z));
    }
    EXPECT_EQ(lost, 0);
    EXPECT_LT(worst, 1e-6);
}

TEST(HanrahanKrueger, SamplesNothingWhereNothingEnters) {
    const Slab bubble = slab(0.9, 1., 0.3, 0.8);
    EXPECT_EQ(bubble.sample(direction(70., 0.), {0.3, 0.6}), Vec3d());
    EXPECT_EQ(bubble.pdf(direction(20., 0.), direction(70., 0.)), 0.);
    EXPECT_EQ(bubble.pdf(direction(70., 0.), direction(20., 0.)), 0.);
    EXPECT_GT(bubble.pdf(direction(50., 0.), direction(20., 0.)), 0.);
}

TEST(HanrahanKrueger, SamplesHaveTheMeanOfTheTotalsAndBoundedWeight) {
    for (const double eta : {1., 1.5, 0.9}) {
        const Slab s = slab(0.8, 1.5, 0.6, eta);
        const LayerTotals t = HanrahanKruegerStack(stack_of(s)).totals(0.6);
        const Vec3d wo{0.8, 0., 0.6};
        Random random(stream_key(4, 2));
        const int n = 40000;
        double sums[2] = {}, squares[2] = {};
        for (int i = 0; i < n; ++i) {
            const Vec2f u = random.next2();
            const Vec3d wi = s.sample(wo, {u.x, u.y});
            if (wi.z == 0.) continue;
            ASSERT_NEAR(length(wi), 1., 1e-12);
            const double weight = s.eval(wi, wo) * std::abs(wi.z) / s.pdf(wi, wo);
            ASSERT_GE(weight, 0.);
            ASSERT_LE(weight, 0.8 + 1e-12);
            sums[wi.z < 0.] += weight;
            squares[wi.z < 0.] += weight * weight;
        }
        const double expected[2] = {t.reflectance - t.specular, t.transmittance - t.unscattered};
        for (int side = 0; side < 2; ++side) {
            const double mean = sums[side] / n;
            const double error = std::sqrt((squares[side] / n - mean * mean) / n);
            EXPECT_NEAR(mean, expected[side], 4. * error) << eta << " " << side;
        }
    }
}

// What the paper's figures show, from numbers: reflection grows with thickness, transmission rises
// and falls, and radiance reflected per incident radiance falls with the angle of incidence
// although the albedo does not.
TEST(HanrahanKrueger, LobesBehaveAsInThePaper) {
    const auto totals = [](double tau, double g, double theta) {
        return HanrahanKruegerStack(stack_of(slab(1., tau, g))).totals(std::cos(theta * degree));
    };
    for (const double g : {-0.3, 0., 0.6}) {
        EXPECT_LT(totals(0.5, g, 40.).reflectance, totals(1., g, 40.).reflectance);
        EXPECT_LT(totals(1., g, 40.).reflectance, totals(2., g, 40.).reflectance);
        const auto scattered = [&](double tau) {
            const LayerTotals t = totals(tau, g, 40.);
            return t.transmittance - t.unscattered;
        };
        EXPECT_LT(scattered(0.1), scattered(0.7));
        EXPECT_GT(scattered(1.), scattered(3.));
    }
    const double albedos[] = {0.1436, 0.1704, 0.2392}, per_radiance[] = {.0185, .0155, .0089};
    const double angles[] = {10., 40., 65.};
    const Slab water = slab(1., 1., 0., 1.33);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(totals(1., 0., angles[i]).reflectance, albedos[i], 5e-5);
        const Vec3d wi = direction(angles[i], 0.);
        EXPECT_NEAR(water.eval(wi, {0., 0., 1.}) * wi.z, per_radiance[i], 5e-5);
    }
}

TEST(HanrahanKrueger, StacksAreChecked) {
    EXPECT_EQ(test::error_of([] { HanrahanKruegerStack(LayerStack{}); }),
              "a stack needs at least one layer");
}

}  // namespace
}  // namespace nacre
