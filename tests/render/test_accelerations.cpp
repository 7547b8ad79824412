// The distance grid and the guided exits of volpath change the time that a picture takes, never
// what it shows.
#include "nacre/geometry/figure.h"
#include "nacre/geometry/mesh_build.h"
#include "tests/geometry/shapes.h"
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

/// What the object is seen from: the camera's rays cover a region of it.
struct Region {
    std::string name;
    RayMaker rays;
};

class Accelerations : public RenderTest {
  protected:
    /// A shell-shaped ellipsoid as a coarse mesh: half axes 1, 0.8 and 0.2, so its rim is thin.
    /// With normals its surface looks smooth and shading and geometry disagree by degrees.
    std::string lens() const {
        constexpr int columns = 24, rows = 12;
        std::ofstream out(folder_ / "lens.obj");
        const auto vertex = [](int i, int j) {
            const double theta = pi * j / rows, phi = 2 * pi * i / columns;
            return Vec3d(std::sin(theta) * std::cos(phi), std::cos(theta),
                         -std::sin(theta) * std::sin(phi));
        };
        for (const bool normals : {false, true})
            for (int j = 0; j <= rows; ++j)
                for (int i = 0; i < columns; ++i) {
                    const Vec3d v = vertex(i, j);
                    if (normals)
                        out << fmt::format("vn {} {} {}\n", v.x / 1, v.y / 0.8, v.z / 0.2);
                    else
                        out << fmt::format("v {} {} {}\n", v.x * 1, v.y * 0.8, v.z * 0.2);
                }
        const auto index = [](int i, int j) { return j * columns + i % columns + 1; };
        const auto face = [&](int a, int b, int c) {
            out << fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", a, b, c);
        };
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const int a = index(i, j), b = index(i, j + 1), c = index(i + 1, j + 1),
                          d = index(i + 1, j);
                if (j + 1 < rows) face(a, b, c);
                if (j > 0) face(a, c, d);
            }
        return "<string name=\"filename\" value=\"lens.obj\"/>";
    }
    static std::string body_of(const std::string& phase,
                               const std::string& boundary = xml::dielectric(1.4)) {
        return boundary +
               xml::medium("interior", xml::rgb("sigma_t", {6, 10, 16}) +
                                           xml::rgb("albedo", {0.99, 0.95, 0.8}) + phase);
    }
    static std::string accelerated(bool grid, bool guided) {
        return xml::integrator(
            "volpath", xml::flag("distance_grid", grid) + xml::flag("guided_exits", guided));
    }
    static std::map<std::string, std::string> lights() {
        // A square in the plane z = -3 that faces the object.
        const std::string square =
            xml::shape("rectangle",
                       "<transform name=\"to_world\"><scale value=\"0.7\"/>"
                       "<translate x=\"0.8\" y=\"0.5\" z=\"-3\"/></transform>" +
                           xml::area_light({9, 7, 5}));
        const std::string ball = xml::sphere({-1, 0.6, -2.5}, 0.5, xml::area_light({6, 8, 10}));
        return {{"square", square},
                {"ball", ball},
                {"two lights and sky", square + ball + xml::constant_light(0.3)}};
    }
    /// Camera in front, light behind: the rim lets light through, the middle is thick; and from
    /// behind, where the light falls on.
    static std::vector<Region> regions() {
        return {{"rim", ray_bundle({0.9f, 0, 4}, {0, 0, -1}, 0.12f)},
                {"middle", ray_bundle({0, 0, 4}, {0, 0, -1}, 0.3f)},
                {"lit", ray_bundle({0.2f, 0, -2.2f}, {0, 0, 1}, 0.3f)}};
    }
    void compare_guided(const std::string& what, const std::string& objects,
                        const std::vector<Region>& regions, ColorMode mode, int pixels,
                        double deviations) {
        const Scene with = scene(accelerated(true, true) + objects, mode);
        const Scene without = scene(accelerated(true, false) + objects, mode);
        const auto guided = make_integrator(with), plain = make_integrator(without);
        for (const Region& region : regions) {
            const auto a = estimate(with, *guided, region.rays, {.pixels = pixels, .seed = 21});
            const auto b = estimate(without, *plain, region.rays, {.pixels = pixels, .seed = 22});
            expect_agreement(a, b, deviations, what + ", " + region.name);
            EXPECT_GT(a.mean[0], 0) << what << ", " << region.name;
        }
    }
};

