// What is known before a path is traced: choice of lights, distances to surfaces, bounds of
// extinction.
#include <set>

#include "nacre/render/distance_grid.h"
#include "nacre/render/light_chooser.h"
#include "nacre/render/majorant_grid.h"
#include "tests/geometry/shapes.h"
#include "tests/render/render_fixture.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

Point3f random_point(Random& random, const Box3f& box) {
    const Vec2f a = random.next2(), b = random.next2();
    return box.lower + box.diagonal() * Vec3f(a.x, a.y, b.x);
}

using BoundsTest = RenderTest;

// Few lights, which are ranked by distance; and many, which are not.
TEST_F(BoundsTest, LightsAreChosenAsOftenAsClaimed) {
    for (const int many : {3, 60}) {
        std::string text = xml::constant_light(0.2) + "<emitter type=\"point\"/>";
        for (int i = 0; i < many; ++i)
            text += xml::sphere({3. * i, 2, 1}, 0.3 + 0.1 * (i % 4), xml::area_light({1, 2, 3}));
        // Black: never worth a sample.
        text += xml::sphere({0, -5, 0}, 1, xml::area_light({0, 0, 0}));
        const Scene s = scene(text);
        const LightChooser chooser(s.lights, s.rays.bounds());
        for (const Point3f from : {Point3f(0, 0, 0), Point3f(6, 1.7f, 1), Point3f(-50, 3, 8)}) {
            double total = 0;
            std::map<const Light*, double> claimed, found;
            for (const LightPtr& light : s.lights) {
                claimed[light.get()] = chooser.probability(from, light.get());
                total += claimed[light.get()];
                EXPECT_EQ(claimed[light.get()] > 0, light->power() > 0.f);
            }
            EXPECT_NEAR(total, 1, 1e-5);
            // Evenly spaced numbers find each light in proportion.
            constexpr int n = 100000;
            for (int i = 0; i < n; ++i) {
                const auto choice = chooser.choose(from, (float(i) + 0.5f) / n);
                ASSERT_NE(choice.light, nullptr);
                found[choice.light] += 1. / n;
                ASSERT_EQ(choice.probability, chooser.probability(from, choice.light));
            }
            for (const auto& [light, p] : claimed) EXPECT_NEAR(found[light], p, 3e-5);
        }
    }
}

// The same random number must find the same light in every run, wherever the lights lie in memory.
TEST_F(BoundsTest, LightsAreChosenInTheOrderOfTheScene) {
    const Scene s = scene(xml::sphere({0, 2, 1}, 0.3, xml::area_light({1, 2, 3})) +
                          xml::sphere({3, 2, 1}, 0.3, xml::area_light({1, 2, 3})) +
                          xml::sphere({6, 2, 1}, 0.3, xml::area_light({1, 2, 3})));
    std::vector<LightPtr> lights = s.lights;
    std::ranges::sort(lights);  // by address
    do {
        const LightChooser chooser(lights, s.rays.bounds());
        EXPECT_EQ(chooser.choose({0, 0, 0}, 0.f).light, lights.front().get());
        EXPECT_EQ(chooser.choose({0, 0, 0}, 0.9999999f).light, lights.back().get());
    } while (std::ranges::next_permutation(lights).found);
}

TEST_F(BoundsTest, WithoutLightsNoneIsChosen) {
    const Scene s = scene(xml::sphere({}, 1, ""));
    const LightChooser chooser(s.lights, s.rays.bounds());
    EXPECT_EQ(chooser.choose({0, 0, 0}, 0.5f).light, nullptr);
    EXPECT_EQ(chooser.probability({0, 0, 0}, nullptr), 0.f);
}

TEST_F(BoundsTest, ClearanceIsALowerBoundOfTheDistance) {
    const Scene s =
        scene(xml::sphere({}, 1, "") + xml::sphere({0.3, 0, 0}, 0.2, "") +
              xml::shape("cube",
                         "<transform name=\"to_world\"><scale x=\"0.2\" y=\"0.9\" z=\"0.1\"/>"
                         "<rotate x=\"1\" y=\"2\" angle=\"33\"/></transform>"));
    for (const auto& [cell, most] : {std::pair{0.02f, 192}, {0.001f, 50}, {0.5f, 192}}) {
        Box3f box;
        box.extend(Point3f(-1, -1, -1));
        box.extend(Point3f(1, 1, 1));
        const DistanceGrid grid(s.rays, box, cell, most);
        EXPECT_GE(grid.cell_size(), cell);
        EXPECT_LE(grid.cell_count(), std::size_t(most) * most * most);
        Random random(5);
        double used = 0;
        for (int i = 0; i < 20000; ++i) {
            const Point3f p = random_point(random, box);
            const auto place = grid.locate(p);
            ASSERT_FALSE(place.outside);
            const float distance = s.rays.distance(p, 10.f);
            ASSERT_LE(place.clearance, distance + 1e-6f);
            // Tight to two half diagonals of a cell, or to a factor of three deep inside.
            ASSERT_GE(place.clearance, distance / 3 - 2.01f * grid.half_diagonal());
            used += place.clearance > 0.3f * distance;
        }
        if (cell == 0.02f) {
            EXPECT_GT(used, 0.5 * 20000);
        }
        EXPECT_TRUE(grid.locate({5, 0, 0}).outside);
        EXPECT_TRUE(grid.locate({0, -1.f - 3 * grid.cell_size(), 0}).outside);
    }
    EXPECT_FALSE(DistanceGrid().locate({5, 0, 0}).outside);
    EXPECT_EQ(DistanceGrid().locate({5, 0, 0}).clearance, 0.f);
}

