#include "nacre/layers/kubelka_munk.h"

#include <limits>

#include "nacre/layers/layer_walk.h"
#include "nacre/optics/fresnel_moments.h"
#include "tests/layers/layer_vectors.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

FluxLayer layer(double S, double K, double d) { return flux_layer(kubelka_munk({S, K}, d)); }

void expect_same(const FluxLayer& a, const FluxLayer& b, double tolerance = 1e-14) {
    EXPECT_NEAR(a.reflectance_above, b.reflectance_above, tolerance);
    EXPECT_NEAR(a.reflectance_below, b.reflectance_below, tolerance);
    EXPECT_NEAR(a.transmittance_down, b.transmittance_down, tolerance);
    EXPECT_NEAR(a.transmittance_up, b.transmittance_up, tolerance);
}

TEST(KubelkaMunk, LayersAgreeWithTheReference) {
    int checked = 0;
    for (const auto& row : test::layer_vectors("kubelka_munk")["single"]) {
        const TwoStream matter{row["S"], row["K"]};
        const KubelkaMunkLayer l = kubelka_munk(matter, row["d"]);
        EXPECT_NEAR(l.reflectance, double(row["R"]), 1e-10) << row;
        EXPECT_NEAR(l.transmittance, double(row["T"]), 1e-10) << row;
        EXPECT_NEAR(l.absorptance, double(row["A"]), 1e-10) << row;
        if (row.contains("R_infinity")) {
            EXPECT_NEAR(kubelka_munk_infinite(matter), double(row["R_infinity"]), 1e-10) << row;
        }
        for (const auto& backing : row["over_backing"])
            EXPECT_NEAR(over_backing(flux_layer(l), backing["Rg"]), double(backing["R"]), 1e-10)
                << row;
        ++checked;
    }
    EXPECT_EQ(checked, 48);
}

TEST(KubelkaMunk, StacksAgreeWithTheReference) {
    int checked = 0;
    for (const auto& row : test::layer_vectors("kubelka_munk")["stacks"]) {
        FluxLayer all;
        for (const auto& l : row["layers"]) all = stacked(all, layer(l["S"], l["K"], l["d"]));
        EXPECT_NEAR(all.reflectance_above, double(row["R_top"]), 1e-10) << row;
        EXPECT_NEAR(all.reflectance_below, double(row["R_bottom"]), 1e-10) << row;
        EXPECT_NEAR(all.transmittance_down, double(row["T"]), 1e-10) << row;
        EXPECT_NEAR(all.transmittance_up, double(row["T"]), 1e-10) << row;
        EXPECT_NEAR(over_backing(all, row["backing"]), double(row["R_over_backing"]), 1e-10) << row;
        ++checked;
    }
    EXPECT_EQ(checked, 5);
}

TEST(KubelkaMunk, SurfacesAgreeWithTheReference) {
    int checked = 0;
    for (const auto& row : test::layer_vectors("kubelka_munk")["saunderson"]) {
        const Saunderson surface = saunderson(row["n"], Entry::normal);
        EXPECT_NEAR(surface.k1, double(row["k1"]), 1e-10);
        EXPECT_NEAR(surface.k2, double(row["k2"]), 1e-10);
        EXPECT_NEAR(surface.over(row["R_internal"]), double(row["R_measured"]), 1e-10) << row;
        ++checked;
    }
    EXPECT_EQ(checked, 8);
    EXPECT_EQ(saunderson(1.5).k1, diffuse_reflectance_external(1.5));
    EXPECT_EQ(saunderson(1.).k1, 0.);
    EXPECT_EQ(saunderson(1.).k2, 0.);
    for (const double eta :
         {0.7, 1.3})  // matter that returns all light returns it through any surface
        EXPECT_NEAR(saunderson(eta).over(1.), 1., 1e-14);
    // T_ext = eta^2 T_int, seen from the rarer side of either.
    EXPECT_NEAR(1. - saunderson(1.5).k1, 2.25 * (1. - saunderson(1.5).k2), 1e-12);
    EXPECT_NEAR(saunderson(1. / 1.5).k1, saunderson(1.5).k2, 1e-12);
}

TEST(KubelkaMunk, ConservesEnergyForEverySizeOfTheArguments) {
    for (const double S : {0., 1e-300, 1e-12, 1e-3, 1., 1e6, 1e150})
        for (const double K : {0., 1e-300, 1e-12, 1e-3, 1., 1e6, 1e150})
            for (const double d : {0., 1e-300, 1e-9, 1., 1e4, 1e150, inf}) {
                const KubelkaMunkLayer l = kubelka_munk({S, K}, d);
                for (const double part : {l.reflectance, l.transmittance, l.absorptance}) {
                    EXPECT_GE(part, 0.) << S << " " << K << " " << d;
                    EXPECT_LE(part, 1. + 1e-15) << S << " " << K << " " << d;
                }
                EXPECT_NEAR(l.reflectance + l.transmittance + l.absorptance, 1., 4e-15)
                    << S << " " << K << " " << d;
            }
}

