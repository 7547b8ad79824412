// Normalised diffusion, Gaussian sums, the random walk of Chiang et al.
#include "nacre/bssrdf/chiang2016.h"
#include "nacre/bssrdf/gaussian_sum.h"
#include "nacre/bssrdf/normalised_diffusion.h"
#include "nacre/bssrdf/radial_integral.h"
#include "nacre/math/random.h"
#include "tests/bssrdf/reference.h"

namespace nacre {

namespace {

using test::bssrdf_reference;
using Fit = NormalisedDiffusionFit;

}  // namespace

TEST(NormalisedDiffusion, AgreesWithTheReference) {
    int checked = 0;
    for (const auto& row : bssrdf_reference()["normalized_diffusion"]) {
        const double a = row["A"], l = row["mfp"];
        EXPECT_RELATIVE(normalised_diffusion_scale(a, Fit::searchlight),
                        number(row["s_searchlight"]), 1e-12);
        EXPECT_RELATIVE(normalised_diffusion_scale(a, Fit::diffuse), number(row["s_diffuse"]),
                        1e-12);
        EXPECT_RELATIVE(normalised_diffusion_scale(a, Fit::diffuse_free_path),
                        number(row["s_dmfp"]), 1e-12);
        const NormalisedDiffusion<double> model(a, l);
        const NormalisedDiffusion<float> single{float(a), float(l)};
        EXPECT_RELATIVE(model.d, number(row["d_searchlight"]), 1e-12);
        for (std::size_t i = 0; i < row["r"].size(); ++i, ++checked) {
            const double r = row["r"][i];
            EXPECT_RELATIVE(model.eval(r), number(row["R_searchlight"][i]), 1e-10);
            EXPECT_RELATIVE(model.cumulative(r), a * number(row["cdf"][i]), 1e-10);
            EXPECT_RELATIVE(single.eval(float(r)), number(row["R_searchlight"][i]), 2e-5);
            const auto lanes =
                NormalisedDiffusion<Spectral>(Spectral(float(a)), Spectral(float(l)));
            EXPECT_RELATIVE(lanes.eval(Spectral(float(r)))[1], number(row["R_searchlight"][i]),
                            2e-5);
        }
        for (std::size_t i = 0; i < row["xi"].size(); ++i) {
            EXPECT_RELATIVE(model.sample(row["xi"][i]), number(row["r_of_xi"][i]), 1e-10);
            EXPECT_RELATIVE(single.sample(row["xi"][i]), number(row["r_of_xi"][i]), 1e-4);
        }
    }
    EXPECT_GE(checked, 36);
}

TEST(NormalisedDiffusion, SamplesInvertTheDistribution) {
    for (const double a : {0.01, 0.5, 0.8, 1.}) {
        const NormalisedDiffusion<double> model(a, 0.7);
        for (double u = 0.; u < 1.; u += 0.0371)
            EXPECT_NEAR(model.cumulative(model.sample(u)) / a, u, 1e-13);
        EXPECT_NEAR(model.cumulative(model.sample(1. - 1e-9)) / a, 1. - 1e-9, 1e-14);
        EXPECT_RELATIVE(model.pdf(0.3), model.eval(0.3) / a, 1e-14);
        EXPECT_RELATIVE(disk_integral(200., model.d, [&](double r) { return model.eval(r); }), a,
                        1e-7);
        // The largest float below 1 is still a radius.
        const NormalisedDiffusion<float> single{float(a), 0.7f};
        EXPECT_RELATIVE(single.sample(1.f - 0x1p-24f), model.sample(1. - 0x1p-24), 1e-4);
        EXPECT_NEAR(single.sample(0.f), 0.f, 1e-6f);
    }
    EXPECT_EQ(NormalisedDiffusion<double>(0., 1.).eval(1.), 0.);
}

TEST(GaussianSum, SkinsWeightsSumToOne) {
    for (int c = 0; c < 3; ++c) {
        const GaussianSum skin = skin_gaussians(c);
        EXPECT_NEAR(skin.total(), 1., 1e-15);
        const auto value = [&](double r) { return skin.eval(r * r); };
        EXPECT_NEAR(disk_integral(60., 0.08, value), 1., 1e-7);
        EXPECT_NEAR(disk_integral(0.7, 0.08, value), skin.cumulative(0.49), 1e-7);
    }
    // Red light spreads furthest.
    EXPECT_LT(skin_gaussians(0).cumulative(1.), skin_gaussians(1).cumulative(1.));
    EXPECT_LT(skin_gaussians(1).cumulative(1.), skin_gaussians(2).cumulative(1.));
}

TEST(GaussianSum, SamplesFollowTheProfile) {
    // Kolmogorov and Smirnov: sqrt(n) times the largest distance exceeds 2.2 with
    // probability 1.3e-4.
    for (int c = 0; c < 3; ++c) {
        const GaussianSum skin = skin_gaussians(c);
        Random random(stream_key(7, std::uint64_t(c)));
        constexpr int n = 20000;
        std::vector<double> shares;
        for (int i = 0; i < n; ++i) {
            const double r = skin.sample(random.next());
            shares.push_back(skin.cumulative(r * r));
        }
        std::sort(shares.begin(), shares.end());
        double distance = 0.;
        for (int i = 0; i < n; ++i)
            distance = std::max(distance, std::abs(shares[std::size_t(i)] - (i + 0.5) / n));
        EXPECT_LT(distance * std::sqrt(double(n)), 2.2) << c;
    }
    EXPECT_GT(skin_gaussians(2).sample(1. - 1e-16), 0.);
}

TEST(Chiang2016, AgreesWithTheReference) {
    int checked = 0;
    for (const auto& row : bssrdf_reference()["chiang2016"]) {
        const double a = row["A"], d = row["d"];
        EXPECT_RELATIVE(chiang2016_single_albedo(a), number(row["alpha"]), 1e-12);
        const auto medium = chiang2016_medium(a, d);
        EXPECT_RELATIVE(medium.sigma_t, number(row["sigma_t"]), 1e-10);
        EXPECT_RELATIVE(medium.sigma_s, number(row["sigma_s"]), 1e-10);
        const auto lanes = chiang2016_medium(Spectral(float(a)), Spectral(float(d)));
        EXPECT_RELATIVE(lanes.sigma_s[2], number(row["sigma_s"]), 1e-5);
        EXPECT_NEAR(chiang2016_surface_albedo(row["alpha"]), a, 1e-12);
        ++checked;
    }
    EXPECT_GE(checked, 10);
    EXPECT_EQ(chiang2016_surface_albedo(0.), 0.);
    EXPECT_NEAR(chiang2016_surface_albedo(1.), 1., 1e-15);
}

TEST(Chiang2016, RefusesWhatIsNoAlbedoOrDistance) {
    EXPECT_EQ(test::error_of([] { check_chiang2016(1.2, 1.); }),
              "chiang2016: albedo = 1.2 must be between 0 and 1");
    EXPECT_EQ(test::error_of([] { check_chiang2016(-0.1, 1.); }),
              "chiang2016: albedo = -0.1 must be between 0 and 1");
    EXPECT_EQ(test::error_of([] { check_chiang2016(0.5, 0.); }),
              "chiang2016: distance = 0 must be positive and finite");
    EXPECT_EQ(test::error_of([] { check_chiang2016(0.5, 1.); }), "no error");
}

}  // namespace nacre
