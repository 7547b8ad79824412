// Profiles by name: descriptions, options, tables, inversion of albedos, wrong input.
#include "nacre/bssrdf/albedo_inversion.h"
#include "nacre/bssrdf/chiang2016.h"
#include "nacre/bssrdf/radial_integral.h"
#include "nacre/bssrdf/radial_table.h"
#include "nacre/math/random.h"
#include "nacre/math/statistics.h"
#include "tests/bssrdf/reference.h"
#include "tests/support/constants.h"

namespace nacre {

namespace {

using test::error_of;

struct Case {
    std::string_view name, options;
    ProfileMedium medium;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {"dipole", "", {1., 0.1, 0., 1.3}},
        {"dipole", "boundary=two_moment", {2.19, 0.0021, 0., 1.5}},
        {"dipole", "boundary=exact", {1., 0., 0., 1.3}},
        {"better_dipole", "", {1., 0.1, 0., 1.3}},
        {"better_dipole", "moments=fit", {20., 0.001, 0.9, 1.4}},
        {"quantised_diffusion", "", {1., 0.1, 0., 1.3}},
        {"quantised_diffusion", "count=15", {1., 0., 0., 1.3}},
        {"photon_beam_diffusion", "", {1., 0.1, 0., 1.3}},
        {"photon_beam_diffusion", "kappa=off single=on", {10., 0.05, 0.8, 1.4}},
        {"normalised_diffusion", "", {1., 0.1, 0., 1.3}},
        {"normalised_diffusion", "fit=diffuse_free_path", {0.1, 0.3, 0., 1.3}},
        {"gaussian_sum", "channel=green", {1., 0.1, 0., 1.3}},
        {"multipole", "thickness=3", {1., 0.02, 0., 1.3}}};
    return all;
}

std::unique_ptr<RadialProfile> make(const Case& c) {
    return make_profile(c.name, c.medium, parse_settings(c.options));
}

}  // namespace

TEST(RadialProfiles, DescribeThemselves) {
    EXPECT_EQ(profiles().size(), 7u);
    for (const ProfileDescription* d : profiles()) {
        EXPECT_EQ(&profiles().find(d->name), d);
        EXPECT_FALSE(d->title.empty() || d->authors.empty() || d->paper.empty() ||
                     d->formula.empty() || d->single_scattering.empty())
            << d->name;
        EXPECT_TRUE(d->year >= 2001 && d->year <= 2015);
        const auto profile = make_profile(d->name, {1., 0.1, 0., 1.3});
        EXPECT_EQ(&profile->description(), d);
        EXPECT_GT(profile->eval(0.5), 0.);
        EXPECT_GT(profile->scale(), 0.);
    }
    EXPECT_EQ(profiles().find("Better Dipole").name, "better_dipole");
}

TEST(RadialProfiles, CumulativesAndTotalsAreIntegrals) {
    for (const Case& c : cases()) {
        const auto profile = make(c);
        const auto value = [&](double r) { return profile->eval(r); };
        const double scale = profile->scale();
        for (const double r : {0.3, 4.})
            EXPECT_RELATIVE(profile->cumulative(r * scale), disk_integral(r * scale, scale, value),
                            2e-5)
                << c.name << r;
        EXPECT_EQ(profile->cumulative(0.), 0.) << c.name;
        // Without absorption the tail beyond 1e5 scales still holds some 1e-5.
        EXPECT_RELATIVE(profile->total(), disk_integral(1e5 * scale, scale, value), 5e-5)
            << c.name << c.options;
    }
}

