// Absorbers and media that absorb more than they scatter.
#include "nacre/layers/adding_doubling.h"
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

class Absorption : public RenderTest {
  protected:
    /// A sky of radiance 1 behind a body about the origin.
    Scene in_the_sky(const std::string& body, ColorMode mode = ColorMode::rgb_bands) {
        return scene(xml::integrator("volpath") + xml::constant_light() + body, mode);
    }
    static std::string absorber(const std::string& sigma_t) {
        return xml::medium("interior", sigma_t + xml::number("albedo", 0));
    }
    static std::string cube(const std::string& inside) { return xml::shape("cube", inside); }
    /// Every single path knows the answer.
    void expect_exact(const Scene& s, const RayMaker& rays, const Vec3d& truth,
                      const std::string& what) {
        const auto e = estimate(s, rays, {.pixels = 30, .samples = 3});
        for (const Vec3d& v : e.values)
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(v[c], truth[c], 2e-5 * truth[c] + 1e-7) << what;
    }
    const RayMaker through_ = fixed_ray({0.1f, 0.2f, 4}, {0, 0, -1});
};

// Beer, Lambert: light that comes straight through has no noise.
TEST_F(Absorption, ClearAbsorbersFollowBeersLaw) {
    const std::string none = xml::bsdf("null"), sigma = xml::rgb("sigma_t", {0, 0.5, 2});
    const Vec3d truth{1, std::exp(-1.), std::exp(-4.)};
    expect_exact(in_the_sky(cube(none + absorber(sigma))), through_, truth, "slab");
    const double chord = 2 * std::sqrt(1 - 0.05);
    expect_exact(in_the_sky(xml::sphere({}, 1, none + absorber(sigma))), through_,
                 {1, std::exp(-0.5 * chord), std::exp(-2 * chord)}, "ball");
    // Two surfaces between which nothing changes, and a lamp that is also drawn.
    expect_exact(in_the_sky(cube(none + absorber(sigma)) +
                            xml::sphere({0, 0, -9}, 2, xml::area_light({1, 1, 1}))),
                 through_, truth, "lamp behind");
    // A wall lit through the absorber, by a light without extent.
    const Scene wall = scene(
        xml::integrator("volpath") + cube(none + absorber(sigma)) +
        "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"0\" "
        "z=\"-1\"/><float name=\"irradiance\" value=\"1\"/></emitter>" +
        xml::shape("rectangle", "<transform name=\"to_world\"><translate z=\"-2\"/></transform>" +
                                    xml::bsdf("diffuse", xml::number("reflectance", 1))));
    expect_exact(wall, fixed_ray({0.1f, 0.2f, -1.5f}, {0, 0, -1}), truth * (1 / pi), "wall");
}