// The grid only leaves out rays that could not have met anything, so each path stays itself, with
// guided exits as without: those do not hang on it.
TEST_F(Accelerations, TheGridLeavesEachPathItself) {
    using Case = std::pair<bool, bool>;
    for (const auto& [smooth, guided] :
         {Case(false, false), Case(true, false), Case(false, true), Case(true, true)})
        for (const std::string light : {"square", "two lights and sky"}) {
            const std::string objects =
                xml::shape("obj", lens() + xml::flag("face_normals", !smooth) +
                                      body_of(xml::phase("hg", 0.6))) +
                lights().at(light);
            const Scene with = scene(accelerated(true, guided) + objects);
            const Scene without = scene(accelerated(false, guided) + objects);
            const auto fast = make_integrator(with), slow = make_integrator(without);
            for (const Region& region : regions()) {
                const auto a = estimate(with, *fast, region.rays, {.pixels = 300});
                const auto b = estimate(without, *slow, region.rays, {.pixels = 300});
                EXPECT_EQ(a.values, b.values) << light << ", " << region.name << guided;
            }
            // And it does leave out rays.
            RayCounts few, many;
            Sampler sampler(Sampler::Kind::independent, 1, 1);
            for (std::uint32_t i = 0; i < 200; ++i) {
                const Ray ray{{0.1f, 0, 4}, {0, 0, -1}};
                sampler.start(i, 0);
                fast->radiance(ray, sampler, Wavelengths::rgb_bands(), few);
                sampler.start(i, 0);
                slow->radiance(ray, sampler, Wavelengths::rgb_bands(), many);
            }
            EXPECT_EQ(few.scatterings, many.scatterings);
            EXPECT_LT(few.rays, 0.9 * double(many.rays));
        }
}

TEST_F(Accelerations, GuidedExitsLeaveTheMean) {
    const double deviations = sidak_deviations(5 * 3 * 3);
    const auto object = [&](bool smooth, const std::string& phase) {
        return xml::shape("obj", lens() + xml::flag("face_normals", !smooth) + body_of(phase));
    };
    const std::string isotropic = xml::phase("isotropic"), hg = xml::phase("hg", 0.6);
    const auto all = lights();
    compare_guided("face normals, square, isotropic", object(false, isotropic) + all.at("square"),
                   regions(), ColorMode::rgb_bands, 5000, deviations);
    compare_guided("smooth normals, ball, hg", object(true, hg) + all.at("ball"), regions(),
                   ColorMode::rgb_bands, 5000, deviations);
    compare_guided("smooth normals, two lights, isotropic",
                   object(true, isotropic) + all.at("two lights and sky"), regions(),
                   ColorMode::rgb_bands, 5000, deviations);
    compare_guided("face normals, ball, isotropic, spectral",
                   object(false, isotropic) + all.at("ball"), regions(), ColorMode::spectral, 5000,
                   deviations);
    compare_guided("analytic sphere, square, hg",
                   xml::sphere({}, 0.5, body_of(hg)) + all.at("square"),
                   {{"front", ray_bundle({0, 0, 4}, {0, 0, -1}, 0.4f)},
                    {"back", ray_bundle({0, 0, -2.2f}, {0, 0, 1}, 0.4f)}},
                   ColorMode::rgb_bands, 5000, deviations);
}

// Light scattered once, at places that the light reaches more and less, so that proposals are made
// always, often and seldom: numbers shared with the free path, which decides where, would show. The
// large light is met by chance about as densely as by proposal, so that wrong weights would show.
TEST_F(Accelerations, GuidedExitsLeaveSingleScattering) {
    struct Case {
        double light_radius;
        float x;
        int pixels, pixels_without;
    };
    for (const Case& k : {Case{2.5, 2, 6000, 40000}, Case{2.5, 1.5, 6000, 40000},
                          Case{2.5, 1, 6000, 40000}, Case{7, 1, 20000, 100000}}) {
        const Vec3d at = k.light_radius > 3 ? Vec3d(13, 0, 9) : Vec3d(10, 0, 3);
        const auto make = [&](bool guided) {
            return scene(xml::integrator("volpath", xml::integer("max_depth", 4) +
                                                        xml::flag("guided_exits", guided)) +
                         xml::sphere({}, 4, body_of(xml::phase("isotropic"))) +
                         xml::sphere(at, k.light_radius, xml::area_light({10, 10, 10})));
        };
        const RayMaker rays = ray_bundle({k.x, 0, 4.5f}, {0, 0, -1}, 0.1f);
        const auto a = estimate(make(true), rays, {.pixels = k.pixels, .seed = 1}),
                   b = estimate(make(false), rays, {.pixels = k.pixels_without, .seed = 2});
        expect_agreement(a, b, sidak_deviations(12),
                         fmt::format("light of radius {}, x = {}", k.light_radius, k.x));
    }
}