TEST(RadialProfiles, OptionsReachTheModels) {
    const ProfileMedium m{1., 0.1, 0.2, 1.3};
    const auto total = [&](std::string_view name, std::string_view options) {
        return make_profile(name, m, parse_settings(options))->total();
    };
    EXPECT_NE(total("dipole", "boundary=fit"), total("dipole", "boundary=exact"));
    EXPECT_NE(total("better_dipole", "moments=fit"), total("better_dipole", ""));
    EXPECT_LT(total("photon_beam_diffusion", ""), total("photon_beam_diffusion", "kappa=off"));
    EXPECT_LT(total("photon_beam_diffusion", ""), total("photon_beam_diffusion", "single=on"));
    EXPECT_NE(total("quantised_diffusion", "count=10"), total("quantised_diffusion", ""));
    EXPECT_LT(total("multipole", "thickness=2"), total("multipole", "thickness=20"));
    // The albedo of normalised diffusion is the one whose random walks have the medium's alpha'.
    const auto walk = chiang2016_medium(0.6, 1.);
    EXPECT_NEAR(make_profile("normalised_diffusion",
                             ProfileMedium::reduced(walk.sigma_s, walk.sigma_t - walk.sigma_s, 1.))
                    ->total(),
                0.6, 1e-12);
    EXPECT_TRUE(make_profile("photon_beam_diffusion", m, parse_settings("single=on"))
                    ->includes_single_scattering());
    EXPECT_FALSE(make_profile("photon_beam_diffusion", m)->includes_single_scattering());
}

TEST(RadialTable, ValuesAreWithinTheStatedError) {
    double worst = 0.;
    for (const Case& c : cases()) {
        const auto profile = make(c);
        const RadialTable table(*profile);
        EXPECT_LT(table.size_in_bytes(), 12000u);
        const double scale = profile->scale(), total = profile->total();
        for (double r = 1.1e-4 * scale; r < 1e4 * scale; r *= 1.0137) {
            const float r2 = float(r * r);
            if (table.eval(r2) == 0.f) break;  // the end of the table
            const double exact = profile->eval(std::sqrt(double(r2)));
            const double error = std::abs(table.eval(r2) / exact - 1.);
            worst = std::max(worst, error);
            EXPECT_LT(error, 1e-4) << c.name << " " << c.options << " r/scale " << r / scale;
        }
        for (const double r : {0.01, 0.5, 3., 30.}) {
            const double exact = profile->cumulative(r * scale);
            EXPECT_RELATIVE(table.cumulative(float(r * r * scale * scale)), exact, 1e-3) << c.name;
        }
        const double lost = c.medium.sigma_a > 0. ? 1e-6 : 3e-4;
        EXPECT_RELATIVE(table.total(), total, lost) << c.name << c.options;
        EXPECT_EQ(table.eval(1e30f), 0.f);
        EXPECT_GE(table.eval(0.f), table.eval(float(scale * scale)));
        EXPECT_EQ(table.cumulative(0.f), 0.f);
        EXPECT_EQ(table.cumulative(1e30f), table.total());
    }
    RecordProperty("worst_relative_error", std::to_string(worst));
}

TEST(RadialTable, SamplesInvertItsDistribution) {
    for (const Case& c : cases()) {
        const auto profile = make(c);
        const RadialTable table(*profile);
        for (float u = 0.001f; u < 1.f; u += 0.0137f) {
            const float r = table.sample(u);
            EXPECT_NEAR(table.cumulative(r * r) / table.total(), u, 3e-6f) << c.name << u;
            EXPECT_RELATIVE(table.pdf(r * r), table.eval(r * r) / table.total(), 0.02)
                << c.name << u;
        }
        EXPECT_EQ(table.sample(0.f), 0.f);
        EXPECT_TRUE(std::isfinite(table.sample(1.f - 0x1p-24f)));
    }
    // The reference's radii, to the error of the table.
    for (const auto& row : test::bssrdf_reference()["dipole"]) {
        const auto dipole = make_profile(
            "dipole", ProfileMedium::reduced(row["sigma_s_prime"], row["sigma_a"], row["eta"]));
        const RadialTable table(*dipole);
        for (std::size_t i = 0; i < row["xi"].size(); ++i) {
            const double tail =
                double(row["sigma_a"]) > 0. ? 1e-3 : 5e-3;  // 1e-4 of the light is cut
            EXPECT_RELATIVE(table.sample(float(row["xi"][i])), double(row["r_of_xi"][i]), tail)
                << row["material"];
        }
    }
}

