// The tables of the reference beside its vectors: which models are reciprocal, and the limits and
// closed forms that no other test of this room states (distributions: test_facets.cpp; albedos:
// test_vectors.cpp; He's limits: test_he_torrance.cpp).
#include <fstream>

#include "nacre/math/random.h"
#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/facets.h"
#include "nacre/reflectance/schlick.h"
#include "nacre/reflectance/schlick_ct.h"
#include "nacre/vectors/file.h"
#include "tests/reflectance/family_data.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

using test::at_degrees;

Vec3d any_direction(Random& random) {
    const double z = 0.05 + 0.95 * double(random.next()), phi = 2. * pi * double(random.next());
    const double s = std::sqrt(1. - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}

double albedo(const char* model, const std::string& settings, double degrees) {
    return directional_albedo(make_model(model, parse_settings(settings)), at_degrees(degrees))
        .value;
}

/// Mass of the density with which a model draws directions for light from the normal.
double mass(const char* model, const char* settings) {
    const AnyModel m = make_model(model, parse_settings(settings));
    const Vec3d n{0., 0., 1.};
    return integrate_hemisphere([&](const Vec3d& w) { return m.pdf(w, n); }, n).value;
}

/// Integral over normals of f(tan^2) cos.
template <class F>
double projected(F&& f) {
    // The variable is log(tan), over which every width looks alike.
    const GaussLegendre nodes(24);
    double sum = 0.;
    for (double from = -20.; from < 20.; from += 0.125)
        sum += nodes.integrate(from, from + 0.125, [&](double x) {
            const double tan2 = std::exp(2. * x), c2 = 1. / (1. + tan2);
            return f(tan2) * 2. * pi * tan2 * c2 * c2;
        });
    return sum;
}

}  // namespace

TEST(ReferenceTables, ModelsAreReciprocalWhereTheTableSaysSo) {
    const auto all = nlohmann::json::parse(
        std::ifstream(NACRE_SOURCE_DIR "/tests/reflectance/data/vectors.json"));
    int rows = 0;
    for (const auto& row : all["reciprocity"]) {
        const std::string group = row["model"];
        const GroupModel who = model_of_group(group);
        ASSERT_TRUE(who.evaluator) << group;
        Random random(stream_key(19, 94));
        double largest = 0.;
        for (const auto& v : all["models"][group]["vectors"]) {
            const AnyModel model = model_of_vector(who, v["params"]);
            for (int i = 0; i < 17; ++i) {
                const Vec3d a = any_direction(random), b = any_direction(random);
                const double f = model.eval(a, b), back = model.eval(b, a);
                if (f != back)
                    largest = std::max(largest,
                                       std::abs(f - back) / std::max(std::abs(f), std::abs(back)));
            }
        }
        if (row["reciprocal"])
            EXPECT_LT(largest, 1e-13) << group;  // the table's largest residual is 6e-15
        else
            EXPECT_GT(largest, 0.5) << group;  // and those of the others 0.61 and 0.95
        ++rows;
    }
    EXPECT_EQ(rows, 25);
}

TEST(ReferenceTables, PhongLobesHaveTheirClosedAlbedos) {
    for (double n : {1., 10., 100.}) {
        const std::string modified = fmt::format("variant=modified kd=0 ks=1 n={}", n);
        EXPECT_NEAR(albedo("phong", modified, 0.), 1., 1e-7) << n;
        // (n + 2) / (2 pi) B((n + 1)/2, 3/2) of the light that grazes.
        const double grazing = (n + 2.) / (2. * pi) * std::beta(0.5 * (n + 1.), 1.5);
        EXPECT_NEAR(albedo("phong", modified, 89.9999), grazing, 2e-6) << n;
        EXPECT_NEAR(albedo("blinn_phong", fmt::format("variant=normalized kd=0 ks=1 n={}", n), 0.),
                    1., 1e-7)
            << n;
    }
}

