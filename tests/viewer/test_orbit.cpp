#include <cmath>

#include "apps/viewer/orbit.h"
#include "tests/viewer/scenes.h"

namespace nacre::test {
namespace {

using viewer::Compass;
using viewer::OrbitCamera;

/// Where a camera shows a point: shares of the film's width and height from its left top.
Vec2f place_on_film(const Camera& camera, const Vec3d& p) {
    double x = 0.5, y = 0.5;
    for (int i = 0; i < 60; ++i) {  // the ray that goes there, by Newton's method
        const auto miss = [&](double u, double v) {
            const Ray ray = camera.ray({float(u), float(v)}, {0.5f, 0.5f});
            const Vec3d to = p - Vec3d(ray.o), d(ray.d);
            return to - d * dot(to, d);
        };
        const double h = 0.02;
        const Vec3d m = miss(x, y), dx = (miss(x + h, y) - m) / h, dy = (miss(x, y + h) - m) / h;
        const double a = dot(dx, dx), b = dot(dx, dy), c = dot(dy, dy), e = -dot(dx, m),
                     f = -dot(dy, m), det = a * c - b * b;
        x += (e * c - b * f) / det;
        y += (a * f - b * e) / det;
    }
    return {float(x), float(y)};
}

TEST(OrbitCamera, IsTheScenesOwnUntilItMoves) {
    const auto scene = ball();
    const OrbitCamera orbit(scene.scene, scene.object);
    for (const Vec2f at : {Vec2f{0, 0}, Vec2f{0.3f, 0.9f}, Vec2f{1, 0.5f}}) {
        const Ray own = scene.scene.camera->ray(at, {0.5f, 0.5f}),
                  seen = orbit.camera(1)->ray(at, {0.5f, 0.5f});
        EXPECT_EQ(own.o, seen.o);
        EXPECT_EQ(own.d, seen.d);
        EXPECT_EQ(own.tmin, seen.tmin);
    }
}

TEST(OrbitCamera, TurnsAboutTheObject) {
    const auto scene = ball();
    OrbitCamera orbit(scene.scene, scene.object);
    const double distance = length(orbit.eye() - orbit.middle());
    const auto before = orbit.compass().angles(orbit.eye() - orbit.middle());
    EXPECT_NEAR(before.first, 28, 1e-4);  // of the stage
    EXPECT_NEAR(before.second, 14, 1e-4);
    orbit.turn(50, 20);
    const auto after = orbit.compass().angles(orbit.eye() - orbit.middle());
    EXPECT_NEAR(after.first, 78, 1e-4);
    EXPECT_NEAR(after.second, 34, 1e-4);
    EXPECT_NEAR(length(orbit.eye() - orbit.middle()), distance, 1e-5 * distance);
    // Its middle stays in the middle of the picture.
    const Vec2f at = place_on_film(*orbit.camera(1), orbit.middle());
    EXPECT_NEAR(at.x, 0.5, 1e-4);
    EXPECT_NEAR(at.y, 0.5, 1e-4);
}

TEST(OrbitCamera, StopsBeforeItWouldGoOverTheTop) {
    const auto scene = ball();
    OrbitCamera orbit(scene.scene, scene.object);
    for (int i = 0; i < 10; ++i) orbit.turn(0, 40);
    EXPECT_NEAR(orbit.compass().angles(orbit.eye() - orbit.middle()).second, 89, 1e-3);
    for (int i = 0; i < 20; ++i) orbit.turn(10, -40);
    EXPECT_NEAR(orbit.compass().angles(orbit.eye() - orbit.middle()).second, -89, 1e-3);
}

TEST(OrbitCamera, PansByHeightsOfThePictureAndZoomsByTheDistance) {
    const auto scene = ball();
    OrbitCamera orbit(scene.scene, scene.object);
    orbit.pan(0.2, 0.1);
    const Vec2f at = place_on_film(*orbit.camera(1), orbit.middle());
    EXPECT_NEAR(at.x, 0.7, 2e-3);
    EXPECT_NEAR(at.y, 0.4, 2e-3);
    OrbitCamera near(scene.scene, scene.object);
    const double distance = length(near.eye() - near.middle());
    near.zoom(0.5);
    EXPECT_NEAR(length(near.eye() - near.middle()), 0.5 * distance, 1e-4 * distance);
}

TEST(OrbitCamera, OfParallelRaysZoomsByWhatItSees) {
    const SceneFolder folder;
    const auto scene = folder.scene(std::string(R"(<sensor type="orthographic">
        <transform name="to_world"><scale x="20" y="20"/>
            <lookat origin="0, 0, 50" target="0, 0, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/></film>
        </sensor>)") + marble_ball + lamp);
    OrbitCamera orbit(scene.scene, scene.object);
    orbit.turn(30, 0);
    const Vec3d right{std::cos(M_PI / 6), 0, -std::sin(M_PI / 6)};  // of who looks from 30 degrees
    EXPECT_NEAR(place_on_film(*orbit.camera(1), right * 10).x, 0.75, 1e-3);
    orbit.zoom(2);
    EXPECT_NEAR(place_on_film(*orbit.camera(1), right * 10).x, 0.625, 1e-3);
    orbit.pan(0.25, 0);
    EXPECT_NEAR(place_on_film(*orbit.camera(1), right * 10).x, 0.875, 1e-3);
}

TEST(OrbitCamera, LooksFromNamedSides) {
    const auto scene = ball();
    OrbitCamera orbit(scene.scene, scene.object);
    orbit.pan(1, 1);
    orbit.look_from(parse_view("right"));
    const Vec3d d = normalize(orbit.eye() - orbit.middle());
    EXPECT_NEAR(d.x, 1, 1e-6);
    orbit.look_from(parse_view("top"));
    EXPECT_NEAR(normalize(orbit.eye() - orbit.middle()).y, 1, 1e-6);
    EXPECT_NO_THROW(orbit.camera(1));
}

TEST(Compass, NamesDirectionsInScenesThatStandOnAnyAxis) {
    for (const Vec3d& up : {Vec3d{0.1, 0.9, 0.2}, Vec3d{0, 0.1, 1}, Vec3d{-1, 0.2, 0}}) {
        const Compass c = Compass::of(up);
        EXPECT_GT(dot(c.up, up), 0.8);
        EXPECT_NEAR(dot(c.front, c.up), 0, 1e-12);
        for (const auto& [a, e] : {std::pair{30., 20.}, {-120., -60.}, {179., 5.}}) {
            const auto back = c.angles(c.direction(a, e) * 3.);
            EXPECT_NEAR(back.first, a, 1e-9);
            EXPECT_NEAR(back.second, e, 1e-9);
        }
    }
    // As the stage of bare meshes has it.
    const Compass y = Compass::of({0, 1, 0});
    EXPECT_NEAR(y.direction(90, 0).x, 1, 1e-12);
    EXPECT_NEAR(y.direction(0, 0).z, 1, 1e-12);
}

}  // namespace
}  // namespace nacre::test
