// The suite's scenes are what their words say.
#include "nacre/compare/suite.h"

#include "nacre/compare/experiment.h"
#include "nacre/compare/suite_objects.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/scene/content_key.h"
#include "tests/metrics/pictures_fixture.h"

namespace nacre::test {
namespace {

const Medium& matter(const Scene& s) {
    return **std::ranges::find_if(s.media, [&](const MediumPtr& m) {
        return std::ranges::any_of(s.shapes,
                                   [&](const ShapeBinding& b) { return b.interior == m.get(); });
    });
}

}  // namespace

TEST(Suite, HasSixtyCases) {
    const auto all = suite_cases();
    EXPECT_EQ(all.size(), 60u);
    std::set<std::string> ids;
    for (const SuiteCase& c : all) {
        ids.insert(c.id());
        EXPECT_EQ(c.labels().size(), 4u);
    }
    EXPECT_EQ(ids.size(), 60u);
    EXPECT_EQ(suite_cases("ball").size(), 12u);
    EXPECT_EQ(suite_cases("ball,bust,front").size(), 8u);
    EXPECT_EQ(suite_cases("sheet,low,veined,back").size(), 1u);
    EXPECT_EQ(error_of([] { suite_cases("ball,cube"); }),
              "the suite has no 'cube'; its words are: ball, sheet, bowl, bust, slab, high, low, "
              "homogeneous, veined, front, side, back");
}

TEST(Suite, ObjectsAreSolidAndFitTheirSphere) {
    for (const char* name : {"ball", "sheet", "bowl", "bust", "slab"}) {
        const auto mesh = make_suite_object(name);
        const MeshReport r = inspect(*mesh);
        EXPECT_TRUE(r.solid()) << name;
        EXPECT_FALSE(r.inside_out()) << name;
        EXPECT_EQ(r.components, 1u) << name;
        float most = 0;
        for (const Point3f& p : mesh->positions) most = std::max(most, length(p));
        EXPECT_LE(most, 30.f) << name;
        EXPECT_GE(most, 20.f) << name;
    }
}

/// Volume over half the area. The field of the waved sheet is not a distance: across the wave,
/// whose slope is up to 0.8, it is thinner by the cosine; 0.4 is its mean.
TEST(Suite, TheSheetIsThin) {
    const auto mesh = make_suite_object("sheet");
    double volume = 0, area = 0;
    for (const auto& t : mesh->triangles) {
        const Vec3d a(mesh->positions[t[0]]), b(mesh->positions[t[1]]), c(mesh->positions[t[2]]);
        volume += dot(a, cross(b, c)) / 6;
        area += length(cross(b - a, c - a)) / 2;
    }
    EXPECT_NEAR(volume / (area / 2), 2 * std::cos(std::atan(0.4)), 0.25);
}

TEST(Suite, VeinsAreATenthAsDense) {
    Scene s = make_suite_scene({"ball", "high", "veined", "front"}, 16, 16);
    const Medium& m = matter(s);
    ASSERT_TRUE(m.sigma_t_volume);
    const Wavelengths w = Wavelengths::rgb_bands();
    double least = 1e9, most = 0, sum = 0;
    int n = 0;
    for (float z = -24; z <= 24; z += 1.5f)
        for (float y = -24; y <= 24; y += 1.5f)
            for (float x = -24; x <= 24; x += 1.5f) {
                const double v = m.sigma_t_volume->eval({x, y, z}, w)[1];
                least = std::min(least, v), most = std::max(most, v), sum += v, ++n;
            }
    // The measured marble's green band is 2.62 + 0.0041 a mm; the ground a quarter of it.
    EXPECT_NEAR(most, 2.6241 / 4, 1e-3);
    EXPECT_NEAR(most / least, 10, 0.2);
    const Scene even = make_suite_scene({"ball", "high", "veined", "front"}, 16, 16, true);
    ASSERT_TRUE(matter(even).homogeneous());
    EXPECT_NEAR(matter(even).sigma_t->eval(w)[1], sum / n, 0.05 * sum / n);
    EXPECT_EQ(s.shapes.size(), even.shapes.size());
}

TEST(Suite, CasesAreToldApartAndShowTheirObject) {
    std::set<std::string> keys;
    for (const SuiteCase& c : suite_cases("slab")) {
        Scene s = make_suite_scene(c, 24, 24);
        keys.insert(content_key(s));
        bool object_only = false;
        const PixelMask mask = translucent_pixels(s, object_only);
        EXPECT_TRUE(object_only) << c.id();
        EXPECT_GT(mask.count(24, 24), 60u) << c.id();
    }
    EXPECT_EQ(keys.size(), 12u);
}

}  // namespace nacre::test
