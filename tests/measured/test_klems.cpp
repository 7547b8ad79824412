#include "nacre/measured/klems.h"

#include <numbers>

#include "nacre/math/random.h"
#include "nacre/measured/surface.h"
#include "tests/measured/made_files.h"
#include "tests/reflectance/chi_square.h"

namespace nacre {
namespace {

using test::MadeKlems;
using test::value_at;

/// Numbers first, first + 1, ... of a square matrix of 5 patches.
std::string five_by_five(int first) {
    std::string text;
    for (int i = 0; i < 25; ++i) text += fmt::format("{}{}", first + i, i % 5 == 4 ? "\n" : ", ");
    return text;
}

}  // namespace

/// Patch 0 about the normal, 1 to 4 at phi = 0, 90, 180, 270 degrees; light's azimuth is turned.
TEST(Klems, PatchesOfLightAndExit) {
    MadeKlems file;
    file.blocks = {{"Reflection Front", five_by_five(0)},
                   {"Reflection Back", five_by_five(100)},
                   {"Transmission Front", five_by_five(200)},
                   {"Transmission Back", five_by_five(300)}};
    for (const bool rows : {false, true}) {
        file.structure = rows ? "Rows" : "Columns";
        const auto m = test::parsed(file.text());
        EXPECT_EQ(m->info().format, "klems");
        EXPECT_EQ(m->info().description, "blind");
        EXPECT_FALSE(m->info().isotropic);
        EXPECT_EQ(m->info().samples, 100u);
        for (int in = 0; in < 5; ++in)
            for (int out = 0; out < 5; ++out) {
                const int k = rows ? in * 5 + out : out * 5 + in;
                const auto at = [](int patch) {
                    // Near the edges of patches, which reach 45 degrees to both sides.
                    return patch ? test::towards(50., 90. * (patch - 1) + (patch % 2 ? 43. : -43.))
                                 : test::towards(10., 77.);
                };
                const Vec3d i = at(in), o = at(out);
                const Vec3d light{-i.x, -i.y, i.z}, light_back{-i.x, -i.y, -i.z};
                const Vec3d back{o.x, o.y, -o.z};
                EXPECT_EQ(value_at(*m, light, o)[0], k);
                EXPECT_EQ(value_at(*m, light_back, back)[0], 100 + k);
                EXPECT_EQ(value_at(*m, light, back)[0], 200 + k);
                EXPECT_EQ(value_at(*m, light_back, o)[0], 300 + k);
            }
        // So what goes straight through and what is mirrored are the diagonal.
        const Vec3d w = test::towards(60., 130.);
        EXPECT_EQ(int(value_at(*m, w, -w)[0] - 200.) % 6, 0);
        EXPECT_EQ(int(value_at(*m, w, {-w.x, -w.y, w.z})[0]) % 6, 0);
    }
}

TEST(Klems, WhatIsNotInTheFileIsNotKnown) {
    MadeKlems file;
    file.blocks = {{"Transmission Back", five_by_five(1)}};
    const auto m = test::parsed(file.text());
    const Vec3d w = test::towards(20., 0.);
    EXPECT_TRUE(m->info().transmission_back);
    EXPECT_FALSE(m->info().reflection_front || m->info().reflection_back ||
                 m->info().transmission_front);
    EXPECT_TRUE(value_at(*m, w, w).empty());
    EXPECT_TRUE(value_at(*m, w, -w).empty());
    EXPECT_TRUE(value_at(*m, -w, -w).empty());
    EXPECT_EQ(value_at(*m, -w, w).size(), 1u);
    MadeKlems solar = file;
    solar.part = "Solar";
    EXPECT_EQ(test::parsed(solar.text())->info().notes,
              (std::vector<std::string>{"of the part 'Solar' of the spectrum"}));
}

/// What is drawn for a viewer is all of its light: f cos over the density is the same everywhere, and
/// the sum over the viewer's row of patches.
TEST(Klems, PatchesAreDrawnByTheirLight) {
    MadeKlems file;
    file.blocks = {{"Reflection Front", five_by_five(-3)},
                   {"Transmission Front", five_by_five(7)},
                   {"Transmission Back", five_by_five(1)}};
    const auto data = test::parsed(file.text());
    const auto& klems = dynamic_cast<const KlemsMeasured&>(*data);
    const MeasuredSurface surface(test::parsed(file.text()));
    std::uint64_t seed = 40;
    for (const Vec3d& wo : {test::towards(12., 30.), test::towards(70., 100.),
                            test::towards(50., -170.), -test::towards(60., 10.)}) {
        // Columns are incidences, rows exits.
        double light = 0.;
        for (const auto& [side, first] : {std::pair{KlemsMeasured::reflection_front, -3},
                                          {KlemsMeasured::transmission_back, 1},
                                          {KlemsMeasured::transmission_front, 7}}) {
            if ((side == KlemsMeasured::transmission_front) != (wo.z < 0.)) continue;
            const KlemsBasis& basis = klems.matrix(side).in;
            const int row = basis.patch_of(wo, false);
            for (int i = 0; i < 5; ++i)
                light += std::max(first + 5 * row + i, 0) * basis.projected_solid_angle(i);
        }
        Random random(stream_key(27, ++seed));
        for (int i = 0; i < 200; ++i) {
            const auto wi = surface.sample(Vec3f(wo), random.next(), random.next2());
            ASSERT_TRUE(wi);
            float f_cos;
            surface.eval(*wi, Vec3f(wo), std::span<float>(&f_cos, 1));
            EXPECT_NEAR(f_cos / surface.pdf(*wi, Vec3f(wo)), light, 1e-5 * light);
        }
        const auto result = test::chi_square(
            [&](Random& r) { return surface.sample(Vec3f(wo), r.next(), r.next2()); },
            [&](const Vec3f& wi) { return surface.pdf(wi, Vec3f(wo)); }, seed);
        EXPECT_GT(result.p, 0.01 / 4.) << result.drawn << " " << result.integral;
        EXPECT_NEAR(result.integral, 1., 1e-2);
    }
    // Nothing is known of light that is reflected at the back: none comes, and none is drawn.
    EXPECT_EQ(surface.pdf(Vec3f{0.f, 0.6f, -0.8f}, Vec3f{0.f, 0.f, -1.f}), 0.f);
    file.blocks = {{"Reflection Front", five_by_five(-30)}};
    const MeasuredSurface dark(test::parsed(file.text()));
    EXPECT_FALSE(dark.sample(Vec3f{0.f, 0.f, 1.f}, 0.5f, {0.5f, 0.5f}));
    EXPECT_EQ(dark.pdf(Vec3f{0.f, 0.6f, 0.8f}, Vec3f{0.f, 0.f, 1.f}), 0.f);
}

/// The three standard bases, named without being defined: 145, 73 and 41 patches that share the
/// hemisphere, so that a BSDF of 1/pi everywhere sends out all light.
TEST(Klems, StandardBasesShareTheHemisphere) {
    for (const auto& [name, size] :
         {std::pair{"LBNL/Klems Full", 145}, {"LBNL/Klems Half", 73}, {"LBNL/Klems Quarter", 41}}) {
        MadeKlems file;
        file.basis_name.clear();
        file.column_basis = file.row_basis = name;
        std::string numbers;
        for (int i = 0; i < size * size; ++i) numbers += fmt::format("{} ", i % size);
        file.blocks = {{"Reflection Front", numbers}};
        const auto m = test::parsed(file.text());
        const KlemsBasis& basis =
            dynamic_cast<const KlemsMeasured&>(*m).matrix(KlemsMeasured::reflection_front).in;
        ASSERT_EQ(basis.size(), size);
        double sum = 0.;
        for (int p = 0; p < size; ++p) {
            sum += basis.projected_solid_angle(p);
            const auto centre = basis.centre(p);
            EXPECT_EQ(basis.patch(centre.theta, centre.phi), p);
        }
        EXPECT_NEAR(sum, std::numbers::pi, 1e-12);
        // A patch has the share of cosine-weighted directions that its solid angle says.
        Random random(stream_key(27, 10));
        std::vector<double> hits(size);
        constexpr int count = 200000;
        for (int i = 0; i < count; ++i)
            hits[basis.patch(std::asin(std::sqrt(random.next())),
                             2. * std::numbers::pi * random.next())] += 1.;
        for (int p = 0; p < size; ++p) {
            const double want = count * basis.projected_solid_angle(p) / std::numbers::pi;
            EXPECT_NEAR(hits[p], want, 5. * std::sqrt(want));
        }
    }
}

}  // namespace nacre
