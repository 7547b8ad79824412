// Points and directions of light that shine into refracting matter, rendered: flat layers against
// adding-doubling and a published half space, a ball under a point against small area lights.
#include "nacre/layers/adding_doubling.h"
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

class DeltaLightTest : public RenderTest {
  protected:
    static std::string sun(double cosine) {
        return fmt::format(
            "<emitter type=\"directional\"><vector name=\"direction\" x=\"{}\" y=\"{}\" "
            "z=\"0\"/><float name=\"irradiance\" value=\"1\"/></emitter>",
            std::sqrt(1 - cosine * cosine), -cosine);
    }
    /// 400 free paths wide; the upper face is y = 0. `as_grid`: its extinction, 1, is that of a
    /// grid.
    Scene slab(const std::string& light, double eta, double tau, double albedo,
               bool as_grid = false) {
        const auto placed = [](double half, double height) {
            return fmt::format(
                "<transform name=\"to_world\"><scale x=\"{0}\" y=\"{1}\" z=\"{0}\"/>", half,
                height);
        };
        std::string medium =
            xml::medium("interior", xml::number("sigma_t", 1) + xml::number("albedo", albedo));
        if (as_grid) {
            write_vol("one.vol", 2, 1, [](int, int, int, int) { return 1; });
            medium =
                "<medium name=\"interior\" type=\"heterogeneous\"><volume name=\"sigma_t\" "
                "type=\"gridvolume\"><string name=\"filename\" value=\"one.vol\"/>" +
                placed(400, tau) +
                fmt::format("<translate x=\"-200\" y=\"-{}\" z=\"-200\"/></transform></volume>",
                            tau) +
                xml::number("albedo", albedo) + "</medium>";
        }
        return scene(
            xml::integrator("volpath") + light +
            xml::shape("cube", placed(200, tau / 2) +
                                   fmt::format("<translate y=\"-{}\"/></transform>", tau / 2) +
                                   xml::dielectric(eta) + medium));
    }
    struct Layer {
        double eta, tau, albedo, cosine;
        bool as_grid = false;
    };
    /// Radiance seen from above and from below, at two angles, across the plane of incidence, where
    /// the lamp's mirror image is not.
    void check(const Layer& layer, int pixels, std::uint64_t seed) {
        const LayerStack stack{{{.sigma_s = layer.albedo,
                                 .sigma_a = 1 - layer.albedo,
                                 .thickness = layer.tau,
                                 .eta = layer.eta}}};
        const double outgoing[] = {0.5, 0.9};
        const AddingDoublingResult expected =
            adding_doubling(stack, {&layer.cosine, 1}, outgoing, {.accuracy = 1e-6});
        const Scene s = slab(sun(layer.cosine), layer.eta, layer.tau, layer.albedo, layer.as_grid);
        for (std::size_t o = 0; o < 2; ++o)
            for (const bool back : {true, false}) {
                const double truth = (back ? expected.brdf : expected.btdf)[o] * layer.cosine;
                if (truth < 1e-3) continue;
                const double mu = outgoing[o], sine = std::sqrt(1 - mu * mu);
                const Vec3f d{0, float(back ? -mu : mu), float(sine)};
                const Point3f at{0, back ? 0.f : float(-layer.tau), 0};
                const RadianceEstimate e =
                    estimate(s, fixed_ray(at - d * 5.f, d),
                             {.sampler = "sobol", .pixels = pixels, .samples = 64, .seed = seed});
                expect_radiance(
                    e, Vec3d{truth, truth, truth}, 0.5 / std::sqrt(pixels) * truth,
                    fmt::format("eta {} tau {} albedo {} from {} to {}{}", layer.eta, layer.tau,
                                layer.albedo, layer.cosine, mu, back ? "" : ", below"),
                    sidak_deviations(40));
            }
    }
    static std::vector<Layer> layers() {
        // The last is thin: of what it scatters, several percent were reflected inside before.
        return {{1.5, 30, 0.9, 1}, {1.5, 1, 0.5, 0.8}, {1.33, 2, 0.9, 0.4}, {1.7, 0.2, 0.9, 0.6}};
    }
};

TEST_F(DeltaLightTest, LayersAgreeWithAddingDoubling) {
    std::uint64_t seed = 21;
    for (const Layer& layer : layers()) check(layer, layer.tau < 1 ? 1500 : 400, seed++);
}

// In heterogeneous media, too, light is scattered that was reflected inside before.
TEST_F(DeltaLightTest, GridsAgreeWithAddingDoubling) {
    check({1.5, 1, 0.5, 0.8, true}, 400, 41);
    check({1.7, 0.2, 0.9, 0.6, true}, 1500, 42);
}

using LongDeltaLightTest = DeltaLightTest;
TEST_F(LongDeltaLightTest, LayersAgreeWithAddingDoubling) {
    std::uint64_t seed = 31;
    for (const Layer& layer : layers()) check(layer, 8000, seed++);
}

