#include "nacre/optics/phase.h"

#include <gtest/gtest.h>

#include "nacre/math/error.h"
#include "nacre/math/quadrature.h"
#include "nacre/math/random.h"
#include "tests/optics/reference.h"
#include "tests/support/constants.h"
#include "tests/support/statistics.h"

namespace nacre {

namespace {

struct Functions {
    std::function<double(double)> eval, sample_cos;
    double mean_cosine;
};
template <class P>
Functions functions_of(P p) {
    return {[p](double c) { return p.eval(c); }, [p](double u) { return p.sample_cos(u); },
            p.mean_cosine()};
}

// The double-precision function of a name in the reference.
Functions reference_function(const std::string& name, double parameter) {
    if (name == "rayleigh") return functions_of(RayleighPhase<double>{});
    if (name == "mie_hazy") return functions_of(MiePhase<double>::hazy());
    if (name == "mie_murky") return functions_of(MiePhase<double>::murky());
    if (name == "mie_murky_33") return functions_of(MiePhase<double>::murky_33());
    if (name == "schlick") return functions_of(SchlickPhase<double>{parameter});
    if (name == "cornette_shanks") return functions_of(CornetteShanksPhase<double>{parameter});
    if (name == "hg") return functions_of(HenyeyGreensteinPhase<double>{parameter});
    throw std::runtime_error("no phase function " + name);
}

// Every function that the tests below run over, in the renderer's precision.
std::vector<std::pair<std::string, PhaseFunction>> all_functions() {
    std::vector<std::pair<std::string, PhaseFunction>> all = {
        {"isotropic", PhaseFunction::isotropic()},
        {"rayleigh", PhaseFunction::rayleigh()},
        {"mie_hazy", PhaseFunction::mie_hazy()},
        {"mie_murky", PhaseFunction::mie_murky()},
        {"mie_murky_33", PhaseFunction::mie_murky_33()},
        {"two_term_hg", PhaseFunction::two_term_hg(0.9f, 0.8f, -0.3f)}};
    for (const float g : {-0.9f, -0.3f, -0.0005f, 0.f, 0.0005f, 0.002f, 0.6f, 0.95f}) {
        all.emplace_back(fmt::format("hg {}", g), PhaseFunction::henyey_greenstein(g));
        all.emplace_back(fmt::format("schlick {}", g), PhaseFunction::schlick(g));
        all.emplace_back(fmt::format("cornette_shanks {}", g), PhaseFunction::cornette_shanks(g));
    }
    return all;
}

double integrate_sphere(const std::function<double(double)>& f) {
    // Panels that shrink towards both poles resolve narrow lobes.
    static const GaussLegendre rule(32);
    double sum = 0.;
    for (double d = 1., next; d > 1e-4; d = next) {
        next = d * 0.5 > 1e-4 ? 0.5 * d : 0.;
        sum += rule.integrate(1. - d, 1. - next, f) + rule.integrate(-1. + next, -1. + d, f);
    }
    return 2. * pi * sum;
}

}  // namespace

TEST(Phase, ValuesAndMeanCosinesAgreeWithTheReference) {
    int checked = 0;
    for (const auto& f : test::optics_reference()["phase"]["functions"]) {
        const std::string name = f["name"];
        const double parameter = f["param"];
        const Functions p = reference_function(name, parameter);
        const PhaseFunction single = PhaseFunction::named(name, float(parameter));
        for (std::size_t i = 0; i < f["value"].size(); ++i, ++checked) {
            const double c = f["cos_theta"][i], expected = f["value"][i];
            EXPECT_NEAR(p.eval(c), expected, 1e-10 * expected) << name << ' ' << parameter;
            EXPECT_NEAR(single.eval(float(c)), expected, 4e-5 * expected) << name << ' ' << c;
        }
        EXPECT_NEAR(p.mean_cosine, double(f["mean_cosine"]), 1e-10) << name << ' ' << parameter;
        EXPECT_NEAR(single.mean_cosine(), double(f["mean_cosine"]), 1e-6);
    }
    EXPECT_EQ(checked, 160);
}

TEST(Phase, TwoTermHenyeyGreensteinAgreesWithTheReference) {
    for (const auto& f : test::optics_reference()["phase"]["two_term_hg"]) {
        const TwoTermHenyeyGreensteinPhase<double> p{f["weight_first"], f["g1"], f["g2"]};
        for (std::size_t i = 0; i < f["value"].size(); ++i)
            EXPECT_NEAR(p.eval(f["cos_theta"][i]), double(f["value"][i]),
                        1e-10 * double(f["value"][i]));
        EXPECT_NEAR(p.mean_cosine(), double(f["mean_cosine"]), 1e-14);
    }
}

TEST(Phase, HenyeyGreensteinInverseAgreesWithTheReference) {
    for (const auto& f : test::optics_reference()["phase"]["hg_sampling_cdf_increasing_in_xi"]) {
        const double g = f["g"];
        for (std::size_t i = 0; i < f["xi"].size(); ++i) {
            const double u = f["xi"][i], expected = f["cos_theta"][i];
            EXPECT_NEAR(HenyeyGreensteinPhase<double>{g}.sample_cos(u), expected, 1e-10) << g;
            EXPECT_NEAR(PhaseFunction::henyey_greenstein(float(g)).sample_cos(float(u)), expected,
                        2e-6)
                << g;
        }
    }
}

TEST(Phase, IntegratesToOneWithTheMeanCosineItStates) {
    for (const auto& [name, p] : all_functions()) {
        EXPECT_NEAR(integrate_sphere([&p = p](double c) { return p.eval(float(c)); }), 1., 2e-5)
            << name;
        EXPECT_NEAR(integrate_sphere([&p = p](double c) { return c * p.eval(float(c)); }),
                    p.mean_cosine(), 2e-5)
            << name;
    }
}

TEST(Phase, SamplesFollowTheDensity) {
    std::uint64_t stream = 0;
    for (const auto& [name, p] : all_functions()) {
        // Cells of equal probability would hide an error of the inverse that this grid shows: cells
        // are even in (1 - cos)^(1/2), finer where lobes are.
        const int cells = 64, n = 1 << 18;
        const auto edge = [&](int i) {
            const double s = double(i) / cells;
            return 1. - 2. * s * s;
        };
        static const GaussLegendre rule(24);
        std::vector<double> count(cells), expected(cells);
        for (int i = 0; i < cells; ++i)
            expected[i] = n * 2. * pi * rule.integrate(edge(i + 1), edge(i), [&p = p](double c) {
                return p.eval(float(c));
            });
        Random rng(stream_key(31, stream++));
        double sum = 0.;
        for (int i = 0; i < n; ++i) {
            const float c = p.sample_cos(rng.next());
            ASSERT_GE(c, -1.00001f) << name;
            ASSERT_LE(c, 1.00001f) << name;
            sum += c;
            ++count[std::clamp(int(std::sqrt(std::max(0.f, 0.5f * (1.f - c))) * cells), 0,
                               cells - 1)];
        }
        EXPECT_TRUE(test::chi_square_passes(count, expected)) << name;
        EXPECT_NEAR(sum / n, p.mean_cosine(), 4. / std::sqrt(double(n))) << name;
    }
}

TEST(Phase, InversesInvertTheDistribution) {
    // The monotone ones: the probability below the sampled cosine is u.
    static const GaussLegendre rule(64);
    for (const double g : {-0.9, -0.3, 0.0005, 0.002, 0.6, 0.95})
        for (const double u : {0., 0.01, 0.3, 0.5, 0.8, 0.99, 1.}) {
            const auto below = [&](const auto& p) {
                const double c = p.sample_cos(u);
                // Near the forward end integrate the rest instead: the lobe is there.
                const auto f = [&](double x) { return 2. * pi * p.eval(x); };
                double sum = 0.;
                for (int i = 0; i < 64; ++i)
                    sum +=
                        rule.integrate(-1. + (c + 1.) * i / 64., -1. + (c + 1.) * (i + 1) / 64., f);
                return sum;
            };
            EXPECT_NEAR(below(HenyeyGreensteinPhase<double>{g}), u, 1e-9) << g;
            EXPECT_NEAR(below(SchlickPhase<double>{g}), u, 1e-9) << g;
            EXPECT_NEAR(below(CornetteShanksPhase<double>{g}), u, 1e-6) << g;
            EXPECT_NEAR(below(RayleighPhase<double>{}), u, 1e-12);
        }
}

TEST(Phase, CornetteShanksTendsToRayleigh) {
    for (const double c : {-1., -0.2, 0.7})
        EXPECT_NEAR(CornetteShanksPhase<double>{0.}.eval(c), RayleighPhase<double>{}.eval(c),
                    1e-15);
}

TEST(Phase, TurnsTheDirectionOfPropagation) {
    const PhaseFunction p = PhaseFunction::henyey_greenstein(0.8f);
    Random rng(stream_key(41, 0));
    Vec3f d = normalize(Vec3f(0.2f, -0.5f, -0.7f));
    double along = 0., across = 0.;
    const Vec3f side = normalize(cross(d, Vec3f(0.f, 0.f, 1.f)));
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
        const Vec3f out = p.sample(d, rng.next2());
        ASSERT_NEAR(length(out), 1.f, 2e-6f);
        along += dot(out, d), across += dot(out, side);
    }
    EXPECT_NEAR(along / n, 0.8, 0.003);  // forward along d, not towards where it came from
    EXPECT_NEAR(across / n, 0., 0.006);
    // A long walk keeps its unit length.
    for (int i = 0; i < 100000; ++i) d = p.sample(d, rng.next2());
    EXPECT_NEAR(length(d), 1.f, 1e-6f);
}

TEST(Phase, IsASmallValue) {
    EXPECT_LE(sizeof(PhaseFunction), 16u);
    EXPECT_TRUE(std::is_trivially_copyable_v<PhaseFunction>);
}

TEST(Phase, RefusesWrongInput) {
    const auto message = [](auto make) -> std::string {
        try {
            make();
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    EXPECT_EQ(message([] { PhaseFunction::named("HG", 1.f); }),
              "phase function hg: g = 1 must lie between -1 and 1");
    EXPECT_EQ(message([] { PhaseFunction::named("schlick", -1.5f); }),
              "phase function schlick: k = -1.5 must lie between -1 and 1");
    EXPECT_EQ(message([] { PhaseFunction::two_term_hg(1.5f, 0.f, 0.f); }),
              "phase function two_term_hg: the share 1.5 of the first term must lie in [0, 1]");
    EXPECT_EQ(message([] { PhaseFunction::named("raleigh"); }),
              "unknown phase function 'raleigh'; did you mean 'rayleigh'?");
    EXPECT_EQ(PhaseFunction::named("Mie Murky").name(), "mie_murky");
}

}  // namespace nacre
