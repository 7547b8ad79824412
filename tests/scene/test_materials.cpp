// Every material: does it sample what it says, is it reciprocal, does it keep energy?
#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"
#include "tests/reflectance/chi_square.h"
#include "tests/scene/bands.h"
#include "tests/scene/material_fixture.h"

namespace nacre {
namespace {

Vec3f direction_of_cosine(double cosine, double phi) {
    const double s = std::sqrt(1. - cosine * cosine);
    return {float(s * std::cos(phi)), float(s * std::sin(phi)), float(cosine)};
}

/// Viewers in front and, where something happens there, behind.
std::vector<Vec3f> viewers(const test::NamedMaterial& m) {
    std::vector<Vec3f> list = {direction_of_cosine(0.98, 0.3), direction_of_cosine(0.6, 2.),
                               direction_of_cosine(0.2, -1.)};
    if (m.two_sides)
        for (int i = 0; i < 3; ++i) list.push_back({list[i].x, list[i].y, -list[i].z});
    return list;
}

struct Shares {
    double reflected = 0., transmitted = 0., discrete = 0.;  ///< power; probability
};

/// Mean power of the samples in the green band.
Shares shares(const Material& m, const Vec3f& wo, int n = 40000) {
    Random random(stream_key(77, 1));
    Shares sum;
    const test::Bound bsdf(m);
    for (int i = 0; i < n; ++i) {
        const float u1 = random.next();
        const auto s = bsdf->sample(wo, u1, random.next2());
        if (!s) continue;
        // Radiance has the factor 1/eta^2 that power has not.
        const double power = double(s->weight[1]) * s->eta * s->eta / n;
        (s->wi.z * wo.z > 0.f ? sum.reflected : sum.transmitted) += power;
        if (s->delta) sum.discrete += 1. / n;
    }
    return sum;
}

}  // namespace

TEST(Materials, SampleWhatTheirDensitySays) {
    const auto materials = test::all_materials();
    int tests = 0;
    for (const auto& m : materials) tests += static_cast<int>(viewers(m).size());
    std::uint64_t seed = 100;
    for (const auto& m : materials)
        for (const Vec3f& wo : viewers(m)) {
            const test::Bound bsdf(m.material);
            const auto result = test::chi_square(
                [&](Random& random) -> std::optional<Vec3f> {
                    const float u1 = random.next();
                    const auto s = bsdf->sample(wo, u1, random.next2());
                    return s && !s->delta ? std::optional(s->wi) : std::nullopt;
                },
                [&](const Vec3f& wi) { return bsdf->pdf(wi, wo); }, ++seed, 30000, 32, 24);
            EXPECT_GT(result.p, test::sidak(tests))
                << m.name << " seen from cosine " << wo.z << ": the density integrates to "
                << result.integral << ", drawn are " << result.drawn;
        }
}

TEST(Materials, WeighSamplesByValueOverDensity) {
    for (const auto& m : test::all_materials())
        for (const Vec3f& wo : viewers(m)) {
            Random random(stream_key(3, 4));
            const test::Bound bsdf(m.material);
            bool smooth = false, delta = false, null = false;
            for (int i = 0; i < 3000; ++i) {
                const float u1 = random.next();
                const auto s = bsdf->sample(wo, u1, random.next2());
                if (!s) continue;
                ASSERT_NEAR(length(s->wi), 1.f, 1e-4f) << m.name;
                ASSERT_GT(s->pdf, 0.f) << m.name;
                EXPECT_FALSE(s->single_wavelength) << m.name;
                (s->null ? null : s->delta ? delta : smooth) = true;
                if (s->null) {
                    EXPECT_EQ(s->wi, -wo) << m.name;
                }
                if (s->wi.z * wo.z > 0.f || s->null) {
                    EXPECT_EQ(s->eta, 1.f) << m.name;
                }
                if (s->delta) continue;
                const float pdf = bsdf->pdf(s->wi, wo);
                ASSERT_NEAR(s->pdf, pdf, 1e-3f * pdf) << m.name;
                const Spectral value = bsdf->eval(s->wi, wo);
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(s->weight[c] * pdf, value[c], 1e-3f * value[c] + 1e-6f) << m.name;
            }
            const unsigned flags = m.material->flags();
            EXPECT_LE(smooth, bool(flags & has_smooth)) << m.name;
            EXPECT_LE(delta, bool(flags & has_delta)) << m.name;
            EXPECT_EQ(null, bool(flags & has_null)) << m.name;
        }
}

TEST(Materials, AreReciprocal) {
    for (const auto& m : test::all_materials()) {
        Random random(stream_key(9, 9));
        const test::Bound bsdf(m.material);
        for (int i = 0; i < 3000; ++i) {
            const Vec3f a = direction_of_cosine(1.98 * random.next() - 0.99, 6.28 * random.next());
            const Vec3f b = direction_of_cosine(1.98 * random.next() - 0.99, 6.28 * random.next());
            if (std::abs(a.z) < 0.02f || std::abs(b.z) < 0.02f) continue;
            // f(wi, wo) n_i^2 = f(wo, wi) n_o^2 with n the index on the side of each.
            const double na = a.z > 0.f ? 1. : m.eta, nb = b.z > 0.f ? 1. : m.eta;
            const Spectral ab = bsdf->eval(b, a) / std::abs(b.z);
            const Spectral ba = bsdf->eval(a, b) / std::abs(a.z);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(ab[c] * nb * nb, ba[c] * na * na, 2e-3 * ba[c] * na * na + 1e-6)
                    << m.name << " " << a.z << " " << b.z;
        }
    }
}

TEST(Materials, NeverReturnMoreThanTheyReceive) {
    for (const auto& m : test::all_materials())
        for (const Vec3f& wo : viewers(m)) {
            const Shares s = shares(*m.material, wo);
            EXPECT_LE(s.reflected + s.transmitted, 1.01) << m.name << " " << wo.z;
        }
}

TEST(Materials, LoseNothingWhereNothingAbsorbs) {
    const auto check = [](const char* name, const SceneNodePtr& n, bool both_sides,
                          double tolerance) {
        const MaterialPtr m = test::material(n);
        for (const Vec3f& wo : viewers({name, m, both_sides})) {
            const Shares s = shares(*m, wo);
            EXPECT_NEAR(s.reflected + s.transmitted, 1., tolerance) << name << " " << wo.z;
        }
    };
    using namespace test;
    check("dielectric", bsdf("dielectric"), true, 1e-4);
    check("thindielectric", bsdf("thindielectric"), true, 1e-4);
    check("null", bsdf("null"), true, 1e-4);
    check("diffuse", bsdf("diffuse", {number("reflectance", 1.)}), false, 1e-4);
    check("conductor", bsdf("conductor"), false, 1e-4);
    check("plastic", bsdf("plastic", {number("diffuse_reflectance", 1.)}), false, 5e-3);
    check("nonlinear plastic",
          bsdf("plastic", {number("diffuse_reflectance", 1.), flag("nonlinear", true)}), false,
          5e-3);
    check("difftrans", bsdf("difftrans", {number("transmittance", 1.)}), true, 1e-4);
    // Under its boundary: all passes on or is mirrored, but for the 0.002 of a rough boundary.
    const auto boundary =
        bsdf("metallic_roughness",
             {number("base_color", 0.), number("roughness", 0.1), text("coupling", "shirley")});
    check("coated difftrans",
          bsdf("difftrans", {number("transmittance", 1.), number("coat", 1.)}, {child(boundary)}),
          true, 0.01);
    check("blendbsdf",
          bsdf("blendbsdf", {number("weight", 0.4)},
               {child(bsdf("dielectric")), child(bsdf("null"))}),
          true, 1e-4);
    // Facets in series are neglected: 1 % at this roughness but for grazing views.
    const MaterialPtr frosted = material(bsdf("roughdielectric", {number("alpha", 0.1)}));
    const Shares s = shares(*frosted, direction_of_cosine(0.9, 1.));
    EXPECT_NEAR(s.reflected + s.transmitted, 1., 0.01);
}

// A matte part of 0.3 and 0.2 of one of 0.5 are one of 0.4, and a share of a mirror is that share.
TEST(Materials, SumsAddUp) {
    using namespace test;
    const auto grey = [](double r) { return child(bsdf("diffuse", {number("reflectance", r)})); };
    const test::Bound sum(
        material(bsdf("sumbsdf", {number("weight2", 0.2), number("weight3", 0.25)},
                      {grey(0.3), grey(0.5), child(bsdf("conductor"))})));
    const Vec3f wo = direction_of_cosine(0.6, 0.3);
    for (double cosine : {0.1, 0.5, 0.95})
        EXPECT_NEAR(sum->eval(direction_of_cosine(cosine, 2.), wo)[1],
                    0.4 / std::numbers::pi * cosine, 1e-6);
    Random random(stream_key(5, 1));
    double smooth = 0., mirrored = 0.;
    const int n = 40000;
    for (int i = 0; i < n; ++i) {
        const float u1 = random.next();
        const auto s = sum->sample(wo, u1, random.next2());
        ASSERT_TRUE(s);
        (s->delta ? mirrored : smooth) += s->weight[1] / n;
    }
    // Of samples two thirds and a sixth and a sixth: standard errors below 0.002.
    EXPECT_NEAR(smooth, 0.4, 0.01);
    EXPECT_NEAR(mirrored, 0.25, 0.01);
}

TEST(Materials, SplitLightByFresnelsEquations) {
    for (float cosine : {0.2f, 0.5f, 0.9f, -0.3f, -0.9f}) {
        const float glass = 1.5046f / 1.000277f, eta = cosine > 0.f ? glass : 1.f / glass;
        const double f = fresnel_dielectric(std::abs(cosine), eta);
        const Vec3f wo = direction_of_cosine(cosine, 0.7);
        const Shares smooth = shares(*test::material(test::bsdf("dielectric")), wo);
        EXPECT_NEAR(smooth.reflected, f, 0.01) << cosine;
        const Shares rough = shares(
            *test::material(test::bsdf("roughdielectric", {test::number("alpha", 0.005)})), wo);
        EXPECT_NEAR(rough.reflected, f, 0.012) << cosine;
        EXPECT_NEAR(rough.transmitted, 1. - f, 0.012) << cosine;
        const Shares thin = shares(*test::material(test::bsdf("thindielectric")), wo);
        const double face = fresnel_dielectric(std::abs(cosine), glass);
        EXPECT_NEAR(thin.reflected, 2. * face / (1. + face), 0.01) << cosine;
    }
}

TEST(Materials, RefractByTheLawOfSnell) {
    const auto glass = test::material(
        test::bsdf("dielectric", {test::number("int_ior", 1.5), test::number("ext_ior", 1.)}));
    EXPECT_FLOAT_EQ(glass->smooth_boundary_eta(), 1.5f);
    const test::Bound bsdf(glass);
    const auto in = bsdf->sample({0.6f, 0.f, 0.8f}, 0.999f, {});
    ASSERT_TRUE(in);
    EXPECT_NEAR(in->wi.x, -0.4f, 1e-6f);
    EXPECT_LT(in->wi.z, 0.f);
    EXPECT_FLOAT_EQ(in->eta, 1.5f);
    EXPECT_NEAR(in->weight[0], 1. / 2.25, 1e-6);
    const auto out = bsdf->sample(in->wi, 0.999f, {});
    ASSERT_TRUE(out);
    EXPECT_NEAR(out->wi.x, 0.6f, 1e-6f);
    EXPECT_NEAR(out->weight[0], 2.25, 1e-5);
    // Beyond the critical angle everything is reflected.
    const auto total = bsdf->sample(direction_of_cosine(-0.5, 0.), 0.999f, {});
    ASSERT_TRUE(total);
    EXPECT_LT(total->wi.z, 0.f);
    EXPECT_FLOAT_EQ(total->pdf, 1.f);
}

TEST(Materials, PlasticsBaseHasItsClosedForm) {
    const double eta = 1.49 / 1.000277, inner = diffuse_reflectance_internal(eta);
    for (bool nonlinear : {false, true})
        for (double cosine : {0.2, 0.7}) {
            const auto m =
                test::material(test::bsdf("plastic", {test::number("diffuse_reflectance", 0.6),
                                                      test::flag("nonlinear", nonlinear)}));
            const double f = fresnel_dielectric(cosine, eta);
            const double base =
                (1. - f) * 0.6 * (1. - inner) / (1. - (nonlinear ? 0.6 : 1.) * inner);
            EXPECT_NEAR(shares(*m, direction_of_cosine(cosine, 0.)).reflected, f + base, 0.006)
                << cosine;
        }
}

TEST(Materials, BecomeSmoothAsRoughnessVanishes) {
    using namespace test;
    const Vec3f wo = direction_of_cosine(0.7, 1.), mirror{-wo.x, -wo.y, wo.z};
    const auto gold = bound(bsdf("conductor", {text("material", "Au")}));
    for (const char* distribution : {"beckmann", "ggx"}) {
        const auto rough =
            bound(bsdf("roughconductor", {text("material", "Au"), number("alpha", 1e-3),
                                          text("distribution", distribution)}));
        const auto a = gold->sample(wo, 0.5f, {0.3f, 0.4f});
        const auto b = rough->sample(wo, 0.5f, {0.3f, 0.4f});
        ASSERT_TRUE(a && b);
        EXPECT_LT(length(b->wi - mirror), 5e-3f);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a->weight[c], b->weight[c], 2e-3f);
    }
}

