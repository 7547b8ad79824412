// Photon beam diffusion, its single scattering, quantised diffusion, and Monte Carlo.
#include "nacre/bssrdf/better_dipole.h"
#include "nacre/bssrdf/photon_beam_diffusion.h"
#include "nacre/bssrdf/quantised_diffusion.h"
#include "nacre/bssrdf/radial_integral.h"
#include "nacre/optics/fresnel.h"
#include "tests/bssrdf/reference.h"

namespace nacre {

namespace {

using test::bssrdf_reference;

}  // namespace

TEST(PhotonBeamDiffusion, AgreesWithTheReference) {
    int checked = 0;
    for (const auto& row : bssrdf_reference()["photon_beam_diffusion"]) {
        const ProfileMedium m{row["sigma_s"], row["sigma_a"], row["g"], row["eta"]};
        const PhotonBeamDiffusion with(m), without(m, false);
        const BeamSingleScattering single(m);
        for (std::size_t i = 0; i < row["r"].size(); ++i, ++checked) {
            const double r = row["r"][i];
            EXPECT_RELATIVE(with.eval(r), number(row["ms_kappa"][i]), 1e-6) << m.g << " " << r;
            EXPECT_RELATIVE(without.eval(r), number(row["ms_nokappa"][i]), 1e-6) << r;
            EXPECT_RELATIVE(single.eval(r), number(row["single"][i]), 1e-6) << r;
        }
    }
    EXPECT_EQ(checked, 12);
}

TEST(PhotonBeamDiffusion, TotalsAreIntegrals) {
    for (const ProfileMedium& m :
         {ProfileMedium{1., 0.1, 0., 1.3}, ProfileMedium{10., 0.5, 0.8, 1.5},
          ProfileMedium{1., 0.1, -0.5, 1.}}) {
        const double scale = 1. / m.sigma_t_prime();
        for (const bool kappa : {true, false}) {
            const PhotonBeamDiffusion beam(m, kappa);
            EXPECT_RELATIVE(
                disk_integral(300. * scale, scale, [&](double r) { return beam.eval(r); }),
                beam.total(), 1e-7)
                << kappa << m.g;
        }
        const BeamSingleScattering single(m);
        EXPECT_RELATIVE(
            disk_integral(300. * scale, 1. / m.sigma_t(), [&](double r) { return single.eval(r); }),
            single.total(), 1e-6)
            << m.g;
    }
}

TEST(PhotonBeamDiffusion, WithoutKappaReturnsAllLightWithoutAbsorption) {
    // Sources at every depth return all of it: 2 A C_phi + C_E = 1.
    EXPECT_NEAR(PhotonBeamDiffusion({1., 0., 0., 1.4}, false).total(), 1., 1e-14);
    double before = 2.;
    for (double a = 0.; a < 50.; a = a * 2. + 1e-4) {
        const double total = PhotonBeamDiffusion({1., a, 0., 1.4}).total();
        EXPECT_LT(total, before);
        before = total;
    }
}

TEST(BeamSingleScattering, TotalIsKnownForIsotropicScatteringWithoutBoundary) {
    // (W / 2) integral of mu / (1 + mu) = (W / 2) (1 - ln 2).
    EXPECT_NEAR(BeamSingleScattering({0.8, 0.2, 0., 1.}).total(), 0.4 * (1. - std::log(2.)), 1e-7);
    // eta < 1: total reflection happens outside, where nothing arrives at grazing angles anyway.
    const BeamSingleScattering thinner({0.8, 0.2, 0., 0.8});
    EXPECT_RELATIVE(disk_integral(100., 1., [&](double r) { return thinner.eval(r); }),
                    thinner.total(), 1e-6);
}

TEST(QuantisedDiffusion, TendsToBeamsWithoutKappa) {
    for (const ProfileMedium& m :
         {ProfileMedium{1., 0.1, 0., 1.3}, ProfileMedium{5., 0.02, 0.5, 1.5}}) {
        const PhotonBeamDiffusion beam(m, false);
        const GaussianSum fine = quantised_diffusion(m, 2000), few = quantised_diffusion(m);
        const double scale = 1. / m.sigma_t_prime();
        for (const double r : {0.05, 0.2, 1., 3., 8.}) {
            const double expected = beam.eval(r * scale), r2 = r * r * scale * scale;
            EXPECT_RELATIVE(fine.eval(r2), expected, 2e-4) << r;
            EXPECT_RELATIVE(few.eval(r2), expected, 0.03) << r;
        }
        // The spans of time that are left out cost up to a thousandth.
        EXPECT_RELATIVE(fine.total(), beam.total(), 1e-3);
    }
    // Few Gaussians do not make light where none is absorbed.
    for (const int count : {20, 40, 80}) {
        const double white = quantised_diffusion({1., 0., 0., 1.3}, count).total();
        EXPECT_TRUE(white > 0.997 && white < 1.) << count << " " << white;
    }
    for (const Gaussian& g : quantised_diffusion({1., 0., 0., 1.3}).terms) {
        EXPECT_GE(g.weight, 0.);
        EXPECT_GT(g.variance, 0.);
    }
}

TEST(Profiles, AgainstMonteCarlo) {
    // Bin means of a simulation of a half space, per incident power. scattering.md states
    // that beams with single scattering lie within 1 to 10 % of it for alpha' = 0.91, and how far
    // off the dipoles are.
    int bins = 0;
    for (const auto& run : bssrdf_reference()["monte_carlo"]) {
        const auto& layer = run["layers"][0];
        const ProfileMedium m{layer["sigma_s"], layer["sigma_a"], layer["g"], layer["n"]};
        const PhotonBeamDiffusion beam(m);
        const BeamSingleScattering single(m);
        const double entry = 1. - number(run["R_specular"]);
        const auto& edges = run["r_edges"];
        for (std::size_t i = 0; i + 1 < edges.size(); ++i, ++bins) {
            const double low = edges[i], high = edges[i + 1];
            const auto mean = [&](auto&& f) {
                const double sum =
                    low > 0. ? ring_integral(low, high, f) : disk_integral(high, 1., f);
                return entry * sum / (std::numbers::pi * (high * high - low * low));
            };
            const double truth = run["R_of_r_mean_per_area"][i], error = run["R_of_r_se"][i];
            const double found = mean([&](double r) { return beam.eval(r) + single.eval(r); });
            EXPECT_NEAR(found, truth, 0.10 * truth + 4. * error) << m.sigma_a << " bin " << i;
            RecordProperty("beam_over_truth_" + std::to_string(bins),
                           std::to_string(found / truth));
        }
    }
    EXPECT_EQ(bins, 20);
}

TEST(Profiles, MeanValuesOfTheComparisonTable) {
    // scattering.md section 5, sigma_s = 1, sigma_a = 0.1, eta = 1.3: columns PBD + single, better
    // dipole + single.
    const ProfileMedium m{1., 0.1, 0., 1.3};
    const PhotonBeamDiffusion beam(m);
    const BeamSingleScattering single(m);
    const BetterDipole<double> better(1., 0.1, 1.3);
    struct Row {
        double low, high, beam, better;
    };
    for (const Row& row :
         {Row{0., 0.25, .321, .263}, Row{0.25, 0.5, .0693, .0584}, Row{0.5, 1., .02465, .02554},
          Row{1., 1.5, .01060, .01207}, Row{2., 3., .002520, .002839},
          Row{4., 6., 2.768e-4, 3.036e-4}, Row{8., 12., 7.13e-6, 7.63e-6}}) {
        const auto mean = [&](auto&& f) {
            const double sum =
                row.low > 0. ? ring_integral(row.low, row.high, f) : disk_integral(row.high, 1., f);
            return (1. - normal_reflectance(1.3)) * sum /
                   (std::numbers::pi * (row.high * row.high - row.low * row.low));
        };
        // The table prints three or four digits.
        EXPECT_RELATIVE(mean([&](double r) { return beam.eval(r) + single.eval(r); }), row.beam,
                        3e-3)
            << row.low;
        EXPECT_RELATIVE(mean([&](double r) { return better.eval(r * r) + single.eval(r); }),
                        row.better, 3e-3)
            << row.low;
    }
}

}  // namespace nacre
