// Diffusion solved on a grid, as a technique: what comes out of balls and sheets against closed
// forms and complete simulation, and what it refuses.
#include "nacre/geometry/mesh_io.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/subsurface/diffusion_grid.h"
#include "tests/diffusion/solids.h"
#include "tests/support/constants.h"
#include "tests/support/error_of.h"
#include "tests/techniques/technique_fixture.h"

namespace nacre {
namespace {

class DiffusionGridTechnique : public Techniques {
  protected:
    static std::string ball(double radius, double sigma_s, double sigma_a,
                            const std::string& around = xml::constant_light(1.), double n = 1.) {
        return xml::integrator("path") + around +
               xml::sphere({0, 0, 0}, radius,
                           (n == 1. ? "<bsdf type=\"null\"/>" : xml::dielectric(n)) +
                               xml::medium("interior", xml::number("sigma_s", sigma_s) +
                                                           xml::number("sigma_a", sigma_a)));
    }
    static TechniqueChoice grid(std::vector<std::pair<std::string, std::string>> options = {}) {
        return {"diffusion_grid", std::move(options)};
    }
    /// Straight down onto the middle of a thing at the origin.
    static RayMaker down() {
        return [](Vec2f u) {
            const Point3f p{0.4f * (u.x - 0.5f), 0.4f * (u.y - 0.5f), 50.f};
            return Ray{p, {0.f, 0.f, -1.f}};
        };
    }
    static double statistic(const Technique& t, std::string_view name) {
        for (const Statistic& s : t.statistics())
            if (s.name == name) return s.value;
        return nan;
    }
};

// Nothing is lost in white matter: in even light it is as bright as what is around, whichever way
// light enters.
TEST_F(DiffusionGridTechnique, WhiteMatterInEvenLightCannotBeSeen) {
    for (const char* source : {"volume", "surface"}) {
        Scene s = scene(ball(1., 8., 0.));
        const RadianceEstimate e = look(s, grid({{"cells", "40"}, {"source", source}}), down(),
                                        {.pixels = 16, .samples = 64});
        EXPECT_NEAR(e.mean.x, 1., 0.03) << source;
    }
}

// A ball in even light, entered at its surface: phi = C sinh(kappa r) / r with q = 4 Gamma, and
// (phi / 2 - Gamma) / A leaves. Radiance 1 brings Gamma = pi.
TEST_F(DiffusionGridTechnique, AnEvenlyLitBallIsTheClosedForm) {
    const double R = 1., sigma_s = 8., sigma_a = 0.4, D = 1. / (3. * (sigma_s + sigma_a)),
                 k = std::sqrt(sigma_a / D);
    const double value = std::sinh(k * R) / R,
                 slope = (k * R * std::cosh(k * R) - std::sinh(k * R)) / (R * R);
    const double phi = 4. * pi * value / (value + 2. * D * slope);
    Scene s = scene(ball(R, sigma_s, sigma_a));
    const RadianceEstimate e = look(s, grid({{"cells", "64"}, {"source", "surface"}}), down(),
                                    {.pixels = 16, .samples = 64});
    EXPECT_NEAR(e.mean.x, (phi / 2. - pi) / pi, 0.01);
}

// A dense ball under a lamp is what complete simulation says, where two passes, which know flat
// half spaces only, lack a fourth.
TEST_F(DiffusionGridTechnique, ABallOfAFewFreePathsIsNearTheSimulation) {
    const std::string lamp =
        "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"0.6\" "
        "z=\"-0.8\"/></emitter>";
    const RayMaker whole = [](Vec2f u) {
        return Ray{{2.f * u.x - 1.f, 2.f * u.y - 1.f, 50.f}, {0.f, 0.f, -1.f}};
    };
    Scene s = scene(ball(1., 4., 0.04, lamp, 1.3));
    const EstimateOptions options{.pixels = 32, .samples = 512};
    const double truth = look(s, {"volpath"}, whole, options).mean.x;
    EXPECT_NEAR(look(s, grid(), whole, options).mean.x / truth, 1., 0.06);
    EXPECT_LT(look(s, {"two_pass"}, whole, options).mean.x / truth, 0.9);
}

// Of the light that enters, the share that leaves without having been scattered is the straight
// way's; along a diameter only if it comes from there.
TEST_F(DiffusionGridTechnique, LightIsScatteredAlongItsWay) {
    // A pencil through the middle of a thin sheet: exp(-sigma_t' d).
    Scene s = scene(xml::integrator("path") +
                    "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"0\" "
                    "z=\"-1\"/></emitter>" +
                    xml::shape("cube",
                               "<transform name=\"to_world\"><scale x=\"2\" y=\"2\" "
                               "z=\"0.25\"/></transform><bsdf type=\"null\"/>" +
                                   xml::medium("interior", xml::number("sigma_s", 3) +
                                                               xml::number("sigma_a", 1))));
    const TechniquePtr t = prepare(s, plan_of(s, grid({{"cells", "40"}, {"source", "volume"}})));
    EXPECT_NEAR(statistic(*t, "unscattered"), 100. * std::exp(-4. * 0.5), 0.3);
}

TEST_F(DiffusionGridTechnique, AChangeOfLightMayGoOnFromTheLastField) {
    const auto lamp = [](double x) {
        return "<emitter type=\"directional\"><vector name=\"direction\" x=\"" + std::to_string(x) +
               "\" y=\"0\" z=\"-1\"/></emitter>";
    };
    Scene s = scene(ball(1., 8., 0.04, lamp(0.)));
    const TechniqueChoice choice =
        grid({{"start", "last"}, {"cells", "48"}, {"tolerance", "1e-8"}});
    const TechniquePtr kept = prepare(s, plan_of(s, choice));
    const double fresh = statistic(*kept, "cycles");
    Scene other = scene(ball(1., 8., 0.04, lamp(0.001)));
    s.lights = std::move(other.lights);
    kept->changed({.light = true});
    EXPECT_LT(statistic(*kept, "cycles"), fresh);
    const EstimateOptions options{.pixels = 8, .samples = 4};
    const RadianceEstimate a = estimate(*kept, down(), options),
                           b = estimate(*prepare(s, plan_of(s, choice)), down(), options);
    EXPECT_NEAR(a.mean.x / b.mean.x, 1., 1e-5);
}

// A volume whose density is the same everywhere is the homogeneous medium; others do not take it.
TEST_F(DiffusionGridTechnique, AnEvenVolumeIsTheHomogeneousMedium) {
    const auto with = [&](const std::string& medium) {
        return xml::integrator("path") + xml::constant_light(1.) +
               xml::sphere({0, 0, 0}, 1., xml::dielectric(1.3) + medium);
    };
    write_vol("even.vol", 2, 1, [](int, int, int, int) { return 1; });
    const auto uneven_medium = [](const std::string& file) {
        return "<medium name=\"interior\" type=\"heterogeneous\"><volume name=\"sigma_t\" "
               "type=\"gridvolume\"><string name=\"filename\" value=\"" +
               file +
               "\"/><transform name=\"to_world\"><scale value=\"4\"/><translate x=\"-2\" y=\"-2\" "
               "z=\"-2\"/></transform></volume>" +
               xml::number("albedo", 0.9) + xml::number("scale", 8) + "</medium>";
    };
    Scene even = scene(
        with(xml::medium("interior", xml::number("sigma_t", 8) + xml::number("albedo", 0.9))));
    Scene uneven = scene(with(uneven_medium("even.vol")));
    ASSERT_FALSE(uneven.media[0]->homogeneous());
    const EstimateOptions options{.pixels = 8, .samples = 8};
    const RadianceEstimate a = look(even, grid({{"cells", "32"}}), down(), options),
                           b = look(uneven, grid({{"cells", "32"}}), down(), options);
    EXPECT_NEAR(a.mean.x / b.mean.x, 1., 1e-5);
    EXPECT_EQ(error_of([&] { plan_of(uneven, {"two_pass"}); }),
              "technique 'two_pass' has nothing to do: no shape has a homogeneous medium inside "
              "behind a dielectric boundary, smooth or equally rough everywhere, without "
              "dispersion or tint");
}

// Matter of one to ten in layers, which no profile knows: near the simulation, behind as in front.
TEST_F(DiffusionGridTechnique, AJumpOfDensityIsNearTheSimulation) {
    write_vol("layers.vol", 16, 1, [](int, int, int z, int) { return z / 2 % 2 ? 1. : 0.1; });
    const std::string medium =
        "<medium name=\"interior\" type=\"heterogeneous\"><volume name=\"sigma_t\" "
        "type=\"gridvolume\"><string name=\"filename\" value=\"layers.vol\"/><transform "
        "name=\"to_world\"><scale value=\"2.2\"/><translate x=\"-1.1\" y=\"-1.1\" "
        "z=\"-1.1\"/></transform></volume>" +
        xml::number("albedo", 0.99) + xml::number("scale", 20) + "</medium>";
    Scene s = scene(xml::integrator("path") +
                    "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"0.6\" "
                    "z=\"-0.8\"/></emitter>" +
                    xml::sphere({0, 0, 0}, 1., xml::dielectric(1.3) + medium));
    const RayMaker whole = [](Vec2f u) {
        return Ray{{2.f * u.x - 1.f, 2.f * u.y - 1.f, 50.f}, {0.f, 0.f, -1.f}};
    };
    const RayMaker behind = [](Vec2f u) {
        return Ray{{2.f * u.x - 1.f, 2.f * u.y - 1.f, -50.f}, {0.f, 0.f, 1.f}};
    };
    // Thin layers are half a mean free path: some light crosses them and does not diffuse, which
    // shows behind, where a fifteenth of the light is.
    const EstimateOptions options{.pixels = 16, .samples = 64};
    const auto ratio = [&](const RayMaker& rays) {
        return look(s, grid({{"cells", "48"}}), rays, options).mean.x /
               look(s, {"volpath"}, rays, options).mean.x;
    };
    EXPECT_NEAR(ratio(whole), 1., 0.06);
    EXPECT_NEAR(ratio(behind), 1., 0.25);
}

TEST_F(DiffusionGridTechnique, WhatCannotBeSolvedIsRefused) {
    const auto refusal = [&](const std::string& body, const TechniqueChoice& choice) {
        return error_of([&] {
            Scene s = scene(body);
            prepare(s, plan_of(s, choice));
        });
    };
    EXPECT_EQ(refusal(ball(1., 0., 0.), grid()),
              "translucent medium: sigma_s + sigma_a = 0 must be positive");
    const std::string open =
        xml::integrator("path") + xml::constant_light(1.) +
        xml::shape("cylinder", "<bsdf type=\"null\"/>" +
                                   xml::medium("interior", xml::number("sigma_s", 1) +
                                                               xml::number("sigma_a", 1)));
    EXPECT_TRUE(refusal(open, grid()).find("has no closed interior: ") != std::string::npos)
        << refusal(open, grid());
    const std::string huge = refusal(ball(1., 8., 0.), grid({{"cells", "4096"}}));
    EXPECT_TRUE(huge.starts_with(
        "cells = 4096 takes a grid of 3.6e+10 cells and 2.29e+04 GB, and there are "))
        << huge;
    EXPECT_NE(huge.find(" GB: set cells to "), std::string::npos) << huge;
    EXPECT_TRUE(refusal(ball(1., 8., 0.), grid({{"cells", "-1"}})).find("cells") !=
                std::string::npos);
}

TEST(DiffusionGridCells, FollowTheFreePathWithinReason) {
    const Mesh ball = test::ball_mesh(1., 1e-3);
    EXPECT_EQ(automatic_cells(ball, 0.1), 40);
    EXPECT_EQ(automatic_cells(ball, 10.), 24);
    // Two million cells: 4/3 pi (n / 2)^3.
    EXPECT_NEAR(automatic_cells(ball, 1e-4), 155., 6.);
}

}  // namespace
}  // namespace nacre
