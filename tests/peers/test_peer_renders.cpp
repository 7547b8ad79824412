// One scene of closed forms, rendered by nacre and by every peer on this machine.
//
// A plane of albedo 1/2 at z = 0 is seen from z = 10. Each channel of light has a use of its own:
//   red    a sky of radiance 1 and a ball of the same: the plane shows 1/2 (white furnace)
//   green  a point of intensity 20 at (0, 0, 2) and a sun of irradiance 2 at 45 degrees
//   blue   the ball, radius 1 at (6, 0, 4), of radiance 40: irradiance pi L (r / d)^2 cos
// A shining square at the upper left says which way the picture is round, and an absorbing cube of
// side 0.2 close to the lens, at the lower right, what a medium's numbers mean.
#include <gtest/gtest.h>

#include <cmath>

#include "nacre/peers/peer.h"
#include "nacre/render/render.h"
#include "tests/scene/scene_files.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

constexpr int width = 32, height = 24;
constexpr double half_width = 4;  // of the plane in view

const char* const closed_forms = R"(<scene version="3.0.0">
    <integrator type="volpath"/>
    <sensor type="perspective">
        <float name="fov" value="43.60281897270362"/><string name="fov_axis" value="x"/>
        <transform name="to_world"><lookat origin="0, 0, 10" target="0, 0, 0" up="0, 1, 0"/></transform>
        <sampler type="independent"/>
        <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="24"/><rfilter type="box"/></film>
    </sensor>
    <emitter type="constant"><rgb name="radiance" value="1, 0, 0"/></emitter>
    <emitter type="point"><point name="position" x="0" y="0" z="2"/><rgb name="intensity" value="0, 20, 0"/></emitter>
    <emitter type="directional"><vector name="direction" x="1" y="0" z="-1"/><rgb name="irradiance" value="0, 2, 0"/></emitter>
    <shape type="sphere"><point name="center" x="6" y="0" z="4"/><emitter type="area"><rgb name="radiance" value="1, 0, 40"/></emitter></shape>
    <shape type="rectangle"><transform name="to_world"><scale value="100"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.5, 0.5, 0.5"/></bsdf></shape>
    <shape type="rectangle"><transform name="to_world"><scale value="0.5"/><translate x="-3.5" y="2.5" z="0.001"/></transform>
        <emitter type="area"><rgb name="radiance" value="3, 4, 5"/></emitter></shape>
    <shape type="cube"><transform name="to_world"><scale value="0.1"/><translate x="0.2" y="-0.15" z="9"/></transform>
        <bsdf type="null"/>
        <medium type="homogeneous" name="interior"><rgb name="sigma_t" value="1, 0.4, 0.2"/><float name="scale" value="5"/><rgb name="albedo" value="0, 0, 0"/></medium></shape>
</scene>)";

/// What the plane shows at (x, y).
Vec3d plane_at(double x, double y) {
    const double point2 = x * x + y * y + 4, ball2 = (x - 6) * (x - 6) + y * y + 16;
    return {0.5, 0.5 / pi * (20 * 2 / std::pow(point2, 1.5) + 2 * std::sqrt(0.5)),
            0.5 * 40 * 4 / std::pow(ball2, 1.5)};
}

/// The mean over the pixels of a block, of the plane alone, of what `value` says of each.
template <class F>
Vec3d block_mean(int x0, int y0, int columns, int rows, F&& value) {
    Vec3d sum{};
    int count = 0;
    for (int y = y0; y < y0 + rows; ++y)
        for (int x = x0; x < x0 + columns; ++x) {
            const bool square = x < 4 && y < 4, cube = x >= 18 && y >= 14;
            if (square || cube) continue;
            sum += value(x, y);
            ++count;
        }
    return sum / double(std::max(count, 1));
}

void expect_closed_forms(const Image& picture) {
    ASSERT_EQ(picture.width, width);
    ASSERT_EQ(picture.height, height);
    constexpr double pixel = 2 * half_width / width;
    const auto seen = [&](int x, int y) { return Vec3d(picture.rgb(x, y)); };
    const auto expected = [&](int x, int y) {
        return plane_at((x + 0.5) * pixel - half_width, 3 - (y + 0.5) * pixel);
    };
    const auto compare = [&](int x, int y, int columns, int rows, double tolerance) {
        const Vec3d is = block_mean(x, y, columns, rows, seen),
                    should = block_mean(x, y, columns, rows, expected);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(is[c] / should[c], 1, tolerance) << x << ' ' << y << " channel " << c;
    };
    // One of five lights is drawn for each sample: 512 of them leave 0.3 % of noise in the whole
    // and 1 to 2 % in a block.
    compare(0, 0, width, height, 0.015);
    for (int y = 0; y < 16; y += 8)
        for (int x = 0; x < width; x += 8) compare(x, y, 8, 8, 0.08);
    // The square covers x -4 to -3, y 2 to 3: the first four pixels of the first four rows.
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.at(x, y, c), 3 + c, 0.05);
    // Through the middle of the cube, 0.2 thick, the plane is seen at (2, -1.5).
    const double length = 0.2 * std::sqrt(1 + 0.04 + 0.0225);
    const Vec3d through = (seen(23, 17) + seen(24, 17) + seen(23, 18) + seen(24, 18)) * 0.25,
                plain =
                    (expected(23, 17) + expected(24, 17) + expected(23, 18) + expected(24, 18)) *
                    0.25;
    const double sigma_t[] = {5, 2, 1};
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(through[c] / plain[c], std::exp(-sigma_t[c] * length), 0.1) << c;
}

class PeerRenders : public SceneFiles {
  protected:
    void expect_peer(const char* name) {
        const PeerDescription& peer = peers().find(name);
        if (!peer.find({}))
            GTEST_SKIP() << peer.title << " is not installed: " << peer.how_to_install;
        const auto file = write("scene.xml", closed_forms);
        const Scene scene = load_scene(file);
        PeerRequest request{.scene = scene};
        request.scene_file = file;
        request.samples = 512;
        request.seed = 1;
        request.folder = folder_ / "job";
        const PeerResult result = peer.run(request);
        expect_closed_forms(result.picture);
        EXPECT_GT(result.seconds, 0);
        EXPECT_GT(result.wall_seconds, result.seconds);
        EXPECT_GT(result.peak_mb, 10);
        EXPECT_FALSE(result.version.empty());
        EXPECT_NE(result.command.find("job/"), std::string::npos);
        substitutions_ = result.substitutions;
    }
    std::vector<std::string> substitutions_;
};

TEST_F(PeerRenders, NacreShowsTheClosedForms) {
    Scene scene = load_scene(write("scene.xml", closed_forms));
    scene.sampler.samples = 512;
    const Film film = render(scene).film;
    Image picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) picture.at(x, y, c) = film.mean(x, y)[std::size_t(c)];
    expect_closed_forms(picture);
}

TEST_F(PeerRenders, CyclesShowsTheClosedForms) { expect_peer("cycles"); }

TEST_F(PeerRenders, MitsubaShowsTheClosedForms) {
    expect_peer("mitsuba");
    EXPECT_TRUE(substitutions_.empty());
}

}  // namespace
}  // namespace nacre
