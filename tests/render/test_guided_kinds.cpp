// Guided exits where shapes, lights and media are of several kinds: objects that share a medium with
// others, lamps within and beside, boundaries of varying roughness, heterogeneous media, shapes in
// shapes. On or off, the picture is the same, each part of it.
#include "nacre/render/volume_path_tracer.h"
#include "tests/render/render_fixture.h"

namespace nacre::guided_kinds {
namespace {

const std::string isotropic = xml::phase("isotropic");
const std::string smooth = xml::dielectric(1.4), rough = xml::rough_dielectric(1.4, 0.2),
                  null = xml::bsdf("null");
const std::string checkered = xml::bsdf(
    "roughdielectric",
    "<texture type=\"checkerboard\" name=\"alpha\"><float name=\"color0\" value=\"0.15\"/><float "
    "name=\"color1\" value=\"0.4\"/><transform name=\"to_uv\"><scale x=\"6\" y=\"6\"/></transform>"
    "</texture>" +
        xml::rgb("specular_transmittance", {0.9, 1, 0.8}) + xml::number("int_ior", 1.4) +
        xml::number("ext_ior", 1));

std::string matter(double scale = 1) {
    return xml::rgb("sigma_t", Vec3d{1, 1.6, 2.5} * scale) + xml::rgb("albedo", {0.99, 0.95, 0.8}) +
           isotropic;
}

/// A medium with the name "matter" for <ref>s, and such a ref.
std::string shared(double scale = 1) {
    return "<medium type=\"homogeneous\" id=\"matter\">" + matter(scale) + "</medium>";
}
std::string ref(const std::string& side, const std::string& id = "matter") {
    return "<ref name=\"" + side + "\" id=\"" + id + "\"/>";
}

std::string lamp(const Vec3d& at, double radius, double radiance = 10) {
    return xml::sphere(at, radius, xml::area_light({radiance, radiance, radiance}));
}

class GuidedKinds : public RenderTest {
  protected:
    /// Blobs within the cube from -1 to 1, times `scale`.
    std::string cloud(double scale) const {
        write_vol("cloud.vol", 8, 1,
                  [](int x, int y, int z, int) { return (x / 2 + y / 2 + z / 2) % 2 ? 0.15 : 1.; });
        return "<medium name=\"interior\" type=\"heterogeneous\"><volume type=\"gridvolume\" "
               "name=\"sigma_t\"><string name=\"filename\" value=\"cloud.vol\"/><transform "
               "name=\"to_world\"><scale value=\"2\"/><translate x=\"-1\" y=\"-1\" z=\"-1\"/>"
               "</transform></volume>" +
               xml::rgb("albedo", {0.99, 0.9, 0.4}) + xml::number("scale", scale) + isotropic +
               "</medium>";
    }
    /// A box from -1 to 1 whose upper face is a shape of its own.
    std::string box(const std::string& lid, const std::string& rest) const {
        const std::string vertices =
            "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
        std::ofstream(folder_ / "lid.obj") << vertices << "f 4 8 7 3\n";
        std::ofstream(folder_ / "rest.obj") << vertices
                                            << "f 5 6 7 8\nf 2 1 4 3\nf 1 5 8 4\nf 6 2 3 7\n"
                                               "f 1 2 6 5\n";
        const auto file = [](const std::string& name) {
            return "<string name=\"filename\" value=\"" + name + "\"/>";
        };
        return xml::shape("obj", file("lid.obj") + lid) +
               xml::shape("obj", file("rest.obj") + rest);
    }