TEST(RadialTable, SamplesHaveTheStatedDensity) {
    // Pearson's chi-square over rings, each probability to be above 1e-4; 13 cases.
    for (const Case& c : cases()) {
        const auto profile = make(c);
        const RadialTable table(*profile);
        const double scale = profile->scale();
        constexpr int bins = 40, n = 40000;
        const auto edge = [&](int b) { return b == 0 ? 0. : scale * std::pow(10., -2. + 0.1 * b); };
        std::vector<double> found(bins + 1), expected(bins + 1);
        double inside = 0.;
        static const GaussLegendre rule(16);
        for (int b = 0; b < bins; ++b) {
            for (int k = 0; k < 16; ++k) {
                const double low = edge(b), width = (edge(b + 1) - low) / 16.;
                expected[std::size_t(b)] +=
                    n * rule.integrate(low + k * width, low + (k + 1) * width, [&](double r) {
                        return 2. * pi * r * table.pdf(float(r * r));
                    });
            }
            inside += expected[std::size_t(b)];
        }
        expected[bins] = n - inside;
        Random random(stream_key(11, std::uint64_t(&c - cases().data())));
        for (int i = 0; i < n; ++i) {
            const double r = table.sample(random.next());
            int b = 0;
            while (b < bins && r >= edge(b + 1)) ++b;
            ++found[std::size_t(b)];
        }
        double statistic = 0., pooled_found = 0., pooled_expected = 0.;
        int degrees = -1;
        for (std::size_t b = 0; b <= bins; ++b) {
            pooled_found += found[b], pooled_expected += expected[b];
            if (pooled_expected < 5.) continue;
            statistic += (pooled_found - pooled_expected) * (pooled_found - pooled_expected) /
                         pooled_expected;
            ++degrees;
            pooled_found = pooled_expected = 0.;
        }
        EXPECT_GT(chi_square_probability(statistic, degrees), 1e-4)
            << c.name << " " << c.options << " " << statistic << " of " << degrees;
        EXPECT_NEAR(inside / n, table.cumulative(float(edge(bins) * edge(bins))) / table.total(),
                    1e-3);
    }
}

TEST(RadialTable, LanesAreTheChannels) {
    const auto red = make_profile("dipole", ProfileMedium::reduced(0.74, 0.032, 1.3));
    const auto green =
        make_profile("photon_beam_diffusion", ProfileMedium::reduced(0.88, 0.17, 1.3));
    const auto black = make_profile("dipole", ProfileMedium::reduced(0., 0.48, 1.3));
    const SpectralRadialTable table(
        std::array<const RadialProfile*, 3>{red.get(), green.get(), black.get()});
    const RadialTable alone(*red);
    const double green_total = green->total();
    for (float r = 0.01f; r < 20.f; r *= 1.7f) {
        const Spectral v = table.eval(r * r), p = table.pdf(r * r);
        EXPECT_RELATIVE(v[0], red->eval(r), 1e-4);
        EXPECT_RELATIVE(v[1], green->eval(r), 1e-4);
        EXPECT_EQ(v[2], 0.f);
        EXPECT_EQ(v[3], 0.f);
        EXPECT_RELATIVE(p[1], green->eval(r) / green_total, 0.02);
        EXPECT_EQ(p[2], 0.f);
        EXPECT_RELATIVE(table.cumulative(r * r)[0], alone.cumulative(r * r), 1e-3);
    }
    EXPECT_NEAR(table.sample(0.4f, 0), alone.sample(0.4f), 1e-3f);
    EXPECT_NEAR(green->cumulative(table.sample(0.4f, 1)), 0.4 * green_total, 1e-4);
    EXPECT_EQ(table.sample(0.4f, 2), 0.f);
    EXPECT_EQ(table.sample(0.4f, 3), 0.f);
    const std::array<const RadialProfile*, 2> two{red.get(), red.get()};
    EXPECT_EQ(error_of([&] { RadialTable t(two); }), "a table of 1 channel cannot hold 2 profiles");
    EXPECT_EQ(error_of([] { SpectralRadialTable t(std::span<const RadialProfile* const>{}); }),
              "a table of 4 channels cannot hold 0 profiles");
}