// The same for the sky, and for rough boundaries, whose three ways to the light all are likely: the
// light is large enough to be met by scattering at the boundary.
TEST_F(Accelerations, GuidedExitsLeaveSingleScatteringOfOtherKinds) {
    const std::string sky = window_sky({60, 50, 40});
    struct Case {
        std::string boundary, light;
        float x;
    };
    const std::string smooth = xml::dielectric(1.4), rough = xml::rough_dielectric(1.4, 0.2);
    const std::string ball = xml::sphere({13, 0, 9}, 7, xml::area_light({10, 10, 10}));
    for (const Case& k : {Case{smooth, sky, 1}, Case{smooth, sky, 3}, Case{rough, ball, 1},
                          Case{rough, ball, 2.5}, Case{xml::rough_dielectric(1.4, 0.5), sky, 1}}) {
        const auto make = [&](bool guided) {
            return scene(xml::integrator("volpath", xml::integer("max_depth", 4) +
                                                        xml::flag("guided_exits", guided)) +
                         xml::sphere({}, 4, body_of(xml::phase("isotropic"), k.boundary)) +
                         k.light);
        };
        // The window is behind; the ball, in front.
        const float z = k.light == sky ? -1.f : 1.f;
        const RayMaker rays = ray_bundle({k.x, 0, 4.5f * z}, {0, 0, -z}, 0.1f);
        const auto a = estimate(make(true), rays, {.pixels = 10000, .seed = 1}),
                   b = estimate(make(false), rays, {.pixels = 50000, .seed = 2});
        expect_agreement(a, b, sidak_deviations(15), k.boundary + k.light);
    }
}

// What guided exits are there for: a small light, which walks hardly ever find by themselves, and
// an object that is nearly flat over a free path.
TEST_F(Accelerations, GuidedExitsLowerTheNoise) {
    const std::string objects = xml::sphere({}, 4, body_of(xml::phase("isotropic"))) +
                                xml::sphere({5, 6, 9}, 0.5, xml::area_light({100, 100, 100}));
    const Scene with = scene(accelerated(true, true) + objects);
    const Scene without = scene(accelerated(true, false) + objects);
    // Off the light's mirror image.
    const RayMaker rays = ray_bundle({-0.5f, -0.5f, 6}, {0, 0, -1}, 0.1f);
    const auto a = estimate(with, rays, {.pixels = 2000}),
               b = estimate(without, rays, {.pixels = 2000});
    for (int c = 0; c < 3; ++c) EXPECT_LT(3 * a.error[c], b.error[c]);
}

TEST_F(Accelerations, GuidedExitsLowerTheNoiseOfOtherKinds) {
    const std::string isotropic = xml::phase("isotropic"), rough = xml::rough_dielectric(1.4, 0.2);
    const std::string ball = xml::sphere({5, 6, 9}, 0.5, xml::area_light({100, 100, 100}));
    const auto errors = [&](const std::string& boundary, const std::string& light, float z) {
        const std::string objects = xml::sphere({}, 4, body_of(isotropic, boundary)) + light;
        const RayMaker rays = ray_bundle({-0.5f, -0.5f, 6 * z}, {0, 0, -z}, 0.1f);
        return std::pair(
            estimate(scene(accelerated(true, true) + objects), rays, {.pixels = 2000}).error[1],
            estimate(scene(accelerated(true, false) + objects), rays, {.pixels = 2000}).error[1]);
    };
    const auto sky = errors(xml::dielectric(1.4), window_sky({60, 50, 40}), -1);
    EXPECT_LT(2 * sky.first, sky.second);
    const auto lamp = errors(rough, ball, 1);
    EXPECT_LT(2 * lamp.first, lamp.second);
}

TEST_F(Accelerations, GuidedExitsLeaveTheMeanUnderAnEnvironment) {
    const double deviations = sidak_deviations(2 * 3 * 3);
    const std::string sky = window_sky({60, 50, 40});
    compare_guided("faces, window",
                   xml::shape("obj", lens() + xml::flag("face_normals", true) +
                                         body_of(xml::phase("hg", 0.6))) +
                       sky,
                   regions(), ColorMode::rgb_bands, 5000, deviations);
    compare_guided(
        "smooth normals, window and ball, spectral",
        xml::shape("obj", lens() + body_of(xml::phase("isotropic"))) + sky + lights().at("ball"),
        regions(), ColorMode::spectral, 5000, deviations);
}