TEST(KubelkaMunk, HasItsLimits) {
    for (const double d : {1e-6, 0.3, 20., 1e8}) {
        const KubelkaMunkLayer white = kubelka_munk({2., 0.}, d);
        EXPECT_NEAR(white.reflectance, 2. * d / (1. + 2. * d), 1e-15);
        EXPECT_NEAR(white.transmittance, 1. / (1. + 2. * d), 1e-15);
        EXPECT_EQ(white.absorptance, 0.);
        const KubelkaMunkLayer grey = kubelka_munk({0., 2.}, d);
        EXPECT_EQ(grey.reflectance, 0.);
        EXPECT_NEAR(grey.transmittance, std::exp(-2. * d), 1e-15);
    }
    EXPECT_EQ(kubelka_munk({2., 0.}, inf).reflectance, 1.);
    EXPECT_EQ(kubelka_munk({0., 0.}, inf).transmittance, 1.);
    EXPECT_EQ(kubelka_munk_infinite({0., 0.}), 0.);
    for (const double K : {1e-10, 0.01, 3.}) {
        const double q = K / 2., r = 1. + q - std::sqrt(q * q + 2. * q);
        EXPECT_NEAR(kubelka_munk_infinite({2., K}), r, 1e-14);
        EXPECT_EQ(kubelka_munk({2., K}, inf).reflectance, kubelka_munk_infinite({2., K}));
        EXPECT_NEAR(kubelka_munk({2., K}, 1e7).reflectance, r, 1e-14);
    }
    // A trace of absorption: A = K d to first order, whatever S.
    const KubelkaMunkLayer trace = kubelka_munk({1., 1e-14}, 1.);
    EXPECT_NEAR(trace.absorptance / 1e-14, 1., 1e-12);
}

// K = 0 and weak absorption meet, by the second-order term of the exact solution.
TEST(KubelkaMunk, IsContinuousAtVanishingAbsorptionAndScattering) {
    for (const double small : {1e-13, 1e-9, 1e-6}) {
        EXPECT_NEAR(kubelka_munk({1., small}, 2.).reflectance, 2. / 3., 3. * small + 1e-15);
        EXPECT_NEAR(kubelka_munk({small, 1.}, 2.).transmittance, std::exp(-2.), 3. * small + 1e-15);
    }
}

TEST(KubelkaMunk, OneLayerCutInTwoIsTheSame) {
    for (const double K : {0., 1e-5, 0.1, 4.})
        for (const double cut : {1e-3, 0.4, 1.9})
            expect_same(stacked(layer(1.5, K, cut), layer(1.5, K, 2. - cut)), layer(1.5, K, 2.));
    expect_same(stacked(layer(1.5, 0.2, 3.), layer(1.5, 0.2, inf)), layer(1.5, 0.2, inf));
}

TEST(KubelkaMunk, CompositionDoesNotDependOnTheGrouping) {
    const FluxLayer a = layer(0.5, 2., 0.05), b = flux_layer(saunderson(1.4)),
                    c = layer(4., 0.05, 1.5), d = flux_layer(saunderson(1. / 1.4));
    const FluxLayer whole = stacked(stacked(stacked(a, b), c), d);
    expect_same(stacked(a, stacked(b, stacked(c, d))), whole);
    expect_same(stacked(stacked(a, b), stacked(c, d)), whole);
    // Turned over, transmittance is the same without index steps (and so here, where the indices
    // outside are equal); reflectance is not.
    const FluxLayer turned = stacked(
        stacked(stacked(flux_layer(saunderson(1.4)), c), flux_layer(saunderson(1. / 1.4))), a);
    EXPECT_NEAR(turned.transmittance_down, whole.transmittance_up, 1e-14);
    EXPECT_NEAR(whole.transmittance_down, whole.transmittance_up, 1e-12);
    EXPECT_NEAR(turned.reflectance_above, whole.reflectance_below, 1e-14);
    EXPECT_GT(std::abs(whole.reflectance_above - whole.reflectance_below), 0.1);
}

TEST(KubelkaMunk, PerfectMirrorsShutLightOut) {
    const FluxLayer mirror{1., 1., 0., 0.};
    const FluxLayer both = stacked(mirror, mirror);
    EXPECT_EQ(both.reflectance_above, 1.);
    EXPECT_EQ(both.transmittance_down, 0.);
    EXPECT_EQ(over_backing(layer(1., 0., inf), 1.), 1.);
}

TEST(KubelkaMunk, MappingsAreTheNamedOnes) {
    const TwoStream diffusion = two_stream(10., 0.2, 0.9, TwoStreamMapping::diffusion);
    EXPECT_NEAR(diffusion.S, 0.75 - 0.05, 1e-15);
    EXPECT_EQ(diffusion.K, 0.4);
    const TwoStream reduced = two_stream(10., 0.2, 0.9, TwoStreamMapping::reduced);
    EXPECT_NEAR(reduced.S, 1., 1e-15);
    EXPECT_EQ(reduced.K, 0.4);
    const TwoStream plain = two_stream(10., 0.2, 0.9, TwoStreamMapping::plain);
    EXPECT_EQ(plain.S, 10.);
    EXPECT_EQ(plain.K, 0.2);
    EXPECT_EQ(two_stream(1., 4., 0., TwoStreamMapping::diffusion).S, 0.);
    EXPECT_EQ(two_stream(1., 4., 0., TwoStreamMapping::diffusion).K, 8.);
}

