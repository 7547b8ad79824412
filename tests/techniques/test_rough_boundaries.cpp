// Techniques behind rough dielectric boundaries, beside complete simulation.
#include "nacre/optics/fresnel_moments.h"
#include "nacre/reflectance/rough_boundary.h"
#include "nacre/render/object_boundary.h"
#include "tests/techniques/technique_fixture.h"

namespace nacre {
namespace {

std::string rough(double alpha, const std::string& distribution = "ggx") {
    return xml::bsdf("roughdielectric",
                     word("distribution", distribution) + xml::number("alpha", alpha) +
                         xml::number("int_ior", 1.5) + xml::number("ext_ior", 1));
}
std::string matter(double sigma_s, double sigma_a) {
    return xml::medium("interior",
                       xml::number("sigma_s", sigma_s) + xml::number("sigma_a", sigma_a));
}

class RoughBoundaries : public Techniques {
  protected:
    RadianceEstimate by(const std::string& technique, const std::string& body, const RayMaker& rays,
                        const EstimateOptions& options,
                        const std::vector<std::pair<std::string, std::string>>& settings = {}) {
        return look(scene(xml::integrator("path") + body), {technique, settings}, rays, options);
    }
};

TEST_F(RoughBoundaries, LetPassWhatFresnelSaysWhereTheyAreNearlySmooth) {
    const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                          xml::sphere({}, 1, rough(1e-3) + matter(1, 0)));
    const ObjectBoundary boundary = ObjectBoundary::of(s.shapes[0]), smooth(1.5f);
    EXPECT_EQ(boundary.rough(), s.shapes[0].material.get());
    EXPECT_EQ(smooth.rough(), nullptr);
    EXPECT_FLOAT_EQ(boundary.eta(), 1.5f);
    for (const float mu : {0.2f, 0.5f, 0.8f, 1.f})
        EXPECT_NEAR(boundary.transmittance(mu), 1. - fresnel_dielectric(double(mu), 1.5), 3e-3)
            << mu;
    EXPECT_NEAR(boundary.mean_transmittance(), 1. - diffuse_reflectance_external(1.5), 2e-3);
    EXPECT_NEAR(boundary.mean_reflectance(), diffuse_reflectance_external(1.5), 2e-3);
}

TEST_F(RoughBoundaries, LoseNoMoreThanTheFacetsDo) {
    for (const char* distribution : {"ggx", "beckmann"}) {
        for (const double alpha : {0.05, 0.3, 0.6}) {
            const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                                  xml::sphere({}, 1, rough(alpha, distribution) + matter(1, 0)));
            const ObjectBoundary b = ObjectBoundary::of(s.shapes[0]);
            // One facet each: nothing is gained, and little lost.
            EXPECT_LE(b.mean_transmittance() + b.mean_reflectance(), 1.001) << alpha;
            EXPECT_GE(b.mean_transmittance() + b.mean_reflectance(), 0.85) << alpha;
        }
    }
}

TEST_F(RoughBoundaries, OfWhiteObjectsInEvenLightAreAsBrightAsSimulated) {
    // Facets lose light, so that shape matters even in white objects (docs/subsurface.md): both are
    // slabs, the simulated one as thick as it takes to be like any thicker one.
    const Vec3f directions[] = {{0, 0, 1}, {0.8f, 0, 0.6f}};
    const std::string light = xml::constant_light();
    for (const double alpha : {0.1, 0.4}) {
        const std::string white = rough(alpha) + matter(2, 0);
        std::vector<RadianceEstimate> truth;
        for (const Vec3f& from : directions) {
            truth.push_back(by("volpath", light + slab(6, white), onto_the_middle(from, 5),
                               {.pixels = 1000, .samples = 32}));
            EXPECT_LT(truth.back().error[1], 0.003);
        }
        for (const char* technique : {"brdf", "hanrahan_krueger", "surface", "two_pass"}) {
            const Scene s = scene(xml::integrator("path") + light + slab(30, white));
            TechniqueChoice choice{technique};
            if (choice.technique == "two_pass")
                choice.options = {
                    {"spacing", "2"}, {"irradiance_samples", "64"}, {"error", "0.05"}};
            const TechniquePtr prepared = prepare(s, plan_of(s, choice));
            for (std::size_t i = 0; i < std::size(directions); ++i) {
                const RadianceEstimate e = estimate(*prepared, onto_the_middle(directions[i], 5),
                                                    {.pixels = 400, .samples = 64});
                EXPECT_NEAR(e.mean[1], truth[i].mean[1],
                            4.5 * std::hypot(e.error[1], truth[i].error[1]) + 0.01)
                    << technique << " alpha " << alpha << " direction " << i;
            }
        }
    }
}