TEST(Materials, DispersionLeavesOneWavelength) {
    using namespace test;
    const auto prism = material(bsdf("dielectric", {text("int_ior", "cauchy 1.5 0.005")}));
    EXPECT_TRUE(prism->is_spectral());
    EXPECT_FALSE(material(bsdf("dielectric"))->is_spectral());
    const Wavelengths w = Wavelengths::at(Spectral(400.f, 500.f, 600.f, 700.f));
    const Vec3f wo{0.6f, 0.f, 0.8f};
    const Bound spectral(prism, {}, w);
    const auto in = spectral->sample(wo, 0.99f, {});
    ASSERT_TRUE(in);
    EXPECT_TRUE(in->single_wavelength);
    const float n = (1.5f + 0.005f / 0.16f) / 1.000277f;
    EXPECT_NEAR(in->wi.x, -0.6f / n, 1e-6f);
    EXPECT_NEAR(in->weight[0], 1.f / (n * n), 1e-6f);
    for (int i = 1; i < 4; ++i) EXPECT_EQ(in->weight[i], 0.f);
    // The mirror image is the same at all wavelengths, though not as bright.
    const auto back = spectral->sample(wo, 0.f, {});
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->single_wavelength);
    EXPECT_FLOAT_EQ(back->weight[0], 1.f);
    EXPECT_LT(back->weight[3], back->weight[0]);
    EXPECT_GT(back->weight[3], 0.9f);
    EXPECT_FALSE(Bound(prism)->sample(wo, 0.99f, {})->single_wavelength);
}