TEST_F(Accelerations, GuidedExitsLeaveTheMeanBehindRoughBoundaries) {
    const double deviations = sidak_deviations(5 * 3 * 3);
    const std::string isotropic = xml::phase("isotropic"), hg = xml::phase("hg", 0.6);
    const auto object = [&](bool smooth, double alpha, const std::string& facets,
                            const std::string& phase) {
        return xml::shape("obj", lens() + xml::flag("face_normals", !smooth) +
                                     body_of(phase, xml::rough_dielectric(1.4, alpha, facets)));
    };
    const std::string point =
        "<emitter type=\"point\"><point name=\"position\" x=\"0.8\" y=\"0.5\" z=\"-3\"/>"
        "</emitter>";
    compare_guided("faces, square", object(false, 0.2, "ggx", isotropic) + lights().at("square"),
                   regions(), ColorMode::rgb_bands, 5000, deviations);
    compare_guided("smooth normals, two lights and sky",
                   object(true, 0.1, "beckmann", hg) + lights().at("two lights and sky"), regions(),
                   ColorMode::rgb_bands, 5000, deviations);
    compare_guided("smooth normals, ball, spectral",
                   object(true, 0.4, "ggx", hg) + lights().at("ball"), regions(),
                   ColorMode::spectral, 5000, deviations);
    compare_guided("faces, window", object(false, 0.2, "ggx", hg) + window_sky({60, 50, 40}),
                   regions(), ColorMode::rgb_bands, 5000, deviations);
    compare_guided("faces, point and sky",
                   object(false, 0.2, "ggx", isotropic) + point + xml::constant_light(0.1),
                   regions(), ColorMode::rgb_bands, 5000, deviations);
}

using LongAccelerations = Accelerations;
TEST_F(LongAccelerations, GuidedExitsLeaveTheMean) {
    const double deviations = sidak_deviations(2 * 2 * 2 * 3 * 3 * 3);
    for (const bool smooth : {false, true})
        for (const std::string& phase : {xml::phase("isotropic"), xml::phase("hg", 0.6)})
            for (const ColorMode mode : {ColorMode::rgb_bands, ColorMode::spectral})
                for (const auto& [light, text] : lights())
                    compare_guided(
                        fmt::format("{}, {}, {}, {}", smooth ? "smooth" : "faces", light, phase,
                                    mode == ColorMode::spectral ? "spectral" : "rgb"),
                        xml::shape("obj",
                                   lens() + xml::flag("face_normals", !smooth) + body_of(phase)) +
                            text,
                        regions(), mode, 15000, deviations);
}

// The built-in figure with its thin ears, lit from behind, seen from the front.
TEST_F(LongAccelerations, GuidedExitsLeaveTheMeanOfTheFigure) {
    Mesh mesh = make_figure(6.f);
    std::ofstream out(folder_ / "figure.obj");
    for (const Point3f& p : mesh.positions) out << fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const Vec3f& n : mesh.normals) out << fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
    for (const auto& t : mesh.triangles)
        out << fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    out.close();
    const Box3f box = figure_box();
    const Point3f c = box.center();
    const Vec3f half = box.diagonal() * 0.5f;
    const auto light = xml::sphere({c.x, c.y + half.y, c.z - 3 * half.y}, 0.4 * half.y,
                                   xml::area_light({20, 20, 20}));
    // In shares of half the box's sides from its centre.
    struct Part {
        std::string name;
        float x, y;
    };
    std::vector<Region> parts;
    for (const Part& part :
         {Part{"right ear", -0.54f, 0.45f}, Part{"left ear", 0.56f, 0.4f},
          Part{"right collar", -0.74f, -0.47f}, Part{"left collar", 0.72f, -0.47f},
          Part{"face", 0.f, 0.5f}, Part{"chest", 0.f, -0.3f}})
        parts.push_back(
            {part.name, ray_bundle({c.x + half.x * part.x, c.y + half.y * part.y, c.z + 4 * half.y},
                                   {0, 0, -1}, 0.05f * half.x)});
    const double deviations = sidak_deviations(2 * 6 * 3);
    for (const bool smooth : {false, true}) {
        const std::string objects =
            xml::shape("obj",
                       "<string name=\"filename\" value=\"figure.obj\"/>" +
                           xml::flag("face_normals", !smooth) + xml::dielectric(1.4) +
                           xml::medium("interior", xml::rgb("sigma_t", {0.3, 0.5, 0.8}) +
                                                       xml::rgb("albedo", {0.99, 0.98, 0.9}))) +
            light + xml::constant_light(0.05);
        compare_guided(smooth ? "figure, smooth" : "figure, faces", objects, parts,
                       ColorMode::rgb_bands, 10000, deviations);
    }
}

}  // namespace
}  // namespace nacre