TEST_F(RoughBoundaries, OfAThickObjectInOneLightAreNearlyAsBrightAsSimulated) {
    // A lamp above: the mirror lobe and what comes from below. Behind a smooth boundary the dipole
    // returns 1 % more than a half space does in even light, and a walk 2 %; which way the light
    // comes from, they do not know.
    const std::string lamp = xml::shape(
        "rectangle",
        "<transform name=\"to_world\"><scale value=\"6\"/><rotate y=\"1\" angle=\"180\"/>"
        "<translate x=\"8\" z=\"20\"/></transform>" +
            xml::area_light({10, 10, 10}));
    const RayMaker rays = onto_the_middle({-0.5f, 0, 0.87f}, 3);
    const std::string object = slab(12, rough(0.3) + matter(3, 0.06));
    const RadianceEstimate truth =
        by("volpath", lamp + object, rays, {.pixels = 6000, .samples = 16});
    EXPECT_LT(truth.error[1], 0.015 * truth.mean[1]);
    for (const char* technique :
         {"brdf", "hanrahan_krueger", "surface", "two_pass", "random_walk"}) {
        const RadianceEstimate e =
            by(technique, lamp + object, rays, {.pixels = 400, .samples = 16});
        EXPECT_NEAR(e.mean[1] / truth.mean[1], 1., 0.05) << technique;
    }
}

TEST_F(RoughBoundaries, MirrorTheirLobeAlone) {
    // An object that absorbs all that enters: what is left is the reflection of the facets.
    const std::string black = matter(1e-6, 50);
    for (const char* technique : {"brdf", "random_walk", "surface"}) {
        const RadianceEstimate e =
            by(technique, xml::constant_light() + slab(5, rough(0.3) + black),
               onto_the_middle({0, 0, 1}, 1), {.pixels = 400, .samples = 64});
        EXPECT_NEAR(e.mean[1], rough_reflectance(Ggx<double>{0.3, 0.3}, {0., 0., 1.}, 1.5),
                    4.5 * e.error[1] + 1e-4)
            << technique;
    }
}

TEST_F(RoughBoundaries, MustBeEquallyRoughEverywhere) {
    const std::string refusal =
        "technique 'brdf' has nothing to do: no shape has a homogeneous medium inside behind a "
        "dielectric boundary, smooth or equally rough everywhere, without dispersion or tint";
    const std::string uneven =
        "<bsdf type=\"roughdielectric\"><texture type=\"checkerboard\" name=\"alpha\">" +
        xml::number("color0", 0.1) + xml::number("color1", 0.4) + "</texture></bsdf>";
    const std::string tinted =
        xml::bsdf("roughdielectric", xml::rgb("specular_transmittance", {1, 0.5, 0.5}));
    for (const std::string& boundary : {uneven, tinted})
        EXPECT_EQ(error_of([&] {
                      by("brdf",
                         xml::constant_light() + xml::sphere({}, 1, boundary + matter(1, 0)),
                         ray_bundle({0, 0, 9}, {0, 0, -1}, 0.5f), {});
                  }),
                  refusal);
}

}  // namespace
}  // namespace nacre