TEST(Materials, LetShadowRaysPass) {
    using namespace test;
    const Vec3f wo = direction_of_cosine(0.5, 0.);
    const auto through = [&](const SceneNodePtr& n) { return bound(n)->null_transmission(wo)[1]; };
    const float f = fresnel_dielectric(0.5f, 1.5046f / 1.000277f);
    EXPECT_FLOAT_EQ(through(bsdf("null")), 1.f);
    EXPECT_NEAR(through(bsdf("thindielectric")), (1.f - f) / (1.f + f), 1e-5f);
    EXPECT_FLOAT_EQ(through(bsdf("mask", {number("opacity", 0.3)}, {child(bsdf("diffuse"))})),
                    0.7f);
    EXPECT_NEAR(through(bsdf("mask", {number("opacity", 0.3)}, {child(bsdf("thindielectric"))})),
                0.7f + 0.3f * (1.f - f) / (1.f + f), 1e-5f);
    EXPECT_FLOAT_EQ(through(bsdf("diffuse")), 0.f);
    EXPECT_FLOAT_EQ(through(bsdf("dielectric")), 0.f);
}

TEST(Materials, ShareOneObjectAmongReferences) {
    BuildContext context;
    const auto n = test::bsdf("diffuse");
    EXPECT_EQ(make_material(*n, context), make_material(*n, context));
}

}  // namespace nacre