// In spectral mode all wavelengths of a path come through, each with what is left of it; the sum
// over the wavelengths has the noise that the clear sky has.
TEST_F(Absorption, ClearAbsorbersFollowBeersLawInSpectralMode) {
    const auto body = [&](double sigma) {
        return in_the_sky(cube(xml::bsdf("null") + absorber(xml::number("sigma_t", sigma))),
                          ColorMode::spectral);
    };
    const auto clear = estimate(body(0), through_, {.pixels = 30, .samples = 3}),
               dark = estimate(body(1.5), through_, {.pixels = 30, .samples = 3});
    for (std::size_t i = 0; i < clear.values.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(dark.values[i][c], std::exp(-3.) * clear.values[i][c], 1e-5);
}

// A slab of index n, seen straight: each face mirrors R of the light.
TEST_F(Absorption, RefractingAbsorbersFollowBeersLaw) {
    const double r = 0.04, t = std::exp(-0.8);
    const double truth = r + (1 - r) * (1 - r) * t / (1 - r * t);
    for (const ColorMode mode : {ColorMode::rgb_bands, ColorMode::spectral}) {
        const auto e = estimate(
            in_the_sky(cube(xml::dielectric(1.5) + absorber(xml::number("sigma_t", 0.4))), mode),
            through_, {.pixels = 2000, .samples = 16});
        if (mode == ColorMode::rgb_bands)
            expect_radiance(e, Vec3d(truth, truth, truth), 1e-3, "glass");
        EXPECT_NEAR(e.luminance(), truth, 4 * e.luminance_error());
        // A path that is cut short in half of the cases would have an error of 0.25 %.
        EXPECT_LT(e.luminance_error(), 1e-3);
    }
}

// Extinction that varies in space is integrated exactly, whatever the filter and the placing.
TEST_F(Absorption, AbsorbersThatVaryFollowBeersLaw) {
    write_vol("ramp.vol", 5, 1, [](int x, int y, int, int) { return 0.2 + 0.1 * x * (y + 1); });
    write_vol("rgb.vol", 3, 3, [](int x, int, int z, int c) { return 0.1 * (c + x) + 0.2 * z; });
    const auto body = [&](const std::string& file, const std::string& filter) {
        return in_the_sky(
            cube(xml::bsdf("null") +
                 "<medium name=\"interior\" type=\"heterogeneous\"><volume name=\"sigma_t\" "
                 "type=\"gridvolume\"><string name=\"filename\" value=\"" +
                 file + "\"/><string name=\"filter_type\" value=\"" + filter +
                 "\"/><transform name=\"to_world\"><translate x=\"-0.5\" y=\"-0.5\" z=\"-0.5\"/>"
                 "<scale value=\"2\"/></transform></volume>" +
                 xml::number("scale", 2) + xml::number("albedo", 0) + "</medium>"));
    };
    // Along x at the middle of the row y = 1: the ends are constant over half a voxel, so that the
    // mean is that of the voxels. Voxels are 0.4 wide.
    const double ramp = 2 * 0.4 * (5 * 0.2 + 0.1 * 2 * 10), z0 = 0.1, mu = std::sqrt(0.5);
    const RayMaker along = fixed_ray({-4, -0.4f, 0.3f}, {1, 0, 0});
    for (const std::string filter : {"trilinear", "nearest"})
        expect_exact(body("ramp.vol", filter), along, Vec3d(1, 1, 1) * std::exp(-ramp), filter);
    // Up the diagonal of a layer between voxels' centres, (x + z) grows twice as fast: 0.1 (c + x)
    // + 0.2 z, both clamped to [0, 2], integrated by hand over x = z from -1/2 to 5/2 voxels.
    const auto depth = [&](int c) {
        return 2 * (2. / 3) / mu * (0.5 * 0.1 * c + 2 * (0.1 * c + 0.3) + 0.5 * (0.1 * c + 0.6));
    };
    expect_exact(body("rgb.vol", "trilinear"), fixed_ray({-3, float(z0), -3}, {1, 0, 1}),
                 {std::exp(-depth(0)), std::exp(-depth(1)), std::exp(-depth(2))}, "diagonal");
    expect_exact(body("rgb.vol", "trilinear"), fixed_ray({3, float(z0), 3}, {-1, 0, -1}),
                 {std::exp(-depth(0)), std::exp(-depth(1)), std::exp(-depth(2))}, "back");
}

// Slabs against adding-doubling: all that is reflected and transmitted (see test_slabs.cpp).
TEST_F(Absorption, SlabsAgreeWithAddingDoubling) {
    struct Slab {
        double albedo, tau, g, eta, mu;
        bool grid = false;
    };
    const std::vector<Slab> slabs{
        {0.1, 1, 0, 1, 1},       {0.1, 3, 0.5, 1, 0.5},        {0.3, 0.5, 0, 1.5, 1},
        {0.5, 2, 0, 1.5, 0.6},   {0.45, 1, 0.5, 1, 1},         {0.9, 2, 0, 1, 0.5},
        {0.2, 2, 0, 1, 1, true}, {0.45, 1, 0.5, 1.5, 1, true}, {0.9, 1, 0, 1, 1, true}};
    const double deviations = sidak_deviations(2 * int(slabs.size()));
    write_vol("even.vol", 2, 1, [](int, int, int, int) { return 1; });
    for (const Slab& k : slabs) {
        const LayerStack stack{{{.sigma_s = k.albedo,
                                 .sigma_a = 1 - k.albedo,
                                 .g = k.g,
                                 .thickness = k.tau,
                                 .eta = k.eta}}};
        const LayerTotals truth =
            adding_doubling(stack, {&k.mu, 1}, {}, {.accuracy = 1e-6}).collimated[0];
        const std::string sigma =
            k.grid ? "<volume name=\"sigma_t\" type=\"gridvolume\"><string name=\"filename\" "
                     "value=\"even.vol\"/><transform name=\"to_world\"><translate x=\"-0.5\" "
                     "y=\"-0.5\" z=\"-0.5\"/><scale value=\"500\"/></transform></volume>"
                   : xml::number("sigma_t", 1);
        const Scene s =
            scene(xml::integrator("volpath") + two_skies({1, 0, 0}, {0, 1, 0}) +
                  cube(fmt::format("<transform name=\"to_world\"><scale x=\"200\" y=\"{}\" "
                                   "z=\"200\"/></transform>",
                                   k.tau / 2) +
                       (k.eta > 1 ? xml::dielectric(k.eta) : xml::bsdf("null")) +
                       "<medium name=\"interior\" type=\"" +
                       (k.grid ? "heterogeneous" : "homogeneous") + "\">" + sigma +
                       xml::number("albedo", k.albedo) + xml::phase("hg", k.g) + "</medium>"));
        const Vec3f d{float(std::sqrt(1 - k.mu * k.mu)), float(-k.mu), 0.f};
        const auto e = estimate(s, fixed_ray(Point3f(0, 0, 0) - d * 90.f, d),
                                {.sampler = "sobol", .pixels = 1500, .samples = 32, .seed = 5});
        expect_radiance(e, {truth.reflectance, truth.transmittance, 0}, 2e-3,
                        fmt::format("albedo {} tau {} g {} eta {}{}", k.albedo, k.tau, k.g, k.eta,
                                    k.grid ? ", grid" : ""),
                        deviations, 2);
    }
}

// Guided exits weigh against the density of the path's own passing, not against what is left of the
// light. The lamp is so large that it is met by chance about as densely as by proposal, so that wrong
// weights show.
TEST_F(Absorption, GuidedExitsLeaveSingleScattering) {
    const double deviations = sidak_deviations(4 * 3);
    const std::string ball = xml::sphere({13, 0, 9}, 7, xml::area_light({10, 10, 10}));
    for (const std::string& boundary : {xml::dielectric(1.4), xml::rough_dielectric(1.4, 0.15)})
        for (const double albedo : {0.04}) {
            const auto make = [&](bool guided) {
                return scene(
                    xml::integrator("volpath", xml::integer("max_depth", 4) +
                                                   xml::flag("guided_exits", guided)) +
                    ball +
                    xml::sphere(
                        {}, 4,
                        boundary + xml::medium("interior", xml::rgb("sigma_t", {0.2, 0.4, 0.8}) +
                                                               xml::number("albedo", albedo))));
            };
            const RayMaker rays = ray_bundle({1.5f, 0, 4.5f}, {0, 0, -1}, 0.1f);
            const auto a = estimate(make(true), rays, {.pixels = 16000, .seed = 1}),
                       b = estimate(make(false), rays, {.pixels = 32000, .seed = 2});
            expect_agreement(a, b, deviations, fmt::format("{}, albedo {}", boundary, albedo));
        }
}

// Each band is what a grey medium of its own shows, also where their chances to collide differ:
// every lane weighs a path by the density with which it would have made it.
TEST_F(Absorption, BandsOfDifferentAlbedosDoNotMix) {
    const Vec3d sigma{1, 3, 0.7}, albedo{0, 0.2, 0.95};
    const auto body = [](const std::string& boundary, const std::string& inside) {
        return xml::integrator("volpath") + xml::constant_light(0.4) +
               xml::sphere({1.5, 2, -2}, 0.8, xml::area_light({6, 6, 6})) +
               xml::sphere({}, 1, boundary + xml::medium("interior", inside));
    };
    const RayMaker rays = ray_bundle({0, 0, 4}, {0, 0, -1}, 0.95f);
    for (const std::string& boundary : {xml::bsdf("null"), xml::dielectric(1.4)}) {
        const auto all =
            estimate(scene(body(boundary, xml::rgb("sigma_t", sigma) + xml::rgb("albedo", albedo))),
                     rays, {.pixels = 6000, .samples = 15, .seed = 1});
        for (int c = 0; c < 3; ++c) {
            const auto grey = estimate(scene(body(boundary, xml::number("sigma_t", sigma[c]) +
                                                                xml::number("albedo", albedo[c]))),
                                       rays, {.pixels = 4000, .seed = std::uint64_t(2 + c)});
            const double error = std::hypot(all.error[c], grey.error[c]);
            EXPECT_NEAR(all.mean[c], grey.mean[c], sidak_deviations(6) * error) << boundary << c;
            EXPECT_LT(error, 0.02 * all.mean[c]) << boundary << c;
        }
    }
}

}  // namespace
}  // namespace nacre
