// <bsdf type="hk">: is it the slab of layers/hanrahan_krueger.h, in the units that it states? The
// tests of test_materials.cpp concern it as well.
#include <fstream>
#include <nlohmann/json.hpp>

#include "nacre/layers/hanrahan_krueger.h"
#include "nacre/math/random.h"
#include "nacre/optics/media.h"
#include "tests/scene/material_fixture.h"

namespace nacre {
namespace {

using test::bsdf;
using test::child;
using test::number;
using test::rgb;
using test::text;

Vec3f direction_of_degrees(double degrees, double azimuth) {
    const double t = degrees * std::numbers::pi / 180., p = azimuth * std::numbers::pi / 180.;
    return {float(std::sin(t) * std::cos(p)), float(std::sin(t) * std::sin(p)), float(std::cos(t))};
}

TEST(HkMaterial, HasTheReferenceValues) {
    std::ifstream file(NACRE_SOURCE_DIR "/tests/layers/data/hanrahan_krueger.json");
    const auto vectors = nlohmann::json::parse(file);
    int checked = 0;
    for (const auto& row : vectors["slabs"]) {
        const auto phase = test::node("phase", "hg", {number("g", row["g"])});
        const MaterialPtr m =
            test::material(bsdf("hk",
                                {number("sigma_s", row["W"]), number("sigma_a", 0.),
                                 number("thickness", row["tau"]), number("int_ior", row["n"])},
                                {child(phase)}));
        const test::Bound layer(m);
        const Vec3f wi = direction_of_degrees(row["theta_i"], 0.);
        for (const auto& sample : row["samples"]) {
            const Vec3f wo = direction_of_degrees(sample["theta_o"], double(sample["phi"]) + 180.);
            const double f_r = sample["f_r"], f_t = sample["f_t"];
            EXPECT_NEAR(layer->eval(wi, wo)[0], f_r * wi.z, 1e-5 * f_r) << row;
            EXPECT_NEAR(layer->eval(wi, {wo.x, wo.y, -wo.z})[0], f_t * wi.z, 1e-5 * f_t) << row;
            ++checked;
        }
        if (row.contains("unscattered_T")) {
            EXPECT_NEAR(layer->null_transmission(wi)[0], double(row["unscattered_T"]), 1e-6);
            EXPECT_EQ(m->flags(), reflects | transmits | has_smooth | has_null);
        } else {
            EXPECT_EQ(m->flags(), reflects | transmits | has_smooth | has_null | has_delta);
        }
    }
    EXPECT_EQ(checked, 54 * 6);
}

TEST(HkMaterial, SamplesHaveTheTotalsOfTheLayer) {
    const auto phase = test::node("phase", "hg", {number("g", 0.6)});
    for (const double n : {1., 1.33})
        for (const float cosine : {0.9f, 0.4f, -0.5f}) {
            const auto layer = test::bound(
                bsdf("hk",
                     {rgb("sigma_s", {4.f, 1.f, 0.2f}), rgb("sigma_a", {0.1f, 0.5f, 0.f}),
                      number("thickness", 0.8), number("int_ior", n)},
                     {child(phase)}));
            const Vec3f wo{std::sqrt(1.f - cosine * cosine), 0.f, cosine};
            Random random(stream_key(21, 3));
            const int samples = 60000;
            double sums[3][2] = {}, squares[3][2] = {};
            for (int i = 0; i < samples; ++i) {
                const float u1 = random.next();
                const auto s = layer->sample(wo, u1, random.next2());
                if (!s) continue;
                for (int c = 0; c < 3; ++c) {
                    sums[c][s->wi.z * cosine < 0.f] += s->weight[c];
                    squares[c][s->wi.z * cosine < 0.f] += double(s->weight[c]) * s->weight[c];
                }
            }
            for (int c = 0; c < 3; ++c) {
                const double sigma_s[] = {4., 1., 0.2}, sigma_a[] = {0.1, 0.5, 0.};
                const LayerTotals t = HanrahanKruegerStack(LayerStack{{{.sigma_s = sigma_s[c],
                                                                        .sigma_a = sigma_a[c],
                                                                        .g = 0.6,
                                                                        .thickness = 0.8,
                                                                        .eta = n}}})
                                          .totals(std::abs(cosine));
                const double expected[2] = {t.reflectance, t.transmittance};
                EXPECT_LE(t.reflectance + t.transmittance, 1.);
                for (int side = 0; side < 2; ++side) {
                    const double mean = sums[c][side] / samples;
                    const double error =
                        std::sqrt((squares[c][side] / samples - mean * mean) / samples);
                    // 36 comparisons: all hold at 4 sigma but with probability 0.2 %.
                    EXPECT_NEAR(mean, expected[side], 4. * error)
                        << "n " << n << " cosine " << cosine << " band " << c;
                }
            }
        }
}

TEST(HkMaterial, WaysToStateTheMediumAgree) {
    const Vec3f wo = direction_of_degrees(30., 0.), wi = direction_of_degrees(50., 120.);
    const auto value = [&](std::vector<SceneValue> values) {
        return test::bound(bsdf("hk", std::move(values)))->eval(wi, wo);
    };
    const MeasuredMedium& marble = measured_media().find("marble");
    const Spectral named = value({text("material", "Marble")});
    const Spectral given =
        value({rgb("sigma_s", marble.sigma_s_prime), rgb("sigma_a", marble.sigma_a)});
    const Vec3f t = marble.sigma_t_prime();
    const Spectral extinction =
        value({rgb("sigma_t", t),
               rgb("albedo", {marble.sigma_s_prime.x / t.x, marble.sigma_s_prime.y / t.y,
                              marble.sigma_s_prime.z / t.z})});
    const Spectral nothing = value({}), skin = value({text("material", "skin1")});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(named[c], given[c], 1e-6f);
        EXPECT_NEAR(named[c], extinction[c], 1e-5f);
        EXPECT_EQ(nothing[c], skin[c]);
        EXPECT_GT(named[c], 0.f);
    }
}

TEST(HkMaterial, ThicknessIsInMillimetresInEveryScene) {
    const auto n =
        bsdf("hk", {number("sigma_t", 2.), number("albedo", 0.5), number("thickness", 0.25)});
    BuildContext metres;
    metres.mm_per_unit = 1000.;
    const Vec3f along{0.f, 0.f, 1.f};
    EXPECT_NEAR(test::Bound(make_material(*n, metres))->null_transmission(along)[1],
                std::exp(-0.5f), 1e-6f);
}

TEST(HkMaterial, EndsOfTheRangesAreFinite) {
    const double inf = std::numeric_limits<double>::infinity();
    const Vec3f wo = direction_of_degrees(30., 0.);
    const auto layer = [](double scattering, double absorption, double thickness) {
        return test::bound(bsdf("hk", {number("sigma_s", scattering), number("sigma_a", absorption),
                                       number("thickness", thickness)}));
    };
    // A half space lets nothing pass; a clear layer everything.
    const auto half = layer(1., 0.1, inf), clear = layer(0., 0., inf);
    EXPECT_EQ(half->null_transmission(wo)[1], 0.f);
    EXPECT_EQ(clear->null_transmission(wo)[1], 1.f);
    for (const float u : {0.f, 0.5f, 0.99f}) {
        EXPECT_TRUE(clear->sample(wo, u, {0.3f, 0.3f})->null);
        const auto s = half->sample(wo, u, {0.3f, 0.3f});
        ASSERT_TRUE(s);
        EXPECT_TRUE(std::isfinite(s->weight[1]));
    }
    // Black and opaque: nothing comes back.
    EXPECT_FALSE(layer(0., 1., inf)->sample(wo, 0.5f, {0.3f, 0.3f}));
}

}  // namespace
}  // namespace nacre
