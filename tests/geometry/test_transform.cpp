#include "nacre/geometry/transform.h"

#include <limits>

#include "nacre/math/error.h"

namespace nacre {
namespace {

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance = 1e-12) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Transform, QuarterTurnsFollowTheRightHand) {
    expect_near(Transform::rotate({0, 0, 1}, 90).map_point({1, 0, 0}), {0, 1, 0}, 0);
    expect_near(Transform::rotate({1, 0, 0}, 90).map_point({0, 1, 0}), {0, 0, 1}, 0);
    expect_near(Transform::rotate({0, 1, 0}, -90).map_point({1, 0, 0}), {0, 0, 1}, 0);
    expect_near(Transform::rotate({0, 0, 5}, 450).map_point({1, 0, 0}), {0, 1, 0}, 0);
}

TEST(Transform, RightFactorActsFirst) {
    const Transform t = Transform::translate({1, 0, 0}) * Transform::scale({2, 2, 2});
    expect_near(t.map_point({1, 1, 1}), {3, 2, 2});
    expect_near(t.map_vector({1, 1, 1}), {2, 2, 2});
}

TEST(Transform, InverseUndoesLongChains) {
    Transform t;
    for (int i = 0; i < 40; ++i)
        t = t * Transform::rotate({1, double(i), 2}, 17) *
            Transform::translate({0.3, -i * 0.1, 1}) * Transform::scale({1.1, 0.9, 1.05});
    expect_near(t.inverse().map_point(t.map_point({1, 2, 3})), {1, 2, 3}, 1e-10);
    const Transform one = t * t.inverse();
    for (int i = 0; i < 16; ++i) EXPECT_NEAR(one.matrix()[i], i % 5 == 0, 1e-10);
}

TEST(Transform, NormalsStayPerpendicular) {
    const Transform t = Transform::rotate({1, 2, 3}, 50) * Transform::scale({1, 5, -0.2});
    const Vec3d tangent = t.map_vector({1, 2, 0}), normal = t.map_normal({2, -1, 3});
    EXPECT_NEAR(dot(tangent, normal), 0, 1e-12);
}

TEST(Transform, KnowsMirrors) {
    EXPECT_FALSE(Transform().swaps_handedness());
    EXPECT_FALSE(Transform::rotate({1, 1, 1}, 200).swaps_handedness());
    EXPECT_TRUE(Transform::scale({1, -1, 1}).swaps_handedness());
    EXPECT_FALSE(Transform::scale({-1, -1, 1}).swaps_handedness());
    EXPECT_TRUE(Transform().is_identity());
    EXPECT_FALSE(Transform::translate({0, 0, 1e-9}).is_identity());
}

TEST(Transform, LookAtMapsTheCameraAxes) {
    const Transform t = Transform::look_at({0, 0, -5}, {0, 0, 0}, {0, 1, 0});
    expect_near(t.map_point({0, 0, 0}), {0, 0, -5});
    expect_near(t.map_vector({0, 0, 1}), {0, 0, 1});
    expect_near(t.map_vector({0, 1, 0}), {0, 1, 0});
    // left = up x forward = y x z = +x
    expect_near(t.map_vector({1, 0, 0}), {1, 0, 0});
    const Transform side = Transform::look_at({1, 2, 3}, {4, 2, 3}, {0, 0, 7});
    expect_near(side.map_vector({0, 0, 1}), {1, 0, 0});
    expect_near(side.map_vector({1, 0, 0}), {0, 1, 0});  // z x x = y
    expect_near(side.map_vector({0, 1, 0}), {0, 0, 1});
}

TEST(Transform, ProjectiveMapsDivide) {
    const Transform t(Transform::Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, -1, 0, 0, 1, 0});
    expect_near(t.map_point({2, 4, 2}), {1, 2, 1.5});
    expect_near(t.inverse().map_point({1, 2, 1.5}), {2, 4, 2});
}

TEST(Transform, SmallScalesAreNotSingular) {
    const Transform t = Transform::translate({1e6, 0, 0}) * Transform::scale({1e-9, 1e-9, 1e-9});
    expect_near(t.inverse().map_vector({1e-9, 0, 0}), {1, 0, 0});
    EXPECT_NO_THROW(Transform(t.matrix()));
}

TEST(Transform, RefusesWhatCannotBeInverted) {
    const auto message = [](auto make) {
        try {
            make();
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    const std::string singular =
        "transform is singular: it flattens space; give every axis a scale other than zero";
    EXPECT_EQ(message([] { Transform::scale({1, 0, 1}); }), singular);
    EXPECT_EQ(message([] {
                  Transform(Transform::Matrix{1, 2, 3, 0, 2, 4, 6.0000000000000001, 0, 0, 1, 1, 0,
                                              0, 0, 0, 1});
              }),
              singular);
    EXPECT_EQ(message([] {
                  Transform::translate({0, std::numeric_limits<double>::infinity(), 0});
              }),
              "transform has a value that is not a finite number; check its matrix");
    EXPECT_EQ(message([] {
                  Transform::rotate({0, 0, 0}, 3);
              }),
              "rotation axis has no length; give a vector other than zero");
    EXPECT_EQ(message([] {
                  Transform::look_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0});
              }),
              "look_at: origin and target coincide; move one of them");
    EXPECT_EQ(message([] {
                  Transform::look_at({0, 0, 0}, {0, 2, 0}, {0, 1, 0});
              }),
              "look_at: up is parallel to the viewing direction; choose another up");
}

}  // namespace
}  // namespace nacre
