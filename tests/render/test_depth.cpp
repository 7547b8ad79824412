// max_depth, hide_emitters and Russian roulette.
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

class PathDepth : public RenderTest {
  protected:
    static std::string depth(int n) { return xml::integer("max_depth", n); }
    static double fresnel_normal(double n) { return (n - 1) * (n - 1) / ((n + 1) * (n + 1)); }
};

// Inside a sphere that shines with radiance 1 and reflects one half, every bounce adds half of the
// one before, whatever the direction.
TEST_F(PathDepth, AddsOneBounceOfAClosedSphere) {
    for (const std::string type : {"path", "volpath"})
        for (const int n : {0, 1, 2, 3, 6, -1}) {
            const Scene s =
                scene(xml::integrator(type, depth(n)) +
                      xml::sphere({}, 1,
                                  xml::flag("flip_normals", true) + xml::area_light({1, 1, 1}) +
                                      xml::bsdf("diffuse", xml::number("reflectance", 0.5))));
            double truth = 0;
            for (int i = 0; i < (n < 0 ? 60 : n); ++i) truth += std::pow(0.5, i);
            expect_radiance(estimate(s, fixed_ray({0.3f, 0.2f, 0}, {0.2f, 0.5f, 1})),
                            Vec3d(truth, truth, truth), 3e-3, fmt::format("{}, {}", type, n));
        }
}

// Straight through the middle of a glass ball: one surface reflects R, two let (1 - R)^2 pass, and
// each further reflection inside adds its share.
TEST_F(PathDepth, CountsReflectionsInAGlassBall) {
    const double r = fresnel_normal(1.5), t = 1 - r;
    const double shares[] = {0, 0, r, t * t, t * t * r, t * t * r * r};
    for (const std::string type : {"ray", "path", "volpath"})
        for (int n = 0; n < 6; ++n) {
            const Scene s = scene(xml::integrator(type, depth(n)) + xml::constant_light() +
                                  xml::sphere({}, 1, xml::dielectric(1.5)));
            double truth = 0;
            for (int i = 0; i <= n; ++i) truth += shares[i];
            expect_radiance(estimate(s, fixed_ray({0, 0, 3}, {0, 0, -1})),
                            Vec3d(truth, truth, truth), 3e-3, fmt::format("{}, {}", type, n));
        }
}

// Boundaries between media are not there for the count; collisions are. Depth 1 is what passes
// without a collision, depth 2 adds single scattering, for which the ball's centre line has a
// closed form only in the first: light that comes from everywhere and is not absorbed.
TEST_F(PathDepth, CountsCollisionsButNoBoundaries) {
    const double sigma = 0.7;
    for (const int n : {0, 1, -1}) {
        const Scene s = scene(
            xml::integrator("volpath", depth(n)) + xml::constant_light() +
            xml::sphere({}, 1,
                        xml::bsdf("null") + xml::medium("interior", xml::number("sigma_t", sigma) +
                                                                        xml::number("albedo", 1))));
        const double truth = n == 0 ? 0 : n == 1 ? std::exp(-2 * sigma) : 1;
        expect_radiance(estimate(s, fixed_ray({0, 0, 3}, {0, 0, -1}), {.pixels = 4000}),
                        Vec3d(truth, truth, truth), 4e-3, fmt::format("depth {}", n));
    }
}

// Nor are surfaces that light passes as if they were not there.
TEST_F(PathDepth, CountsNoNullSurfaces) {
    for (const std::string type : {"path", "volpath"})
        for (const auto& [n, truth] : {std::pair{1, 0.}, {2, 1.}, {-1, 1.}}) {
            const Scene s =
                scene(xml::integrator(type, depth(n)) + xml::constant_light() +
                      xml::sphere({}, 2, xml::bsdf("null")) +
                      xml::sphere({}, 1, xml::bsdf("diffuse", xml::number("reflectance", 1))));
            expect_radiance(estimate(s, ray_bundle({0, 0, 3}, {0, 0, -1}, 0.9f)),
                            Vec3d(truth, truth, truth), 5e-3, fmt::format("{}, {}", type, n));
        }
}