// R. G. Giovanelli 1955, Reflection by Semi-infinite Diffusers, Optica Acta 2: half space of index
// 1.5 and albedo 0.9, light from above. Of the 0.2600 that come back, 0.0400 are mirrored.
TEST_F(DeltaLightTest, AgreesWithGiovanelli) {
    const Scene s = slab(sun(1), 1.5, 40, 0.9);
    const RayMaker cosine_weighted = [](Vec2f u) {
        const float r = std::sqrt(u.x), phi = static_cast<float>(2 * pi) * u.y;
        const Vec3f d{r * std::cos(phi), -std::sqrt(1 - u.x), r * std::sin(phi)};
        return Ray{Point3f(0, 0, 0) - d, d};
    };
    const RadianceEstimate e =
        estimate(s, cosine_weighted, {.sampler = "sobol", .pixels = 500, .samples = 64, .seed = 2});
    EXPECT_NEAR(e.mean.x * pi, 0.2200, 3 * std::hypot(e.error.x * pi, 5e-5));
    EXPECT_LT(e.error.x * pi, 2e-3);
}

// A point has no mirror image in the ball; these rays do not meet that of the lamps either.
TEST_F(DeltaLightTest, PointIsTheLimitOfSmallBalls) {
    const auto lit = [&](const std::string& lamp) {
        return scene(xml::integrator("volpath") + lamp +
                     xml::sphere({}, 1,
                                 xml::dielectric(1.5) +
                                     xml::medium("interior", xml::number("sigma_t", 8) +
                                                                 xml::number("albedo", 0.9))));
    };
    const auto ball = [&](double radius) {
        const double radiance = 100 / (pi * radius * radius);
        return xml::sphere({3, 3, 0}, radius, xml::area_light({radiance, radiance, radiance}));
    };
    const RayMaker rays = ray_bundle({1, 1, 5}, {-0.1f, -0.15f, -1}, 0.2f);
    const EstimateOptions options{.sampler = "sobol", .pixels = 1300, .samples = 64, .seed = 4};
    const RadianceEstimate point =
        estimate(lit("<emitter type=\"point\"><point name=\"position\" x=\"3\" y=\"3\" z=\"0\"/>"
                     "<float name=\"intensity\" value=\"100\"/></emitter>"),
                 rays, options);
    // What the lamp's size changes falls with its square: extrapolated from two.
    const RadianceEstimate small = estimate(lit(ball(0.25)), rays, options);
    const RadianceEstimate large = estimate(lit(ball(0.5)), rays, options);
    const double limit = (4 * small.mean.x - large.mean.x) / 3;
    const double error = std::hypot(point.error.x, 4 * small.error.x / 3, large.error.x / 3);
    EXPECT_NEAR(point.mean.x, limit, 3.5 * error);
    EXPECT_LT(error, 0.05 * limit);
}

// Where light comes over several boundaries: a ball in a ball, and haze behind a ball. Boundaries of
// nearly the same index on both sides stop all straight connections, and change nothing else.
TEST_F(DeltaLightTest, BoundariesOfNoIndexChangeNothing) {
    const auto medium = [](const std::string& id, double sigma_t) {
        return "<medium type=\"homogeneous\" id=\"" + id + "\">" + xml::number("sigma_t", sigma_t) +
               xml::number("albedo", 0.8) + "</medium>";
    };
    const auto ref = [](const std::string& side, const std::string& id) {
        return "<ref name=\"" + side + "\" id=\"" + id + "\"/>";
    };
    const std::string no_index = xml::dielectric(1.0001);
    struct Case {
        std::string name, objects, inserted;
        RayMaker rays;
    };
    const std::vector<Case> cases{
        {"ball in a ball",
         medium("outer", 1.5) + xml::sphere({}, 1, xml::dielectric(1.3) + ref("interior", "outer")),
         xml::sphere({0.1, 0.2, 0.3}, 0.6,
                     no_index + ref("interior", "outer") + ref("exterior", "outer")),
         ray_bundle({0.2f, 0.2f, 5}, {0, 0, -1}, 0.3f)},
        {"haze behind a ball",
         medium("haze", 0.2) +
             xml::shape(
                 "cube",
                 "<transform name=\"to_world\"><scale x=\"6\" y=\"6\" z=\"2\"/></transform>" +
                     xml::bsdf("null") + ref("interior", "haze")),
         xml::sphere({}, 1, no_index + ref("interior", "haze") + ref("exterior", "haze")),
         ray_bundle({-1.1f, -1.1f, 5}, {0, 0, -1}, 0.3f)}};
    for (const Case& k : cases) {
        const auto light = [&](const std::string& inserted) {
            return estimate(
                scene(xml::integrator("volpath") +
                      "<emitter type=\"point\"><point name=\"position\" x=\"3\" y=\"3\" z=\"0\"/>"
                      "<float name=\"intensity\" value=\"100\"/></emitter>" +
                      k.objects + inserted),
                k.rays, {.sampler = "sobol", .pixels = 300, .samples = 64, .seed = 5});
        };
        const RadianceEstimate without = light(""), with = light(k.inserted);
        EXPECT_NEAR(with.mean.x, without.mean.x, 3.5 * std::hypot(with.error.x, without.error.x))
            << k.name;
        EXPECT_LT(with.error.x, 0.05 * without.mean.x) << k.name;
    }
}

}  // namespace
}  // namespace nacre