// Diffusion theory of a half space under diffuse light: 1 - R = 4/sqrt(3) sqrt(sigma_a / sigma_s')
// to first order (van de Hulst 1980, with the exact slope 4 D / sqrt(D ...) of all phase
// functions).
TEST(KubelkaMunk, DiffusionMappingHasTheSlopeOfDiffusionTheory) {
    const double a = 1e-8;
    const TwoStream matter = two_stream(5., a, 0.8, TwoStreamMapping::diffusion);
    EXPECT_NEAR((1. - kubelka_munk_infinite(matter)) / std::sqrt(a), 4. / std::sqrt(3.), 1e-3);
}

TEST(KubelkaMunk, TotalsOfAStackAddUpAndFollowTheComposition) {
    const LayerStack stack{{{.sigma_s = 8., .sigma_a = 0.1, .g = 0.5, .thickness = 0.4, .eta = 1.5},
                            {.sigma_s = 3., .sigma_a = 0.02, .thickness = 1., .eta = 1.3}},
                           1.,
                           1.33};
    for (const Entry entry : {Entry::diffuse, Entry::normal}) {
        const LayerTotals t = kubelka_munk(stack, TwoStreamMapping::reduced, entry);
        const Saunderson top = saunderson(1.5, entry);
        FluxLayer below = stacked(layer(4., 0.2, 0.4), flux_layer(saunderson(1.3 / 1.5)));
        below = stacked(stacked(below, layer(3., 0.04, 1.)), flux_layer(saunderson(1.33 / 1.3)));
        EXPECT_NEAR(t.reflectance, top.over(below.reflectance_above), 1e-14);
        EXPECT_NEAR(
            t.transmittance,
            (1. - top.k1) * below.transmittance_down / (1. - top.k2 * below.reflectance_above),
            1e-14);
        EXPECT_EQ(t.specular, top.k1);
        EXPECT_NEAR(t.reflectance + t.transmittance + t.absorptance, 1., 1e-15);
    }
    LayerStack white = stack;
    for (Layer& l : white.layers) l.sigma_a = 0.;
    EXPECT_NEAR(kubelka_munk(white).absorptance, 0., 1e-12);
    white.layers.back().thickness = inf;
    EXPECT_NEAR(kubelka_munk(white).reflectance, 1., 1e-12);
}

// How far two streams with the diffusion mapping are from transport, for what they are meant for:
// diffuse light on thick, weakly absorbing matter. The bound is the theory's error, about twice
// what the extrapolation length 2/3 instead of 0.7104 makes, not a tolerance of the code.
TEST(KubelkaMunk, IsCloseToTransportForThickWeaklyAbsorbingLayers) {
    const LayerStack stack{{{.sigma_s = 10., .sigma_a = 0.01, .g = 0., .thickness = 1.}}};
    const LayerWalkResult walk = layer_walk(stack, {.photons = 20000, .seed = 3, .diffuse = true});
    const LayerTotals km = kubelka_munk(stack);
    EXPECT_NEAR(km.reflectance, walk.reflectance.mean, 0.02 + 4. * walk.reflectance.error);
    EXPECT_NEAR(km.transmittance, walk.transmittance.mean, 0.02 + 4. * walk.transmittance.error);
}

TEST(KubelkaMunk, SaysWhatIsWrong) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto message = [](double S, double K, double d) {
        return test::error_of([=] { kubelka_munk({S, K}, d); });
    };
    EXPECT_EQ(message(-1., 0., 1.), "Kubelka-Munk: S = -1 must be finite and at least 0");
    EXPECT_EQ(message(1., inf, 1.), "Kubelka-Munk: K = inf must be finite and at least 0");
    EXPECT_EQ(message(1., 1., -2.), "Kubelka-Munk: the thickness = -2 must be at least 0");
    EXPECT_EQ(message(1., 1., nan), "Kubelka-Munk: the thickness = nan must be at least 0");
    EXPECT_EQ(test::error_of([] {
                  kubelka_munk_infinite({1., -1.});
              }),
              "Kubelka-Munk: K = -1 must be finite and at least 0");
    EXPECT_EQ(test::error_of([] { over_backing({}, 1.5); }),
              "Kubelka-Munk: the backing's reflectance = 1.5 must be within [0, 1]");
    EXPECT_EQ(test::error_of([] { saunderson(0.); }),
              "Kubelka-Munk: the index ratio = 0 must be positive and finite");
    EXPECT_EQ(test::error_of([] { kubelka_munk(LayerStack{}); }),
              "a stack needs at least one layer");
}

}  // namespace
}  // namespace nacre