// Pieces of a ray are in order, without gaps inside the volume, and bound what is in them; outside
// of them is nothing.
TEST_F(BoundsTest, MajorantsBoundTheExtinctionAlongRays) {
    write_vol("b.vol", 17, 3, [](int x, int y, int z, int c) {
        return (x * 31 + y * 17 + z * 7 + c * 3) % 23 == 0 ? 9. : 0.1 * c + 0.02 * x;
    });
    const Scene s =
        scene(xml::constant_light() +
              xml::sphere({}, 5,
                          xml::bsdf("null") + "<medium name=\"interior\" type=\"heterogeneous\">" +
                              xml::number("scale", 2) +
                              "<volume name=\"sigma_t\" type=\"gridvolume\">"
                              "<string name=\"filename\" value=\"b.vol\"/>"
                              "<transform name=\"to_world\"><translate x=\"-0.5\" y=\"-0.5\" "
                              "z=\"-0.5\"/><scale x=\"2\" y=\"3\" z=\"4\"/>"
                              "<rotate y=\"1\" angle=\"25\"/></transform></volume></medium>"));
    const Medium& medium = *s.media.front();
    const MajorantGrid grid(medium);
    ASSERT_FALSE(grid.empty());
    const Wavelengths rgb = Wavelengths::rgb_bands();
    Random random(6);
    Box3f around;
    around.extend(Point3f(-3, -3, -3));
    around.extend(Point3f(3, 3, 3));
    int inside = 0;
    for (int i = 0; i < 1000; ++i) {
        Vec3f d = test::random_direction(random);
        // Along the axes, too, where the traversal divides by zero.
        if (i % 10 == 0) d = Vec3f(float(i % 3 == 0), float(i % 3 == 1), float(i % 3 == 2));
        const Ray ray{random_point(random, around), d};
        const float end = 8.f * random.next();
        MajorantSegments segments(grid, medium, ray, end, rgb);
        std::vector<MajorantSegments::Segment> pieces;
        while (const auto piece = segments.next()) pieces.push_back(*piece);
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            ASSERT_LE(pieces[k].begin, pieces[k].end);
            ASSERT_GE(pieces[k].begin, 0.f);
            ASSERT_LE(pieces[k].end, end);
            if (k > 0) {
                ASSERT_NEAR(pieces[k].begin, pieces[k - 1].end, 1e-5f);
            }
        }
        for (int k = 0; k < 200; ++k) {
            const float t = end * random.next();
            const auto piece = std::find_if(pieces.begin(), pieces.end(), [&](const auto& p) {
                return t >= p.begin && t <= p.end;
            });
            const float bound = piece == pieces.end() ? 0.f : piece->majorant;
            const Spectral sigma = medium.coefficients(ray.o + ray.d * t, rgb).sigma_t;
            // Points within rounding of a border may be counted to the wrong side.
            bool near_border = false;
            for (const auto& p : pieces)
                near_border |= std::abs(t - p.begin) < 1e-4f || std::abs(t - p.end) < 1e-4f;
            if (near_border) continue;
            for (int c = 0; c < 3; ++c) ASSERT_LE(sigma[c], bound * 1.00001f + 1e-6f) << i;
            inside += sigma[0] > 0.f;
        }
    }
    EXPECT_GT(inside, 10000);
}

// What does not vary in space has one bound for the whole ray.
TEST_F(BoundsTest, OneBoundWhereExtinctionIsConstant) {
    const Scene s = scene(
        xml::constant_light() +
        xml::sphere({}, 1,
                    xml::bsdf("null") + xml::medium("interior", xml::rgb("sigma_t", {1, 4, 2}))));
    const Medium& medium = *s.media.front();
    const MajorantGrid grid(medium);
    EXPECT_TRUE(grid.empty());
    MajorantSegments segments(grid, medium, {{0, 0, 0}, {0, 0, 1}}, 3.f, Wavelengths::rgb_bands());
    const auto piece = segments.next();
    ASSERT_TRUE(piece.has_value());
    EXPECT_EQ(piece->begin, 0.f);
    EXPECT_EQ(piece->end, 3.f);
    EXPECT_EQ(piece->majorant, 4.f);
    EXPECT_FALSE(segments.next().has_value());
}

}  // namespace
}  // namespace nacre