TEST(AlbedoInversion, GoesThereAndBack) {
    for (const std::string_view name : {"dipole", "better_dipole", "photon_beam_diffusion",
                                        "quantised_diffusion", "normalised_diffusion"})
        for (const double albedo : {0., 1e-6, 0.05, 0.3, 0.6, 0.8})
            for (const double eta : {1., 1.4}) {
                // Its total is a quadrature: fewer cases.
                if (name == "photon_beam_diffusion" && (eta == 1. || albedo < 0.01)) continue;
                const ProfileMedium m = invert_albedo(name, albedo, 2.5, FreePath::transport, eta);
                EXPECT_NEAR(make_profile(name, m)->total(), albedo, 1e-10) << name << albedo;
                EXPECT_NEAR(m.sigma_t_prime(), 0.4, 1e-12);
                const ProfileMedium d = invert_albedo(name, albedo, 2.5, FreePath::diffuse, eta);
                EXPECT_NEAR(make_profile(name, d)->total(), albedo, 1e-10) << name << albedo;
                EXPECT_NEAR(make_profile(name, d)->sigma_tr(), 0.4, 1e-12) << name << albedo;
            }
    // Close to white, where alpha' itself has lost its digits.
    for (const double left : {1e-3, 1e-6, 1e-9}) {
        const ProfileMedium m = invert_albedo("dipole", 1. - left, 1., FreePath::diffuse, 1.3);
        EXPECT_RELATIVE(1. - make_profile("dipole", m)->total(), left, 1e-3);
        EXPECT_GT(m.sigma_a, 0.);
    }
    // sigma_t' = sigma_tr / sqrt(3 (1 - alpha')), not sqrt(3 - alpha').
    const ProfileMedium m = invert_albedo("dipole", 0.5, 2., FreePath::diffuse, 1.3);
    EXPECT_NEAR(m.sigma_t_prime(), 0.5 / std::sqrt(3. * (1. - m.reduced_albedo())), 1e-12);
}

TEST(AlbedoInversion, RefusesWhatCannotBe) {
    const auto invert = [](std::string_view name, double albedo, double path, double eta = 1.3) {
        return error_of([=] { invert_albedo(name, albedo, path, FreePath::diffuse, eta); });
    };
    EXPECT_EQ(invert("dipole", 1., 1.), "diffuse albedo = 1 must be at least 0 and below 1");
    EXPECT_EQ(invert("dipole", -0.1, 1.), "diffuse albedo = -0.1 must be at least 0 and below 1");
    EXPECT_EQ(invert("dipole", NAN, 1.), "diffuse albedo = nan must be at least 0 and below 1");
    EXPECT_EQ(invert("dipole", 0.5, 0.), "mean free path = 0 mm must be positive and finite");
    EXPECT_EQ(invert("dipole", 0.5, 1., 0.),
              "translucent medium: eta = 0 must be positive and finite");
    EXPECT_EQ(
        invert("gaussian_sum", 0.5, 1.),
        "gaussian_sum: its albedo does not follow from a medium, so that no medium follows from "
        "an albedo");
    const std::string beyond = invert("photon_beam_diffusion", 0.999, 1.);
    EXPECT_TRUE(
        beyond.starts_with("diffuse albedo = 0.999 is beyond what photon_beam_diffusion reaches "
                           "without absorption, 0.9"))
        << beyond;
}

