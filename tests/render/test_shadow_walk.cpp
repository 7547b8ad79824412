// The way of shadow rays through surfaces that let light pass straight on.
#include "nacre/render/shadow_walk.h"

#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

class ShadowWalk : public RenderTest {
  protected:
    static std::string mask(double radius, double opacity) {
        return xml::sphere(
            {}, float(radius),
            xml::bsdf("mask", xml::number("opacity", opacity) + xml::bsdf("diffuse")));
    }
    static std::string wall(double radius) {
        return xml::sphere({}, float(radius), xml::bsdf("diffuse"));
    }
};

// Shells around the origin that let 0.7 and 0.5 pass, and an opaque one.
TEST_F(ShadowWalk, KeepsTheProductUpToTheLight) {
    const Scene s = scene(mask(1, 0.3) + mask(2, 0.5) + wall(4));
    EXPECT_TRUE(has_null_surfaces(s));
    const Wavelengths w = Wavelengths::rgb_bands();
    const Vec3f d = normalize(Vec3f{0.3f, -0.5f, 0.8f});
    struct Case {
        float distance;
        double kept;
        std::uint64_t rays;
    };
    // A light on the opaque shell itself is seen; one at infinity is not.
    for (const Case& c :
         {Case{0.f, 1., 0}, Case{0.5f, 1., 1}, Case{1.5f, 0.7, 2}, Case{3.f, 0.35, 3},
          Case{4.f, 0.35, 3}, Case{4.1f, 0., 3}, Case{1e30f, 0., 3}}) {
        RayCounts counts;
        const Spectral kept = surface_transmittance(s, true, {{}, d, c.distance}, w, counts);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(kept[i], c.kept, 1e-6) << c.distance;
        EXPECT_EQ(counts.rays, c.rays) << c.distance;
    }
}

TEST_F(ShadowWalk, NeedsOneRayWhereNothingLetsPass) {
    const Scene s = scene(wall(1) + wall(2));
    EXPECT_FALSE(has_null_surfaces(s));
    const Wavelengths w = Wavelengths::rgb_bands();
    for (const auto& [distance, kept] :
         {std::pair{0.9f, 1.f}, {1.f, 1.f}, {1.5f, 0.f}, {3.f, 0.f}}) {
        RayCounts counts;
        EXPECT_EQ(surface_transmittance(s, false, {{}, {0, 0, 1}, distance}, w, counts)[1], kept);
        EXPECT_EQ(counts.rays, 1u);
    }
}

}  // namespace
}  // namespace nacre
