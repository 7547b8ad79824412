// Proposals of guided exits: they are drawn with the density that they claim.
#include "nacre/render/volume_path_tracer.h"
#include "tests/render/render_fixture.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

class ExitGuideTest : public RenderTest {
  protected:
    Scene lit_ball(const std::string& lights) {
        return scene(xml::integrator("volpath") + lights +
                     xml::sphere({}, 1,
                                 xml::dielectric(1.4) +
                                     xml::medium("interior", xml::number("sigma_t", 5) +
                                                                 xml::number("albedo", 0.9))));
    }
    static std::string square(const Vec3d& at, double half, const std::string& turn = "") {
        return xml::shape("rectangle",
                          fmt::format("<transform name=\"to_world\"><scale value=\"{}\"/>{}"
                                      "<translate x=\"{}\" y=\"{}\" z=\"{}\"/></transform>",
                                      half, turn, at.x, at.y, at.z) +
                              xml::area_light({4, 4, 4}));
    }
    static std::string ball(const Vec3d& at, double radius) {
        return xml::sphere(at, radius, xml::area_light({4, 4, 4}));
    }
};

/// Directions about `frame` in cells of equal solid angle.
struct DirectionCells {
    static constexpr int rings = 60, sectors = 40, count = rings * sectors;
    Framef frame;
    int of(const Vec3f& d) const {
        const Vec3f l = frame.to_local(d);
        const double phi = std::atan2(l.y, l.x) / (2 * pi) + 0.5;
        const int ring = std::clamp(int((1 - l.z) / 2 * rings), 0, rings - 1);
        return ring * sectors + std::clamp(int(phi * sectors), 0, sectors - 1);
    }
    Vec3f direction(int cell, double u, double v) const {
        const double z = 1 - 2 * (cell / sectors + u) / rings;
        const double phi = 2 * pi * ((cell % sectors + v) / sectors - 0.5);
        const double s = std::sqrt(std::max(0., 1 - z * z));
        return frame.to_world({float(s * std::cos(phi)), float(s * std::sin(phi)), float(z)});
    }
};

TEST_F(ExitGuideTest, SamplesFollowTheirDensity) {
    const std::map<std::string, std::string> lights{
        {"square", square({0, 0, -3}, 1.5)},
        {"oblique square", square({1.5, 0.5, -2}, 1, "<rotate x=\"1\" y=\"1\" angle=\"20\"/>")},
        {"ball", ball({0.5, 1, -2.5}, 1)},
        {"three", square({0, 0, -3}, 1) + ball({0.5, 3, -1.5}, 1) + ball({-3, 0, -1}, 1.2)}};
    int proposals_seen = 0;
    for (const auto& [name, text] : lights) {
        const Scene s = lit_ball(text);
        const VolumePathTracer tracer(s);
        const auto& info = tracer.info(s.media.front().get());
        ASSERT_TRUE(info.guide.active()) << name;
        for (const Point3f y :
             {Point3f(0, 0, -0.9f), Point3f(0.3f, 0.2f, -0.8f), Point3f(0, 0.6f, -0.6f)}) {
            const auto cell = info.grid.locate(y);
            ASSERT_GE(cell.guide, 0) << name;
            const ExitGuide::Proposal proposal = info.guide.at(y, cell.guide);
            ASSERT_GE(proposal.probability(), 0.f);
            ASSERT_LE(proposal.probability(), 1.f);
            if (!(proposal.probability() > 0.f)) continue;
            ++proposals_seen;
            // Poles of the cells off the directions of interest, where cells are thin.
            const DirectionCells cells{Framef::around(normalize(Vec3f(1, 0.3f, 0.2f)))};
            std::vector<double> observed(cells.count), expected(cells.count);
            constexpr int n = 50000;
            Random random(31);
            int drawn = 0;
            for (int i = 0; i < n; ++i)
                if (const auto d = proposal.sample(random)) {
                    ASSERT_NEAR(length(*d), 1.f, 1e-5f);
                    ASSERT_GT(proposal.pdf(*d), 0.f);
                    ++observed[cells.of(*d)];
                    ++drawn;
                }
            // The density over each cell, by jittered directions: few to find where it is zero.
            const auto mean_over = [&](int cell, int side) {
                double sum = 0;
                for (int k = 0; k < side * side; ++k)
                    sum += proposal.pdf(cells.direction(cell, (k % side + random.next()) / side,
                                                        (k / side + random.next()) / side));
                return sum / (side * side);
            };
            double total = 0;
            for (int c = 0; c < cells.count; ++c) {
                const bool any = observed[c] > 0 || mean_over(c, 8) > 0;
                expected[c] = any ? n * mean_over(c, 96) * 4 * pi / cells.count : 0;
                total += expected[c];
            }
            // The density misses what fails, and only that.
            EXPECT_NEAR(total / n, double(drawn) / n, 4e-3) << name;
            EXPECT_TRUE(test::chi_square_passes(observed, expected)) << name;
        }
    }
    EXPECT_GE(proposals_seen, 8);
}

// At most the strongest four lights are aimed at, and none of what cannot be met by chance.
TEST_F(ExitGuideTest, IsActiveForAreaLightsBehindSmoothBoundariesOnly) {
    const auto active = [&](const Scene& s) {
        return VolumePathTracer(s).info(s.media.front().get()).guide.active();
    };
    EXPECT_TRUE(active(lit_ball(ball({0, 0, 4}, 1))));
    EXPECT_FALSE(active(lit_ball(xml::constant_light())));
    EXPECT_FALSE(active(lit_ball("<emitter type=\"point\"/>")));
    // Light that shines inside, where straight connections can be made.
    EXPECT_FALSE(active(lit_ball(ball({0, 0, 0}, 0.2))));
}

}  // namespace
}  // namespace nacre
