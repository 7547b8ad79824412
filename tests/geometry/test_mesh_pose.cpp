// What is up and where the front is, guessed from shapes that are laid into files every way.
#include "nacre/geometry/mesh_pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nacre/geometry/figure.h"
#include "nacre/geometry/mesh_build.h"

namespace nacre {
namespace {

constexpr SignedAxis every_way[] = {{1, 1}, {2, 1}, {0, 1}, {1, -1}, {2, -1}, {0, -1}};

/// The vector of the file that `pose` turns upright into `v`.
Vec3f laid(const MeshPose& pose, const Vec3f& v) {
    Vec3f r;
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3f unit{};
        unit[i] = 1.f;
        r[i] = dot(pose.turn(unit), v);
    }
    return r;
}

Mesh laid(Mesh mesh, const MeshPose& pose) {
    for (Point3f& p : mesh.positions) p = laid(pose, p);
    return mesh;
}

MeshPose pose_with(SignedAxis up) { return {.up = up, .front = usual_front(up)}; }

Mesh scaled(Mesh mesh, const Vec3f& s) {
    for (Point3f& p : mesh.positions) p = {p.x * s.x, p.y * s.y, p.z * s.z};
    return mesh;
}

/// An egg that grows to the front, with waves there: a face. Its mirror is across x.
Mesh head(float waves = 0.06f) {
    Mesh mesh = make_icosphere(5);
    for (Point3f& p : mesh.positions) {
        const float face = std::max(p.z - 0.3f, 0.f);
        p = p * (1 + waves * face * std::cos(25 * p.x) * std::cos(25 * p.y));
        p.z += 1.2f * face;
    }
    return mesh;
}

/// Stands on its base alone, or, cut off at some radius, on its top as well.
Mesh cone(float top = 0) {
    Mesh mesh;
    constexpr std::uint32_t n = 48;
    mesh.positions = {{0, 0, 0}, {0, 2, 0}};
    for (std::uint32_t i = 0; i < n; ++i) {
        const float phi = 6.2831853f * float(i) / n;
        const Point3f rim{std::sin(phi), 0, std::cos(phi)};
        mesh.positions.push_back(rim);
        mesh.positions.push_back({top * rim.x, 2, top * rim.z});
        const std::uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % n);
        mesh.triangles.push_back({0, b, a});
        mesh.triangles.push_back({a, b, b + 1});
        if (top > 0) mesh.triangles.push_back({a, b + 1, a + 1});
        mesh.triangles.push_back({1, a + 1, b + 1});
    }
    return mesh;
}

TEST(MeshPose, TurnsAFilesAxesUpright) {
    const MeshPose z_up = pose_with({2, 1});
    EXPECT_EQ(z_up.front, (SignedAxis{1, -1}));
    EXPECT_EQ(z_up.turn({1, 2, 3}), Vec3f(1, 3, -2));
    EXPECT_EQ(MeshPose{}.turn({1, 2, 3}), Vec3f(1, 2, 3));
    EXPECT_TRUE(MeshPose{}.is_identity());
    for (const SignedAxis up : every_way)
        for (const SignedAxis front : every_way) {
            if (front.axis == up.axis) continue;
            const MeshPose pose{.up = up, .front = front};
            Vec3f u{}, f{};
            u[std::size_t(up.axis)] = float(up.sign);
            f[std::size_t(front.axis)] = float(front.sign);
            EXPECT_EQ(pose.turn(u), Vec3f(0, 1, 0)) << name_of(up) << name_of(front);
            EXPECT_EQ(pose.turn(f), Vec3f(0, 0, 1)) << name_of(up) << name_of(front);
            EXPECT_EQ(pose.turn(cross(u, f)), Vec3f(1, 0, 0)) << name_of(up) << name_of(front);
        }
}

TEST(MeshPose, NamesDirections) {
    for (const SignedAxis way : every_way) EXPECT_EQ(find_signed_axis(name_of(way)), way);
    EXPECT_EQ(find_signed_axis("Z"), (SignedAxis{2, 1}));
    for (const char* wrong : {"", "w", "+", "zz", "--z", "up"})
        EXPECT_FALSE(find_signed_axis(wrong)) << wrong;
}