    struct Kind {
        std::string name, objects;
        std::vector<RayMaker> regions;
    };
    /// All kinds, as they are seen from two places each, lit so that the walk finds the lights, too.
    std::vector<Kind> kinds() const {
        const auto from = [](const Point3f& at, const Vec3f& d) {
            return ray_bundle(at, d, 0.15f);
        };
        const RayMaker lit = from({0.5f, 0.2f, 3}, {0, 0, -1}),
                       back = from({-0.3f, 0, -3}, {0, 0, 1}),
                       top = from({0.3f, 3, 0.3f}, {0, -1, 0});
        const std::string light = lamp({1.5, 1.5, 2.5}, 1.2);
        const std::string inclusion = xml::sphere(
            {0.4, 0.2, 0.3}, 0.4,
            xml::dielectric(1.2) + xml::medium("interior", matter(3)) + ref("exterior"));
        const std::string haze = "<medium type=\"homogeneous\" id=\"haze\">" +
                                 xml::number("sigma_t", 0.3) + xml::number("albedo", 0.5) +
                                 "</medium>" +
                                 xml::sphere({0, 0, 0}, 6, null + ref("interior", "haze"));
        const auto ball = [](const std::string& boundary, double x = 0) {
            return xml::sphere({x, 0, 0}, 1, boundary + ref("interior"));
        };
        const std::string beside = shared() + ball(smooth, 0);
        return {
            {"cloud", xml::sphere({}, 1, smooth + cloud(3)) + light, {lit, back}},
            {"rough cloud", xml::sphere({}, 1, rough + cloud(3)) + light, {lit, back}},
            {"cloud under a window",
             xml::sphere({}, 1, smooth + cloud(3)) + window_sky({60, 50, 40}),
             {lit, back}},
            {"textured and tinted", shared() + ball(checkered) + light, {lit, back}},
            {"inclusion", shared() + ball(smooth) + inclusion + light, {lit, back}},
            {"inclusion, rough", shared() + ball(rough) + inclusion + light, {lit, back}},
            {"in haze",
             haze + shared() +
                 xml::sphere({}, 1, smooth + ref("interior") + ref("exterior", "haze")) + light,
             {lit, back}},
            {"rough, in haze",
             haze + shared() +
                 xml::sphere({}, 1, rough + ref("interior") + ref("exterior", "haze")) + light,
             {lit, back}},
            {"lamps inside and outside",
             shared() + ball(smooth) + lamp({0, -0.3, 0.2}, 0.2, 3) + light,
             {lit, back}},
            {"rough, lamps inside and outside",
             shared() + ball(rough) + lamp({0, -0.3, 0.2}, 0.2, 3) + light,
             {lit, back}},
            {"lamp half inside",
             shared() + ball(smooth) + lamp({0.5, 0.9, 0.3}, 0.4, 3),
             {lit, back}},
            {"lamp in the box",
             shared() + ball(smooth) + lamp({0.8, 0.8, 0.5}, 0.2, 30),
             {lit, back}},
            {"beside others",
             beside + ball(rough, 2.5) + ball(null, -2.5) + lamp({1.25, 0.9, 0.3}, 0.2, 30) + light,
             {lit, from({2.8f, 0, 3}, {0, 0, -1}), from({-2.7f, 0, 3}, {0, 0, -1})}},
            {"rough lid",
             shared() + box(rough + ref("interior"), smooth + ref("interior")) + light,
             {lit, top}},
            {"rough box, smooth lid",
             shared() + box(smooth + ref("interior"), rough + ref("interior")) + light,
             {lit, top}},
        };
    }
    void compare_all(int max_depth, int pixels, int pixels_without) {
        const auto all = kinds();
        std::size_t regions = 0;
        for (const Kind& kind : all) regions += kind.regions.size();
        const double deviations = sidak_deviations(int(3 * regions));
        for (const Kind& kind : all) {
            const auto make = [&](bool guided) {
                return scene(xml::integrator("volpath", xml::integer("max_depth", max_depth) +
                                                            xml::flag("guided_exits", guided)) +
                             kind.objects);
            };
            const Scene with = make(true), without = make(false);
            const auto guided = make_integrator(with), plain = make_integrator(without);
            for (std::size_t r = 0; r < kind.regions.size(); ++r) {
                const auto a =
                    estimate(with, *guided, kind.regions[r], {.pixels = pixels, .seed = 51});
                const auto b = estimate(without, *plain, kind.regions[r],
                                        {.pixels = pixels_without, .seed = 52});
                expect_agreement(a, b, deviations, fmt::format("{}, region {}", kind.name, r));
                EXPECT_GT(a.mean[0], 0) << kind.name << ", region " << r;
            }
        }
    }
    /// Light scattered once under a lamp so large that the walk meets it about as densely as proposals
    /// do (or, inside, as connections do): there a wrong weight makes the most of a difference.
    void compare_under_large_lamps(int pixels, int pixels_without) {
        const std::string large = lamp({3.25, 0, 2.25}, 2.6);
        const std::string haze = "<medium type=\"homogeneous\" id=\"haze\">" +
                                 xml::number("sigma_t", 0.5) + xml::number("albedo", 0.2) +
                                 "</medium>" + xml::sphere({}, 7, null + ref("interior", "haze"));
        struct Case {
            std::string name, objects;
            float x = 0.05f;  // from where the lamp's middle is not far from the horizon
        };
        const std::vector<Case> cases{
            {"cloud", xml::sphere({}, 1, smooth + cloud(10)) + large},
            {"rough cloud", xml::sphere({}, 1, rough + cloud(10)) + large},
            {"haze", haze + shared(4) +
                         xml::sphere({}, 1, smooth + ref("interior") + ref("exterior", "haze")) +
                         large},
            // Another lamp is the one that is chosen more often, of all.
            {"lamp inside",
             shared(2) + xml::sphere({}, 1, smooth + ref("interior")) + lamp({}, 0.6, 1) +
                 lamp({0, 0, -8}, 0.5, 300),
             0.25f}};
        for (const Case& k : cases) {
            const auto light = [&](bool guided, int n) {
                return estimate(
                    scene(xml::integrator("volpath", xml::integer("max_depth", 4) +
                                                         xml::flag("guided_exits", guided)) +
                          k.objects),
                    ray_bundle({k.x, 0, 1.125f}, {0, 0, -1}, 0.05f),
                    {.pixels = n, .seed = guided ? 61u : 62u});
            };
            expect_agreement(light(true, pixels), light(false, pixels_without),
                             sidak_deviations(12), k.name);
        }
    }
    /// Whether proposals are made at the first collisions below a shape.
    static bool is_guided(const Scene& s, std::uint32_t shape) {
        const VolumePathTracer tracer(s);
        return tracer.exit(shape) != VolumePathTracer::Exit::none &&
               std::ranges::any_of(tracer.piece(shape, true).guides, &ExitGuide::active);
    }
    static bool is_connected(const Scene& s, std::uint32_t shape) {
        return VolumePathTracer(s).piece(shape, true).connect;
    }
};

// Light scattered once, so that wrong weights show.
TEST_F(GuidedKinds, LeaveSingleScattering) { compare_all(4, 700, 2800); }

TEST_F(GuidedKinds, LeaveTheMean) { compare_all(-1, 300, 1000); }

using LongGuidedKinds = GuidedKinds;
TEST_F(LongGuidedKinds, LeaveSingleScattering) { compare_all(4, 10000, 50000); }
TEST_F(LongGuidedKinds, LeaveSingleScatteringUnderLargeLamps) {
    compare_under_large_lamps(30000, 80000);
}
TEST_F(LongGuidedKinds, LeaveTheMean) { compare_all(-1, 5000, 20000); }

TEST_F(GuidedKinds, LeaveSingleScatteringUnderLargeLamps) { compare_under_large_lamps(2000, 5000); }

TEST_F(GuidedKinds, TheGridLeavesEachPathItself) {
    auto all = kinds();
    // Under a point, chains over both boundaries of the inclusion light its inside.
    Kind point{"under a point", xml::sphere({}, 1, smooth + ref("interior")), all[0].regions};
    point.objects =
        shared() + point.objects +
        xml::sphere({0.4, 0.2, 0.3}, 0.4, smooth + ref("interior") + ref("exterior")) +
        "<emitter type=\"point\"><point name=\"position\" x=\"2\" y=\"2\" z=\"2\"/></emitter>";
    all.push_back(point);
    for (const Kind& kind : all) {
        const auto values = [&](bool grid) {
            return estimate(scene(xml::integrator("volpath", xml::flag("distance_grid", grid)) +
                                  kind.objects),
                            kind.regions[0], {.pixels = 50})
                .values;
        };
        EXPECT_EQ(values(true), values(false)) << kind.name;
    }
}

// Guided exits and connections to lights are decided for each object and lamp by itself.
TEST_F(GuidedKinds, EachShapeByItself) {
    const auto ball = [](const std::string& boundary, double x) {
        return xml::sphere({x, 0, 0}, 1, boundary + ref("interior"));
    };
    const std::string volpath = xml::integrator("volpath"), far = lamp({0, 6, 0}, 0.5);
    const Scene beside = scene(volpath + shared() + ball(smooth, 0) + ball(rough, 3) +
                               ball(null, 6) + ball(checkered, 9) + lamp({1.5, 0.9, 0}, 0.1) + far);
    for (const std::uint32_t shape : {0u, 1u, 3u}) {
        EXPECT_TRUE(is_guided(beside, shape)) << shape;
        EXPECT_FALSE(is_connected(beside, shape)) << shape;
    }
    EXPECT_FALSE(is_guided(beside, 2));
    EXPECT_TRUE(is_connected(beside, 2));

    // One ball has a lamp inside, the other one whose box is in that of the ball.
    const Scene lamps = scene(volpath + shared() + ball(smooth, 0) + ball(smooth, 3) +
                              lamp({0, 0.5, 0}, 0.1) + lamp({3.8, 0.8, 0.5}, 0.1) + far);
    EXPECT_TRUE(is_guided(lamps, 0));
    EXPECT_TRUE(is_connected(lamps, 0));
    EXPECT_TRUE(is_guided(lamps, 1));
    EXPECT_FALSE(is_connected(lamps, 1));

    // Points inside have to be connected to; those outside cannot be.
    const auto point = [](double x) {
        return fmt::format(
            "<emitter type=\"point\"><point name=\"position\" x=\"{0}\" y=\"{0}\" "
            "z=\"{0}\"/></emitter>",
            x);
    };
    EXPECT_TRUE(is_connected(scene(volpath + shared() + ball(smooth, 0) + point(0.5)), 0));
    EXPECT_FALSE(is_connected(scene(volpath + shared() + ball(smooth, 0) + point(0.6)), 0));

    // One that may be seen through a hole, too.
    std::ofstream(folder_ / "open.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
    EXPECT_TRUE(
        is_connected(scene(volpath + shared() +
                           xml::shape("obj", "<string name=\"filename\" value=\"open.obj\"/>" +
                                                 smooth + ref("interior")) +
                           point(0.9)),
                     0));

    // A shape in another; one that nothing encloses leaves the medium without bounds.
    const std::string in = xml::sphere({0.2, 0, 0}, 0.3, smooth + ref("exterior")),
                      out = xml::sphere({5, 0, 0}, 0.3, smooth + ref("exterior"));
    EXPECT_TRUE(is_guided(scene(volpath + shared() + ball(smooth, 0) + in + far), 0));
    EXPECT_FALSE(is_guided(scene(volpath + shared() + ball(smooth, 0) + out + far), 0));
    // In the box, but outside of the ball.
    const std::string corner = xml::sphere({0.85, 0.85, 0.85}, 0.1, smooth + ref("exterior"));
    EXPECT_FALSE(is_guided(scene(volpath + shared() + ball(smooth, 0) + corner + far), 0));
}

// What each kind is guided for.
TEST_F(GuidedKinds, LowerTheNoise) {
    const std::string light = lamp({5, 6, 9}, 0.5, 100);
    const RayMaker rays = ray_bundle({-0.1f, -0.1f, 3}, {0, 0, -1}, 0.1f);
    const auto ball = [](const std::string& boundary, double x = 0) {
        return xml::sphere({x, 0, 0}, 1, boundary + ref("interior"));
    };
    const std::vector<std::pair<std::string, std::string>> objects{
        {"cloud", xml::sphere({}, 1, smooth + cloud(30))},
        {"textured", shared(10) + ball(checkered)},
        {"beside a null boundary", shared(10) + ball(smooth) + ball(null, 3)},
        {"inclusion",
         shared(10) + ball(smooth) + xml::sphere({0.5, 0, 0}, 0.3, smooth + ref("exterior"))},
        {"lamp inside", shared(10) + ball(smooth) + lamp({-0.6, 0, 0}, 0.1, 0.1)}};
    for (const auto& [name, object] : objects) {
        const auto error = [&](bool guided) {
            return estimate(scene(xml::integrator("volpath", xml::flag("guided_exits", guided)) +
                                  object + light),
                            rays, {.pixels = 200})
                .error[0];
        };
        EXPECT_LT(1.5 * error(true), error(false)) << name;
    }
}

}  // namespace
}  // namespace nacre::guided_kinds
