#include "nacre/optics/fresnel.h"
#include "nacre/reflectance/beckmann.h"
#include "nacre/reflectance/ggx.h"
#include "tests/reflectance/chi_square.h"
#include "tests/reflectance/reference.h"

namespace nacre {
namespace {

template <class T>
class Microfacet : public testing::Test {};
using Distributions = testing::Types<Beckmann<double>, Ggx<double>>;
TYPED_TEST_SUITE(Microfacet, Distributions);

Vec3d direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Integral of f over the upper hemisphere, by slopes stretched by the roughness, so that narrow
/// lobes are resolved: h = (-sx, -sy, 1) normalised, dh = hz^3 dsx dsy, sx = ax tan(t) cos(phi).
template <class Distribution, class F>
double integrate_normals(const Distribution& d, F&& f) {
    const GaussLegendre nodes(96);
    const double pi = std::numbers::pi;
    return nodes.integrate(0., pi / 2, [&](double t) {
        const double r = std::tan(t), dr = 1. + r * r;
        return nodes.integrate(0., 2. * pi, [&](double phi) {
            const Vec3d h =
                normalize(Vec3d{d.alpha_x * r * std::cos(phi), d.alpha_y * r * std::sin(phi), 1.});
            return f(h) * h.z * h.z * h.z * d.alpha_x * d.alpha_y * r * dr;
        });
    });
}

}  // namespace

TYPED_TEST(Microfacet, FacetsProjectToTheAreaOfTheSurface) {
    for (const auto& [ax, ay] : {std::pair{0.05, 0.05}, {0.3, 0.3}, {0.2, 0.6}, {1.0, 1.0}}) {
        const TypeParam d{ax, ay};
        EXPECT_NEAR(integrate_normals(d, [&](const Vec3d& h) { return d.density(h) * h.z; }), 1.,
                    1e-6)
            << ax << " " << ay;
    }
}

// The visible area of the facets is that of the surface: what makes Smith's masking the right one.
// The rational fit of Walter et al. 2007 misses this by 0.3 %.
TYPED_TEST(Microfacet, VisibleFacetsProjectToTheVisibleArea) {
    for (const auto& [ax, ay] : {std::pair{0.1, 0.1}, {0.3, 0.3}, {0.2, 0.6}, {1.0, 1.0}})
        for (double theta : {0.01, 0.5, 1.0, 1.4}) {
            const TypeParam d{ax, ay};
            const Vec3d w = direction(theta, 0.7);
            const double sum =
                integrate_normals(d, [&](const Vec3d& h) { return visible_density(d, w, h); });
            EXPECT_NEAR(sum, 1., 2e-4) << ax << " " << ay << " at " << theta;
        }
}

TYPED_TEST(Microfacet, NormalsFollowTheirDensity) {
    struct Case {
        double ax, ay, theta, phi;
    };
    const Case cases[] = {{0.3, 0.3, 0., 0.},    {0.3, 0.3, 0.8, 1.}, {0.3, 0.3, 1.45, -2.},
                          {0.2, 0.6, 1.0, 0.6},  {1.0, 1.0, 1.2, 3.}, {0.6, 0.15, 1.3, 1.5},
                          {0.9, 0.9, 1.56, -0.3}};
    std::uint64_t seed = 11;
    for (const Case& c : cases)
        for (const auto sampling : {NormalSampling::visible, NormalSampling::all}) {
            const TypeParam d{c.ax, c.ay};
            const Vec3d w = direction(c.theta, c.phi);
            const auto result = test::chi_square(
                [&](Random& random) -> std::optional<Vec3f> {
                    const Vec2f u = random.next2();
                    return Vec3f(sample_normal(d, sampling, w, Vec2<double>{u.x, u.y}));
                },
                [&](const Vec3f& h) {
                    return h.z > 0.f ? normal_pdf(d, sampling, w, normalize(Vec3d(h))) : 0.;
                },
                ++seed);
            EXPECT_GT(result.p, test::sidak(4 * std::size(cases)))
                << c.ax << " " << c.ay << " at " << c.theta << ", integral " << result.integral;
        }
}

// Single precision draws what double precision draws, out to the ends of the unit square.
TYPED_TEST(Microfacet, SinglePrecisionDrawsTheSameNormals) {
    using Single =
        std::conditional_t<std::is_same_v<TypeParam, Ggx<double>>, Ggx<float>, Beckmann<float>>;
    Random random(stream_key(5, 6));
    for (int i = 0; i < 2000; ++i) {
        const float alpha = 0.01f + random.next(), z = 0.001f + 0.998f * random.next();
        const Vec3f w{std::sqrt(1.f - z * z), 0.f, z};
        Vec2f u = random.next2();
        if (i % 10 == 0) u.x = 0.f;
        if (i % 10 == 1) u.x = 0x1.fffffep-1f;
        if (i % 10 == 2) u.y = 0.f;
        const Vec3f h = Single{alpha, alpha}.sample_visible(w, u);
        const Vec3d exact =
            TypeParam{alpha, alpha}.sample_visible(Vec3d(w), Vec2<double>{u.x, u.y});
        ASSERT_NEAR(length(h), 1.f, 1e-5f);
        ASSERT_GT(h.z, 0.f);
        if (i % 10 > 2) {
            ASSERT_LT(length(Vec3d(h) - exact), 5e-3) << alpha << " " << z;
        }
    }
}

TEST(MicrofacetReference, DensitiesAgree) {
    const auto data = test::reflectance_vectors();
    if (data.is_null()) GTEST_SKIP() << "shared reference data are absent";
    for (const auto& v : data["scalars"]["ndf"]["vectors"]) {
        const double theta = v["params"]["theta_deg"].get<double>() * std::numbers::pi / 180.;
        const double m = v["params"]["m"].get<double>();
        const double beckmann = v["values"]["beckmann"].get<double>();
        const double ggx = v["values"]["trowbridge_reitz"].get<double>();
        const Vec3d h = direction(theta, 0.4);
        EXPECT_NEAR((Beckmann<double>{m, m}.density(h)), beckmann, 1e-9 * beckmann) << v["id"];
        EXPECT_NEAR((Ggx<double>{m, m}.density(h)), ggx, 1e-9 * ggx) << v["id"];
    }
}

TEST(MicrofacetReference, MaskingAgrees) {
    const auto data = test::reflectance_vectors();
    if (data.is_null()) GTEST_SKIP() << "shared reference data are absent";
    const double degree = std::numbers::pi / 180.;
    for (const auto& v : data["scalars"]["masking"]["vectors"]) {
        const auto& p = v["params"];
        const double m = p["m"].get<double>();
        const Vec3d wi = direction(p["theta_i_deg"].get<double>() * degree, 0.);
        const Vec3d wo = direction(p["theta_o_deg"].get<double>() * degree,
                                   p["dphi_deg"].get<double>() * degree);
        const Vec3d h = half_vector(wi, wo);
        const Beckmann<double> beckmann{m, m};
        const Ggx<double> ggx{m, m};
        EXPECT_NEAR(smith_g1(beckmann, wi, h) * smith_g1(beckmann, wo, h),
                    v["values"]["smith_beckmann_sep"].get<double>(), 1e-9)
            << v["id"];
        EXPECT_NEAR(smith_g1(ggx, wi, h) * smith_g1(ggx, wo, h),
                    v["values"]["smith_ggx_sep"].get<double>(), 1e-9)
            << v["id"];
    }
}

TEST(MicrofacetReference, DensitiesOfMirroredDirectionsAgree) {
    const auto data = test::reflectance_vectors();
    if (data.is_null()) GTEST_SKIP() << "shared reference data are absent";
    const auto check = [&](const char* name, auto density) {
        for (const auto& v : data["models"][name]["vectors"]) {
            const double m = v["params"]["m"].get<double>();
            const Vec3d given = test::vector(v["wi"]), drawn = test::vector(v["wo"]);
            const Vec3d h = half_vector(given, drawn);
            const double expected = v["value"].get<double>();
            EXPECT_NEAR(density(m, given, h) / (4. * dot(given, h)), expected, 1e-9 * expected)
                << v["id"];
        }
    };
    check("pdf_beckmann", [](double m, const Vec3d& w, const Vec3d& h) {
        return normal_pdf(Beckmann<double>{m, m}, NormalSampling::all, w, h);
    });
    check("pdf_ggx", [](double m, const Vec3d& w, const Vec3d& h) {
        return normal_pdf(Ggx<double>{m, m}, NormalSampling::all, w, h);
    });
    check("pdf_vndf_ggx", [](double m, const Vec3d& w, const Vec3d& h) {
        return normal_pdf(Ggx<double>{m, m}, NormalSampling::visible, w, h);
    });
}

}  // namespace nacre
