// Flat layers against published tables. Light falls on a slab from one side; by reciprocity the
// share that is reflected in all directions is the radiance seen against the direction of incidence
// while the sky on that side has radiance 1, and the share that passes is the radiance seen while
// the sky on the other side has radiance 1. Two skies of different colours give both at once.
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

/// A published slab: the values are facts from the sources named.
struct Slab {
    std::string name;
    double index, albedo, tau, g, mu0;
    double reflected, transmitted;  ///< shares, mirror reflection and unscattered light included
    double tolerance;  ///< of the published values: half a unit of the last digit, or their noise
};

const std::vector<Slab> slabs{
    // H. C. van de Hulst 1980, Multiple Light Scattering, vol. 2, table 35.
    {"van de Hulst table 35", 1, 0.9, 2, 0.75, 1, 0.09739, 0.66096, 1e-5},
    // The same, vol. 1, p. 256; and vol. 2, p. 424.
    {"van de Hulst p. 256", 1, 0.99, 1, 0, 0.5, 0.48652, 0.49163, 3e-4},
    {"van de Hulst p. 424", 1, 0.99, 4, 0.5, 0.5, 0.61996, 0.30605, 1e-5},
    // R. G. Giovanelli 1955, Reflection by Semi-infinite Diffusers, Optica Acta 2: half-space of
    // index 1.5; of the 0.2600, 0.0400 are reflected by the surface. 40 free paths are infinite to
    // 1e-9 at this albedo.
    {"Giovanelli", 1.5, 0.9, 40, 0, 1, 0.2600, 0, 5e-5},
};

class SlabTest : public RenderTest {
  protected:
    static std::string medium(const std::string& side, double sigma_t, double albedo, double g) {
        return xml::medium(side, xml::number("sigma_t", sigma_t) + xml::number("albedo", albedo) +
                                     (g == 0 ? xml::phase("isotropic") : xml::phase("hg", g)));
    }
    static RayMaker incident(double mu0) {
        const double s = std::sqrt(1 - mu0 * mu0);
        const Vec3f d{float(s), float(-mu0), 0.f};
        return fixed_ray(Point3f(0, 0, 0) - d * 90.f, d);
    }
    void expect(const RadianceEstimate& e, const std::string& name, double reflected,
                double transmitted, double tolerance, double largest_error) {
        const double published[] = {reflected, transmitted};
        for (int c = 0; c < 2; ++c) {
            EXPECT_NEAR(e.mean[c], published[c], 3 * std::hypot(e.error[c], tolerance))
                << name << (c ? ", transmitted" : ", reflected") << ", standard error "
                << e.error[c];
            EXPECT_LT(e.error[c], largest_error) << name;
        }
    }
    void check(const Slab& slab, int pixels, double largest_error, ColorMode mode,
               const std::string& options = "") {
        // 400 free paths wide: nothing gets to the edges.
        const std::string boundary =
            slab.index > 1 ? xml::dielectric(slab.index) : xml::bsdf("null");
        const Scene s = scene(
            xml::integrator("volpath", options) + two_skies({1, 0, 0}, {0, 1, 0}) +
                xml::shape("cube", fmt::format("<transform name=\"to_world\"><scale x=\"200\" "
                                               "y=\"{}\" z=\"200\"/></transform>",
                                               slab.tau / 2) +
                                       boundary + medium("interior", 1, slab.albedo, slab.g)),
            mode);
        expect(estimate(s, incident(slab.mu0),
                        {.sampler = "sobol", .pixels = pixels, .samples = 64, .seed = 11}),
               slab.name, slab.reflected, slab.transmitted, slab.tolerance, largest_error);
    }
};

TEST_F(SlabTest, AgreesWithPublishedSlabs) {
    for (const Slab& slab : slabs) check(slab, 1500, 2e-3, ColorMode::rgb_bands);
}

using LongSlabTest = SlabTest;
TEST_F(LongSlabTest, AgreesWithPublishedSlabs) {
    for (const Slab& slab : slabs) {
        check(slab, 40000, 4e-4, ColorMode::rgb_bands);
        check(slab, 10000, 8e-4, ColorMode::rgb_bands, xml::flag("distance_grid", false));
    }
}

// The example that comes with MCML (Wang, Jacques, Zheng 1995): three layers of index 1.37, here in
// millimetres: absorption, scattering, g, thickness. Its published result rests on 1e6 photons, so
// it is known to about 1e-3.
TEST_F(SlabTest, AgreesWithMcmlsThreeLayers) {
    struct Layer {
        double absorption, scattering, g, thickness;
    };
    const Layer layers[] = {{0.1, 10, 0.9, 1}, {0.1, 1, 0, 1}, {0.2, 1, 0.7, 2}};
    std::string text, media;
    double y = 2;
    for (int i = 0; i <= 3; ++i) {
        const bool outer = i == 0 || i == 3;
        std::string inside = fmt::format(
            "<transform name=\"to_world\"><scale value=\"80\"/><rotate x=\"1\" angle=\"-90\"/>"
            "<translate y=\"{}\"/></transform>",
            y);
        // Rectangles look up; the lowest is the surface of the layer above it, seen from below.
        if (i == 3) inside += xml::flag("flip_normals", true);
        inside += outer ? xml::dielectric(1.37) : xml::bsdf("null");
        if (i < 3) {
            const Layer& l = layers[i];
            const double sigma_t = l.absorption + l.scattering;
            media += fmt::format("<medium id=\"m{}\" type=\"homogeneous\">", i) +
                     xml::number("sigma_t", sigma_t) +
                     xml::number("albedo", l.scattering / sigma_t) +
                     (l.g == 0 ? xml::phase("isotropic") : xml::phase("hg", l.g)) + "</medium>";
            inside += fmt::format("<ref name=\"interior\" id=\"m{}\"/>", i);
            y -= l.thickness;
        }
        if (i > 0)
            inside += fmt::format("<ref name=\"{}\" id=\"m{}\"/>", i == 3 ? "interior" : "exterior",
                                  i - 1);
        text += xml::shape("rectangle", inside);
    }
    const Scene s =
        scene(media + xml::integrator("volpath") + two_skies({1, 0, 0}, {0, 1, 0}) + text);
    expect(estimate(s, incident(1), {.sampler = "sobol", .pixels = 1000, .samples = 64}), "MCML",
           0.2619169, 0.0964896, 1e-3, 2e-3);
}

}  // namespace
}  // namespace nacre