// With the accelerations or without, a limit of depth cuts the same paths. Light that is scattered
// in glass takes four segments from the lamp to the camera.
TEST_F(PathDepth, CutsGuidedExitsLikeOthers) {
    for (const int n : {3, 5, 8}) {
        const auto make = [&](bool guided) {
            return scene(xml::integrator("volpath", depth(n) + xml::flag("guided_exits", guided)) +
                         xml::sphere({11, 0, 9}, 5, xml::area_light({5, 5, 5})) +
                         xml::sphere({}, 4,
                                     xml::dielectric(1.4) +
                                         xml::medium("interior", xml::number("sigma_t", 4) +
                                                                     xml::number("albedo", 0.9))));
        };
        // Off the light's mirror image.
        const RayMaker rays = ray_bundle({0, -2, 4.2f}, {0, 0, -1}, 0.2f);
        const auto with = estimate(make(true), rays, {.pixels = 4000, .seed = 1});
        const auto without = estimate(make(false), rays, {.pixels = 8000, .seed = 2});
        if (n == 3) {
            EXPECT_EQ(with.mean, Vec3d(0, 0, 0));
        }
        expect_agreement(with, without, sidak_deviations(9), fmt::format("depth {}", n));
        for (int c = 0; c < 3; ++c) EXPECT_LE(without.error[c], 0.05 * without.mean[c]);
    }
}

TEST_F(PathDepth, HidesLightsFromTheCameraOnly) {
    for (const std::string type : {"ray", "path", "volpath"})
        for (const bool hidden : {false, true}) {
            const std::string integrator =
                xml::integrator(type, xml::flag("hide_emitters", hidden));
            const std::string body =
                xml::sphere({}, 1, xml::bsdf("diffuse", xml::number("reflectance", 1)));
            const Scene sky = scene(integrator + xml::constant_light() + body);
            const double seen = hidden ? 0 : 1;
            expect_radiance(estimate(sky, fixed_ray({0, 3, 3}, {0, 0, -1})),
                            Vec3d(seen, seen, seen), 1e-9, type + ", sky");
            const auto lit = estimate(sky, fixed_ray({0, 0.2f, 3}, {0, 0, -1}), {.pixels = 8000});
            expect_radiance(lit, {1, 1, 1}, 5e-3, type + ", lit by the sky");

            const Scene lamp =
                scene(integrator + body + xml::sphere({0, 3, 0}, 0.5, xml::area_light({1, 1, 1})));
            expect_radiance(estimate(lamp, fixed_ray({0, 3, 3}, {0, 0, -1})),
                            Vec3d(seen, seen, seen), 1e-9, type + ", lamp");
            // A sphere of radius r at distance d above a surface gives E = pi L (r/d)^2.
            const auto top = estimate(lamp, fixed_ray({0, 1.01f, 0}, {0, -1, 0}), {.pixels = 4000});
            const double e = 0.25 / 4;
            expect_radiance(top, Vec3d(e, e, e), 1e-3, type + ", lit by the lamp");
        }
}

TEST_F(PathDepth, RouletteLeavesTheMean) {
    const std::string body =
        xml::sphere({}, 1,
                    xml::dielectric(1.4) +
                        xml::medium("interior", xml::rgb("sigma_t", {3, 6, 12}) +
                                                    xml::rgb("albedo", {0.95, 0.8, 0.5}))) +
        xml::shape("rectangle",
                   "<transform name=\"to_world\"><scale value=\"4\"/>"
                   "<rotate x=\"1\" angle=\"-90\"/><translate y=\"-1.2\"/></transform>" +
                       xml::bsdf("diffuse", xml::number("reflectance", 0.8)));
    const RayMaker rays = ray_bundle({0, 1, 4}, {0, -0.25f, -1}, 1.2f);
    for (const std::string type : {"path", "volpath"}) {
        std::vector<RadianceEstimate> e;
        for (const int from : {1, 5, 1000})
            e.push_back(estimate(scene(xml::integrator(type, xml::integer("rr_depth", from)) +
                                       xml::constant_light() + body),
                                 rays, {.pixels = 6000, .seed = std::uint64_t(from)}));
        expect_agreement(e[0], e[2], sidak_deviations(12), type + ", from 1 and never");
        expect_agreement(e[1], e[2], sidak_deviations(12), type + ", from 5 and never");
        for (int c = 0; c < 3; ++c) EXPECT_LT(e[0].error[c], 0.01 * e[0].mean[c]) << type;
    }
}

}  // namespace
}  // namespace nacre