TEST(RadialProfiles, RefuseWrongInput) {
    const ProfileMedium good{1., 0.1, 0., 1.3};
    const auto of = [&](ProfileMedium m, std::string_view name = "dipole",
                        std::string_view options = "") {
        return error_of([&] { make_profile(name, m, parse_settings(options)); });
    };
    const struct {
        ProfileMedium medium;
        std::string message;
    } media[] = {
        {{-1., 0.1, 0., 1.3}, "translucent medium: sigma_s = -1 must be finite and at least 0"},
        {{1., -0.1, 0., 1.3}, "translucent medium: sigma_a = -0.1 must be finite and at least 0"},
        {{INFINITY, 0., 0., 1.3},
         "translucent medium: sigma_s = inf must be finite and at least 0"},
        {{1., NAN, 0., 1.3}, "translucent medium: sigma_a = nan must be finite and at least 0"},
        {{0., 0., 0., 1.3}, "translucent medium: sigma_s + sigma_a = 0 must be positive"},
        {{1., 0.1, 1., 1.3}, "translucent medium: g = 1 must be between -1 and 1"},
        {{1., 0.1, -1., 1.3}, "translucent medium: g = -1 must be between -1 and 1"},
        {{1., 0.1, 0., 0.}, "translucent medium: eta = 0 must be positive and finite"},
        {{1., 0.1, 0., -1.3}, "translucent medium: eta = -1.3 must be positive and finite"}};
    for (const auto& m : media)
        for (const ProfileDescription* d : profiles()) EXPECT_EQ(of(m.medium, d->name), m.message);
    const struct {
        std::string_view name, options, message;
    } options[] = {
        {"dipol", "", "unknown diffusion profile 'dipol'; did you mean 'dipole'?"},
        {"dipole", "moments=fit", "dipole: unknown parameter 'moments'; known are: boundary"},
        {"dipole", "boundary=exakt", "dipole: unknown boundary 'exakt'; did you mean 'exact'?"},
        {"dipole", "boundary=2", "dipole: unknown boundary '2'; known are: fit, exact, two_moment"},
        {"dipole", "boundary=fit boundary=fit",
         "dipole: boundary is given twice, as 'boundary' and 'boundary'"},
        {"quantised_diffusion", "count=1",
         "quantised_diffusion: count = 1 is out of range: must lie within [2, 10000]"},
        {"quantised_diffusion", "count=20.5",
         "quantised_diffusion: count = 20.5 must be a whole number"},
        {"quantised_diffusion", "count=many",
         "quantised_diffusion: count = 'many' must be a whole number within [2, 10000]"},
        {"multipole", "thickness=0",
         "multipole: thickness = 0 is out of range: must lie within (0, inf)"}};
    for (const auto& o : options) EXPECT_EQ(of(good, o.name, o.options), o.message);
    EXPECT_EQ(
        of({1., 0., 0., 1.3}, "normalised_diffusion", "fit=diffuse_free_path"),
        "normalised_diffusion: fit=diffuse_free_path needs absorption: without it the diffuse "
        "mean free path is infinite; use fit=diffuse");
    EXPECT_EQ(of(good), "no error");
}

TEST(Profiles, FitsAreRefusedBeyondTheirRange) {
    // Jensen's fit of the reflectance passes 1 at indices of 3.85 and 0.26, where totals explode.
    const auto total = [](const char* name, double eta, const char* options) {
        return make_profile(name, {1., 0.01, 0., eta}, parse_settings(options))->total();
    };
    const auto refusal = [&](const char* name, double eta, const char* options) {
        try {
            total(name, eta, options);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    for (const double eta : {0.4, 0.7, 1.5, 3.}) {
        EXPECT_EQ(refusal("dipole", eta, ""), "accepted") << eta;
        EXPECT_LE(total("dipole", eta, ""), 1.) << eta;
    }
    for (const double eta : {0.25, 0.39, 3.1, 4.}) {
        EXPECT_EQ(refusal("dipole", eta, ""),
                  fmt::format("the fit of diffuse Fresnel reflectance of Jensen et al. 2001 holds "
                              "for relative indices eta from 0.4 to 3, not {:g}; use the exact "
                              "reflectance, --set boundary=exact, or a profile without the fit, "
                              "such as better_dipole",
                              eta));
        EXPECT_LE(total("dipole", eta, "boundary=exact"), 1.) << eta;
    }
    for (const double eta : {0.2, 2.6})
        EXPECT_EQ(refusal("better_dipole", eta, "moments=fit"),
                  fmt::format("the fits of Fresnel moments of d'Eon and Irving 2011 hold for "
                              "relative indices eta from 0.25 to 2.5, not {:g}; use the exact "
                              "moments: --set moments=exact",
                              eta));
}

}  // namespace nacre
