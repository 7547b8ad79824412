#include <cmath>
#include <numbers>

#include "nacre/geometry/mesh_build.h"
#include "nacre/geometry/mesh_report.h"

namespace nacre {
namespace {

/// Vertices shared by all faces, no normals: what STL files give after welding.
Mesh shared_cube() {
    Mesh m;
    for (int i = 0; i < 8; ++i)
        m.positions.emplace_back(Vec3d{double(i & 1), double(i >> 1 & 1), double(i >> 2)});
    m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return m;
}

/// A prism of n sides about z, of radius and height 1.
Mesh round_prism(std::uint32_t n) {
    Mesh m;
    for (int z = 0; z < 2; ++z)
        for (std::uint32_t i = 0; i < n; ++i) {
            const double a = 2 * std::numbers::pi * i / n;
            m.positions.emplace_back(Vec3d{std::cos(a), std::sin(a), double(z)});
        }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        m.triangles.push_back({i, j, n + j});
        m.triangles.push_back({i, n + j, n + i});
        if (i > 1) m.triangles.push_back({0, i, i - 1});
        if (i > 1) m.triangles.push_back({n, n + i - 1, n + i});
    }
    return m;
}

Vec3d face_normal(const Mesh& m, const Mesh::Triangle& t) {
    const Vec3d a(m.positions[t[0]]);
    return normalize(cross(Vec3d(m.positions[t[1]]) - a, Vec3d(m.positions[t[2]]) - a));
}

/// Largest angle between a triangle and the normals at its corners, degrees.
double largest_lean(const Mesh& m) {
    double least = 1;
    for (const Mesh::Triangle& t : m.triangles)
        for (const std::uint32_t v : t)
            least = std::min(least, dot(face_normal(m, t), Vec3d(m.normals[v])));
    return std::acos(least) * 180 / std::numbers::pi;
}

TEST(MeshNormals, ACubeHasFlatSides) {
    Mesh cube = shared_cube();
    compute_normals(cube, default_crease_angle);
    EXPECT_EQ(cube.positions.size(), 24u);
    EXPECT_EQ(cube.normals.size(), 24u);
    EXPECT_GT(cube.positions.capacity(), cube.positions.size());
    EXPECT_LT(largest_lean(cube), 0.05);
    EXPECT_TRUE(inspect(cube).solid());
    Mesh smooth = shared_cube();
    compute_normals(smooth, 180);
    EXPECT_EQ(smooth.positions.size(), 8u);
    EXPECT_NEAR(largest_lean(smooth), std::acos(1 / std::sqrt(3.)) * 180 / std::numbers::pi, 0.01);
}

TEST(MeshNormals, RoundThingsKeepTheirVerticesAndBits) {
    for (int level = 0; level < 3; ++level) {
        Mesh ball = make_icosphere(level);
        Mesh smooth = ball;
        compute_normals(smooth);
        compute_normals(ball, default_crease_angle);
        EXPECT_EQ(ball.positions.size(), smooth.positions.size()) << level;
        EXPECT_EQ(ball.normals, smooth.normals) << level;
        EXPECT_EQ(ball.triangles, smooth.triangles) << level;
    }
}

TEST(MeshNormals, PrismsAreRoundFromEightSidesOn) {
    // Of the sides; lids are flat either way. Around the middle of an edge normals lean by half the
    // turn from side to side where it is smooth.
    for (const auto& [n, lean] : {std::pair{6u, 0.}, std::pair{8u, 22.5}, std::pair{16u, 11.25}}) {
        Mesh m = round_prism(n);
        compute_normals(m, default_crease_angle);
        EXPECT_NEAR(largest_lean(m), lean, 1.) << n;
        EXPECT_EQ(m.positions.size(), n == 6 ? 6 * 2 * 3 : n * 4) << n;
    }
}

TEST(MeshNormals, ZeroMakesEveryTriangleFlat) {
    Mesh ball = make_icosphere(1);
    ball.uvs.assign(ball.positions.size(), {0.25f, 0.5f});
    compute_normals(ball, 0);
    EXPECT_EQ(ball.positions.size(), 3 * ball.triangles.size());
    EXPECT_EQ(ball.uvs.size(), ball.positions.size());
    EXPECT_LT(largest_lean(ball), 0.05);
}

TEST(MeshNormals, OnlyTheCreaseIsCut) {
    // Two rows of squares that meet at a right angle: the fold is hard, the seam within a row is
    // not.
    Mesh m;
    for (int i = 0; i < 3; ++i) {
        m.positions.emplace_back(Vec3d{double(i), 1, 0});
        m.positions.emplace_back(Vec3d{double(i), 0, 0});
        m.positions.emplace_back(Vec3d{double(i), 0, -1});
    }
    for (std::uint32_t i = 0; i < 2; ++i)
        for (std::uint32_t k = 0; k < 2; ++k) {
            const std::uint32_t a = 3 * i + k;
            m.triangles.push_back({a, a + 1, a + 4});
            m.triangles.push_back({a, a + 4, a + 3});
        }
    compute_normals(m, default_crease_angle);
    EXPECT_EQ(m.positions.size(), 9u + 3u);
    EXPECT_LT(largest_lean(m), 0.05);
}

}  // namespace
}  // namespace nacre