TEST(MeshPose, StandsOnItsBaseWhicheverWayItLies) {
    const std::pair<const char*, Mesh> shapes[] = {
        {"bust", make_figure(8.f)}, {"pot", make_figure(8.f, "pot")}, {"cone", cone()}};
    for (const auto& [name, mesh] : shapes)
        for (const SignedAxis up : every_way)
            for (const SignedAxis usual : {SignedAxis{1, 1}, SignedAxis{2, 1}}) {
                const MeshPose pose = guess_pose(laid(mesh, pose_with(up)), usual);
                EXPECT_EQ(pose.up, up) << name << " " << name_of(up);
                EXPECT_EQ(pose.up_by_shape, !(up == usual)) << name << " " << name_of(up);
                EXPECT_EQ(pose.front, usual_front(up)) << name << " " << name_of(up);
            }
}

TEST(MeshPose, KeepsToCustomWhereAllWaysAreAsGood) {
    const std::pair<const char*, Mesh> shapes[] = {
        {"cube", make_cube()},                      // stands on every side
        {"tower", scaled(make_cube(), {1, 5, 1})},  // and where it would lie more safely
        {"tile, upright", scaled(make_cube(), {3, 3, 0.1f})},
        {"ball", make_icosphere(4)},  // stands on none
        {"egg", scaled(make_icosphere(4), {1, 0.7f, 0.8f})}};
    for (const auto& [name, mesh] : shapes)
        for (const SignedAxis usual : {SignedAxis{1, 1}, SignedAxis{2, 1}}) {
            const MeshPose pose = guess_pose(mesh, usual);
            EXPECT_EQ(pose, pose_with(usual)) << name << " " << name_of(pose.up);
        }
    EXPECT_EQ(guess_pose(Mesh{}, {2, 1}), pose_with({2, 1}));
    // On its head: a base of 0.36 of the best one is kept, one of 0.16 is not.
    EXPECT_EQ(guess_pose(cone(0.6f), {1, -1}), pose_with({1, -1}));
    EXPECT_EQ(guess_pose(cone(0.4f), {1, -1}).up, (SignedAxis{1, 1}));
}

TEST(MeshPose, FacesTheViewerWhicheverWayItLooks) {
    for (const SignedAxis up : {SignedAxis{1, 1}, SignedAxis{2, 1}})
        for (const SignedAxis front : every_way) {
            if (front.axis == up.axis) continue;
            const MeshPose made{.up = up, .front = front};
            const MeshPose pose = guess_pose(laid(head(), made), up);
            EXPECT_EQ(pose.up, up);
            EXPECT_EQ(pose.front, front) << name_of(up) << " " << name_of(pose.front);
            EXPECT_EQ(pose.front_by_shape, !(front == usual_front(up)));
        }
    // Without a face there is nothing to tell the front by.
    EXPECT_EQ(guess_pose(laid(head(0.f), {.front = {2, -1}}), {1, 1}), pose_with({1, 1}));
    // Nor in what is no mirror image of itself.
    Mesh turned = laid(head(), {.front = {2, -1}});
    for (Point3f& p : turned.positions) p.x += p.x > 0 ? 0.8f * p.x : 0.f;
    EXPECT_EQ(guess_pose(turned, {1, 1}), pose_with({1, 1}));
}

TEST(MeshPose, TheGivenUpIsTaken) {
    for (const SignedAxis up : every_way) {
        const MeshPose pose = guess_pose(cone(), {1, 1}, up);
        EXPECT_EQ(pose.up, up);
        EXPECT_FALSE(pose.up_by_shape);
    }
}

TEST(MeshPose, DependsOnNoUnit) {
    for (const float unit : {1e-4f, 1e5f})
        for (const SignedAxis up : every_way)
            EXPECT_EQ(
                guess_pose(scaled(laid(cone(), pose_with(up)), Vec3f(unit, unit, unit)), {1, 1}).up,
                up);
}

}  // namespace
}  // namespace nacre
