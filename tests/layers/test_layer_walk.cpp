#include "nacre/layers/layer_walk.h"

#include <limits>
#include <numeric>

#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"
#include "tests/layers/layer_vectors.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

LayerStack stack_of(const nlohmann::json& row) {
    LayerStack stack{{}, row["n_above"], row["n_below"]};
    for (const auto& l : row["layers"])
        stack.layers.push_back({.sigma_s = l["sigma_s"],
                                .sigma_a = l["sigma_a"],
                                .g = l["g"],
                                .thickness = l["d"] == "inf" ? inf : double(l["d"]),
                                .eta = l["n"]});
    return stack;
}

void expect_near(const Estimate& e, double expected, double error, const char* what) {
    EXPECT_NEAR(e.mean, expected, 4. * std::hypot(e.error, error) + 1e-12) << what;
}

/// Against the oracle's own walk within 4 combined standard errors and, where there is one, against
/// adding-doubling, which has none.
void compare_with_reference(std::uint64_t photons) {
    int checked = 0;
    for (const auto& row : test::layer_vectors("layer_walk")["monte_carlo"]) {
        const LayerWalkResult walk =
            layer_walk(stack_of(row), {.photons = photons,
                                       .seed = 20,
                                       .cosine = std::cos(double(row["theta_i"]) * test::degree)});
        SCOPED_TRACE(row.dump());
        EXPECT_NEAR(walk.specular, double(row["R_specular"]), 1e-12);
        expect_near(walk.reflectance, row["R_diffuse"], row["R_diffuse_se"], "R");
        expect_near(walk.transmittance, row["T"], row["T_se"], "T");
        expect_near(walk.absorptance, row["A"], row["A_se"], "A");
        if (row.contains("adding_doubling_R_diffuse"))
            expect_near(walk.reflectance, row["adding_doubling_R_diffuse"], 0., "R by doubling");
        if (row.contains("adding_doubling_T"))
            expect_near(walk.transmittance, row["adding_doubling_T"], 0., "T by doubling");
        ++checked;
    }
    EXPECT_EQ(checked, 7);
}

TEST(LayerWalk, AgreesWithTheReference) { compare_with_reference(50000); }
TEST(LongLayerWalk, AgreesWithTheReference) { compare_with_reference(2000000); }

TEST(LayerWalk, AgreesWithPublishedValues) {
    const auto& published = test::layer_vectors("layer_walk")["published"];
    const LayerStack hulst{{{.sigma_s = 0.9, .sigma_a = 0.1, .g = 0.75, .thickness = 2.}}};
    const LayerWalkResult slab = layer_walk(hulst, {.photons = 200000, .seed = 1});
    expect_near(slab.reflectance, published[0]["R_diffuse"], 0., "van de Hulst R");
    expect_near(slab.transmittance, published[0]["T_total"], 0., "van de Hulst T");
    const LayerStack giovanelli{{{.sigma_s = 0.9, .sigma_a = 0.1, .thickness = inf, .eta = 1.5}}};
    const LayerWalkResult half = layer_walk(giovanelli, {.photons = 200000, .seed = 1});
    // Printed with four digits.
    EXPECT_NEAR(half.totals().reflectance, double(published[1]["R_total"]),
                4. * half.reflectance.error + 1e-4);
}

TEST(LayerWalk, ClearLayersObeyFresnelsEquations) {
    const double theta = 50. * test::degree, n = 1.5;
    const LayerStack pane{{{.sigma_a = 0.3, .thickness = 2., .eta = n}}};
    const LayerWalkResult walk =
        layer_walk(pane, {.photons = 100000, .seed = 2, .cosine = std::cos(theta)});
    // All reflections between the faces: T = (1-F)^2 a / (1 - F^2 a^2), R = F (1 + T a).
    const double f = fresnel_dielectric(std::cos(theta), n);
    const double a = std::exp(-0.6 / refracted_cosine(std::cos(theta), n));
    const double t = (1. - f) * (1. - f) * a / (1. - f * f * a * a);
    EXPECT_NEAR(walk.specular, f, 1e-12);
    expect_near(walk.transmittance, t, 0., "T");
    expect_near(walk.unscattered, t, 0., "unscattered");
    expect_near(walk.reflectance, f * t * a, 0., "R");
    // No light was scattered, so the bins are empty.
    for (const Estimate& bin : walk.transmitted.share) EXPECT_EQ(bin.mean, 0.);
    // Light that a clear half space swallows has left the stack.
    const LayerStack water{{{.thickness = inf, .eta = 1.33}}};
    const LayerTotals sea = layer_walk(water, {.photons = 100}).totals();
    EXPECT_NEAR(sea.transmittance, 1. - normal_reflectance(1.33), 1e-12);
    EXPECT_NEAR(sea.reflectance, normal_reflectance(1.33), 1e-12);
}

TEST(LayerWalk, DiffuseLightMeetsTheDiffuseReflectance) {
    const LayerStack glass{{{.sigma_a = 1e6, .thickness = 1., .eta = 1.5}}};
    const LayerWalkResult walk = layer_walk(glass, {.photons = 50000, .seed = 4, .diffuse = true});
    // The standard deviation of F over diffuse light is 0.12.
    EXPECT_NEAR(walk.specular, diffuse_reflectance_external(1.5), 4. * 0.12 / std::sqrt(50000.));
    const LayerStack thin{{{.sigma_a = 1., .thickness = 0.5}}};
    // 2 E_3(1/2) of a purely absorbing slab.
    expect_near(layer_walk(thin, {.photons = 50000, .seed = 5, .diffuse = true}).transmittance,
                0.4432048, 0., "2 E3");
}

