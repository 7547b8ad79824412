// Proposals of guided exits: they are drawn with the density that they claim.
#include "nacre/render/volume_path_tracer.h"
#include "tests/render/render_fixture.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

class ExitGuideTest : public RenderTest {
  protected:
    Scene lit_ball(const std::string& lights, const std::string& boundary = xml::dielectric(1.4)) {
        return scene(
            xml::integrator("volpath") + lights +
            xml::sphere({}, 1,
                        boundary + xml::medium("interior", xml::number("sigma_t", 5) +
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

/// The first shape that holds a medium.
std::uint32_t shape_of(const Scene& scene) {
    const auto found = std::ranges::find_if(
        scene.shapes, [](const ShapeBinding& s) { return s.interior != nullptr; });
    return std::uint32_t(found - scene.shapes.begin());
}

bool is_active(const VolumePathTracer::Piece& piece) {
    return std::ranges::any_of(piece.guides, &ExitGuide::active);
}

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
    const std::string smooth = xml::dielectric(1.4), rough = xml::rough_dielectric(1.4, 0.2);
    const std::string window = window_sky({30, 20, 10});
    const std::string point =
        "<emitter type=\"point\"><point name=\"position\" x=\"0.5\" "
        "y=\"1\" z=\"-3\"/></emitter>";
    struct Case {
        std::string name, lights, boundary;
    };
    const std::vector<Case> cases{
        {"square", square({0, 0, -3}, 1.5), smooth},
        {"oblique square", square({1.5, 0.5, -2}, 1, "<rotate x=\"1\" y=\"1\" angle=\"20\"/>"),
         smooth},
        {"ball", ball({0.5, 1, -2.5}, 1), smooth},
        {"three", square({0, 0, -3}, 1) + ball({0.5, 3, -1.5}, 1) + ball({-3, 0, -1}, 1.2), smooth},
        {"window", window, smooth},
        {"window and ball", window + ball({0.5, 3, -1.5}, 1), smooth},
        {"square, rough", square({0, 0, -3}, 1.5), rough},
        {"window and point, rough", window + point, rough}};
    int proposals_seen = 0;
    for (const auto& [name, lights, boundary] : cases) {
        const Scene s = lit_ball(lights, boundary);
        const VolumePathTracer tracer(s);
        const auto& piece = tracer.piece(shape_of(s), true);
        ASSERT_TRUE(is_active(piece)) << name;
        for (const Point3f y :
             {Point3f(0, 0, -0.9f), Point3f(0.3f, 0.2f, -0.8f), Point3f(0, 0.6f, -0.6f)}) {
            const auto cell = piece.grid.locate(y);
            ASSERT_GE(cell.guide, 0) << name;
            const ExitGuide::Proposal proposal = piece.proposal(y, cell.guide);
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
                expected[c] = any ? n * mean_over(c, 64) * 4 * pi / cells.count : 0;
                total += expected[c];
            }
            // The density misses what fails, and only that.
            EXPECT_NEAR(total / n, double(drawn) / n, 4e-3) << name;
            EXPECT_TRUE(test::chi_square_passes(observed, expected)) << name;
        }
    }
    EXPECT_GE(proposals_seen, 16);
}

// Below a smooth boundary nothing is aimed at that cannot be met by chance; an even sky is met well
// enough, however it is given.
TEST_F(ExitGuideTest, IsActiveWhereThereIsALightToAimAt) {
    const auto active = [&](const Scene& s) {
        return is_active(VolumePathTracer(s).piece(shape_of(s), true));
    };
    EXPECT_TRUE(active(lit_ball(ball({0, 0, 4}, 1))));
    EXPECT_FALSE(active(lit_ball(xml::constant_light())));
    EXPECT_FALSE(active(lit_ball("<emitter type=\"point\"/>")));
    EXPECT_FALSE(active(lit_ball(two_skies({1, 1, 1}, {1, 1, 1}))));
    EXPECT_TRUE(active(lit_ball(window_sky({30, 20, 10}))));
    const std::string rough = xml::rough_dielectric(1.4, 0.2);
    EXPECT_TRUE(active(lit_ball(ball({0, 0, 4}, 1), rough)));
    EXPECT_TRUE(
        active(lit_ball("<emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"3\" "
                        "z=\"0\"/></emitter>",
                        rough)));
    EXPECT_FALSE(active(lit_ball(xml::constant_light(), rough)));
    // Light that shines inside, where straight connections can be made.
    EXPECT_FALSE(active(lit_ball(ball({0, 0, 0}, 0.2))));
}

}  // namespace
}  // namespace nacre