TEST(ReferenceTables, DistributionsHaveTheirNorms) {
    using facet_detail::facet_density;
    for (double m : {0.05, 0.2, 0.5, 1.}) {
        const double gauss = facet_detail::gauss_constant(m);
        for (const FacetDistribution kind :
             {FacetDistribution::beckmann, FacetDistribution::trowbridge_reitz,
              FacetDistribution::gauss})
            EXPECT_NEAR(projected([&](double t2) { return facet_density(kind, t2, m, gauss); }), 1.,
                        1e-9)
                << int(kind) << " " << m;
        SchlickCt<double> rational{};
        rational.m = m;
        // Schlick's rational form is divided by pi where it is used; it has kinks.
        EXPECT_NEAR(projected([&](double t2) {
                        return rational.density(at_degrees(std::atan(std::sqrt(t2)) * 180. / pi));
                    }),
                    pi, 3e-5)
            << m;
        EXPECT_NEAR(projected([&](double t2) { return schlick_zenith(t2, m); }), pi, 1e-9) << m;
    }
    for (double n : {1., 10., 100.})
        EXPECT_NEAR(projected([&](double t2) {
                        return facet_density(FacetDistribution::phong, t2, n, 0.);
                    }),
                    1., 1e-9)
            << n;
}

TEST(ReferenceTables, SmithsMaskingShowsTheWholeSurface) {
    // G1 times the integral of D <w, h> over normals is the cosine.
    const GaussLegendre nodes(120);
    for (double degrees : {0., 30., 60., 80.}) {
        const Vec3d w = at_degrees(degrees);
        const double tan = 0.4 * facet_detail::bounded_tangent(w);
        for (const auto& [kind, lambda] :
             {std::pair{FacetDistribution::beckmann, facet_detail::lambda_beckmann(tan)},
              {FacetDistribution::trowbridge_reitz, facet_detail::lambda_trowbridge_reitz(tan)}}) {
            const double seen = nodes.integrate(0., 0.5 * pi, [&](double theta) {
                const double t = std::tan(theta);
                const double d = facet_detail::facet_density(kind, t * t, 0.4, 0.);
                // Facets face w up to an azimuth where the integrand has its kink.
                const double ct = std::cos(theta), st = std::sin(theta);
                const double reach = w.x * st > w.z * ct ? std::acos(-w.z * ct / (w.x * st)) : pi;
                const double ring = 2. * (w.z * ct * reach + w.x * st * std::sin(reach));
                return d * st * ring;
            });
            EXPECT_NEAR(seen / (1. + lambda), w.z, 3e-6 * w.z) << int(kind) << " " << degrees;
        }
    }
}

TEST(ReferenceTables, EonIsWhiteAndFujiisMeanIsItsClosedForm) {
    const GaussLegendre nodes(40);
    for (double r : {0.3, 1.}) {
        for (double degrees : {0., 60., 80.})
            EXPECT_NEAR(albedo("eon", fmt::format("reflectance=1 roughness={}", r), degrees), 1.,
                        1e-7);
        const AnyModel fujii = make_model(
            "eon", parse_settings(fmt::format("variant=fujii reflectance=1 roughness={}", r)));
        const double mean = nodes.integrate(0., 1., [&](double mu) {
            return 2. * mu *
                   directional_albedo(fujii, {std::sqrt(1. - mu * mu), 0., mu}, 550., 1e-7).value;
        });
        EXPECT_NEAR(mean, r == 1. ? 0.832810763579 : 0.940541932923, 1e-6);
    }
}

TEST(ReferenceTables, DensitiesHaveTheMassOfTheHemisphere) {
    EXPECT_NEAR(mass("phong", "kd=0 ks=1 n=20"), 1., 1e-7);
    EXPECT_NEAR(mass("ward", "kd=0 ks=1 alpha_u=0.2 alpha_v=0.4"), 0.999524237036, 1e-6);
    EXPECT_NEAR(mass("schlick", "form=simple r=0.2 p=0.5"), 0.833333333333, 1e-6);
    EXPECT_NEAR(mass("ggx", "alpha=0.4 compensation=none"), 0.862068965517, 1e-6);
}

}  // namespace nacre