TEST(LayerWalk, LosesNothingWhereNothingAbsorbs) {
    const LayerStack white{{{.sigma_s = 3., .g = 0.8, .thickness = 1., .eta = 1.4},
                            {.sigma_s = 1., .g = -0.5, .thickness = 2., .eta = 1.2}},
                           1.,
                           1.3};
    const LayerTotals t = layer_walk(white, {.photons = 20000, .seed = 6, .cosine = 0.4}).totals();
    EXPECT_EQ(t.absorptance, 0.);
    EXPECT_NEAR(t.reflectance + t.transmittance, 1., 1e-12);
}

// Roulette neither adds nor takes away: strong absorption ends most walks by it.
TEST(LayerWalk, RouletteIsFair) {
    const LayerStack dark{{{.sigma_s = 0.3, .sigma_a = 0.7, .g = 0.9, .thickness = 12.}}};
    const LayerWalkResult walk = layer_walk(dark, {.photons = 200000, .seed = 8});
    const LayerTotals t = walk.totals();
    EXPECT_NEAR(t.reflectance + t.transmittance + t.absorptance, 1.,
                4. * (walk.absorptance.error + walk.transmittance.error + walk.reflectance.error));
}

TEST(LayerWalk, BinsAddUpToTheTotals) {
    const LayerStack stack{
        {{.sigma_s = 2., .sigma_a = 0.2, .g = 0.3, .thickness = 1., .eta = 1.3}}};
    const LayerWalkResult walk = layer_walk(
        stack, {.photons = 20000, .seed = 9, .cosine = 0.7, .cosine_bins = 7, .azimuth_bins = 5});
    const auto sum = [](const AngularBins& bins) {
        EXPECT_EQ(bins.share.size(), 35u);
        return std::accumulate(bins.share.begin(), bins.share.end(), 0.,
                               [](double s, const Estimate& e) { return s + e.mean; });
    };
    EXPECT_NEAR(sum(walk.transmitted), walk.transmittance.mean - walk.unscattered.mean, 1e-12);
    EXPECT_LE(sum(walk.reflected), walk.reflectance.mean + 1e-12);
    EXPECT_GT(sum(walk.reflected), 0.9 * walk.reflectance.mean);
    EXPECT_NEAR(walk.reflected.solid_angle(), 2. * std::numbers::pi / 35., 1e-15);
}

// The beam comes from azimuth 0, so forward scattering leaves towards azimuth pi.
TEST(LayerWalk, ForwardScatteringKeepsItsAzimuth) {
    const LayerStack fog{{{.sigma_s = 1., .g = 0.8, .thickness = 0.5}}};
    const LayerWalkResult walk = layer_walk(
        fog, {.photons = 20000, .seed = 10, .cosine = 0.3, .cosine_bins = 1, .azimuth_bins = 4});
    for (const AngularBins* bins : {&walk.reflected, &walk.transmitted}) {
        // Quarters 1 and 2 surround pi; left and right are alike.
        EXPECT_GT(bins->at(0, 1).mean, 3. * bins->at(0, 0).mean);
        EXPECT_NEAR(bins->at(0, 1).mean, bins->at(0, 2).mean,
                    4. * std::hypot(bins->at(0, 1).error, bins->at(0, 2).error));
    }
}

TEST(LayerWalk, ErrorsAreThoseOfRepeatedRuns) {
    const LayerStack stack{{{.sigma_s = 0.9, .sigma_a = 0.1, .g = 0.5, .thickness = 1.}}};
    double sum = 0., squares = 0., stated = 0.;
    const int runs = 200;
    for (int i = 0; i < runs; ++i) {
        const Estimate r =
            layer_walk(stack, {.photons = 500, .seed = 100 + std::uint64_t(i)}).reflectance;
        sum += r.mean, squares += r.mean * r.mean, stated += r.error / runs;
    }
    const double deviation = std::sqrt((squares - sum * sum / runs) / (runs - 1));
    // A standard deviation of 200 values has a standard error of 5 %.
    EXPECT_NEAR(deviation / stated, 1., 0.2);
}

TEST(LayerWalk, RepeatsItsBits) {
    const LayerStack stack{{{.sigma_s = 2., .sigma_a = 0.2, .g = 0.3, .thickness = 1.}}};
    const auto reflectance = [&](std::uint64_t seed) {
        return layer_walk(stack, {.photons = 1000, .seed = seed}).reflectance.mean;
    };
    EXPECT_EQ(reflectance(1), reflectance(1));
    EXPECT_NE(reflectance(1), reflectance(2));
}

TEST(LayerWalk, SaysWhatIsWrong) {
    const LayerStack stack{{{.sigma_s = 1.}}};
    const auto message = [&](const LayerWalkOptions& options) {
        return test::error_of([&] { layer_walk(stack, options); });
    };
    EXPECT_EQ(message({.photons = 1}),
              "a walk needs at least 2 photons for a standard error; got 1");
    EXPECT_EQ(message({.cosine = 0.}), "the cosine of incidence must lie within (0, 1]; got 0");
    EXPECT_EQ(message({.cosine = std::nan("")}),
              "the cosine of incidence must lie within (0, 1]; got nan");
    EXPECT_EQ(message({.cosine_bins = 0}),
              "there must be at least one bin of cosine and azimuth; got 0 and 1");
    EXPECT_EQ(test::error_of([] {
                  layer_walk({{Layer{}, {.sigma_s = 1., .thickness = inf}}});
              }),
              "layer 2: without absorption, walks in an infinitely thick layer may never end; give "
              "it a finite thickness or some sigma_a");
    EXPECT_EQ(test::error_of([] { layer_walk({}); }), "a stack needs at least one layer");
}

}  // namespace
}  // namespace nacre
