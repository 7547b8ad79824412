#include "nacre/geometry/mesh_report.h"

#include "nacre/geometry/mesh_build.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

TEST(MeshBuild, GeneratedMeshesAreSolidWithKnownVolume) {
    const MeshReport cube = inspect(make_cube());
    EXPECT_TRUE(cube.solid());
    EXPECT_EQ(cube.vertices, 8u);
    EXPECT_DOUBLE_EQ(cube.volume, 8);
    EXPECT_DOUBLE_EQ(cube.area, 24);
    // The regular icosahedron of edge a inscribed in the unit sphere: V = 5 (3 + sqrt 5) / 12 a^3.
    const double a = 1 / std::sin(2 * pi / 5);
    const MeshReport ico = inspect(make_icosphere(0));
    EXPECT_TRUE(ico.solid());
    EXPECT_NEAR(ico.volume, 5 * (3 + std::sqrt(5.)) / 12 * a * a * a, 1e-6);
    const MeshReport sphere = inspect(make_icosphere(5));
    EXPECT_TRUE(sphere.solid());
    EXPECT_EQ(sphere.triangles, 20u * 1024);
    EXPECT_EQ(sphere.vertices, 10u * 1024 + 2);  // Euler: V = 2 + T / 2
    EXPECT_NEAR(sphere.volume / (4 / 3. * pi), 1, 2e-3);
    EXPECT_NEAR(sphere.area / (4 * pi), 1, 1e-3);
    const MeshReport torus = inspect(make_torus(2, 0.5f, 200, 100));
    EXPECT_TRUE(torus.solid());
    EXPECT_EQ(torus.vertices, 20000u);  // V - E + T = 0
    EXPECT_EQ(torus.components, 1u);
    EXPECT_NEAR(torus.volume / (2 * pi * pi * 2 * 0.25), 1, 2e-3);
    EXPECT_NEAR(torus.area / (4 * pi * pi * 2 * 0.5), 1, 1e-3);
    const MeshReport rectangle = inspect(make_rectangle());
    EXPECT_EQ(rectangle.boundary_edges, 4u);
    EXPECT_DOUBLE_EQ(rectangle.area, 4);
}

TEST(MeshBuild, NormalsPointOutwards) {
    for (Mesh mesh : {make_icosphere(3), make_torus(1, 0.25f, 64, 32), make_cube()}) {
        for (const Mesh::Triangle& t : mesh.triangles) {
            const Vec3f n = cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                  mesh.positions[t[2]] - mesh.positions[t[0]]);
            EXPECT_GT(dot(n, mesh.normals[t[0]]), 0.f);
        }
    }
}

TEST(MeshBuild, ComputedNormalsDoNotDependOnTheCut) {
    Mesh sphere = make_icosphere(4);
    const std::vector<Vec3f> exact = sphere.normals;
    compute_normals(sphere);
    for (std::size_t i = 0; i < exact.size(); ++i)
        EXPECT_GT(dot(exact[i], sphere.normals[i]), 0.9999f);
    // At a cube's corner three right angles give (1,1,1)/sqrt 3, however its squares are cut.
    Mesh cube;
    for (int i = 0; i < 8; ++i)
        cube.positions.emplace_back(float(i & 1), float(i >> 1 & 1), float(i >> 2));
    cube.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    ASSERT_TRUE(inspect(cube).solid());
    compute_normals(cube);
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(cube.normals[i][k], (cube.positions[i][k] * 2 - 1) / std::sqrt(3.f), 1e-6f);
}

TEST(MeshReport, DefectsAreCountedAndNamed) {
    const Mesh good = make_icosphere(1);
    EXPECT_EQ(warning(inspect(good), true), "");

    Mesh open = good;
    open.triangles.pop_back();
    EXPECT_EQ(inspect(open).boundary_edges, 3u);
    EXPECT_FALSE(inspect(open).closed());
    EXPECT_EQ(warning(inspect(open), true),
              "the surface is open (3 boundary edges); light in the medium inside gets lost there: "
              "close and orient the surface before rendering");
    EXPECT_EQ(warning(inspect(open), false), "");

    Mesh inverted = good;
    for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
    EXPECT_TRUE(inspect(inverted).inside_out());
    EXPECT_EQ(warning(inspect(inverted), true),
              "the surface is inside out (its volume is negative); the medium would fill the "
              "outside: turn the triangles round or set flip_normals");

    Mesh mixed = good;
    std::swap(mixed.triangles[5][0], mixed.triangles[5][1]);
    EXPECT_EQ(inspect(mixed).inconsistent_edges, 3u);
    EXPECT_TRUE(inspect(mixed).closed());
    EXPECT_EQ(warning(inspect(mixed), true),
              "neighbouring triangles face opposite ways at 3 edges; light in the medium inside "
              "gets lost there: close and orient the surface before rendering");

    Mesh fin = good;
    const auto tip = static_cast<std::uint32_t>(fin.positions.size());
    fin.positions.push_back({0, 0, 3});
    fin.triangles.push_back({fin.triangles[0][0], fin.triangles[0][1], tip});
    EXPECT_EQ(inspect(fin).non_manifold_edges, 1u);
    EXPECT_EQ(warning(inspect(fin), true),
              "the surface is open (2 boundary edges) and 1 edge joins more than two triangles; "
              "light in the medium inside gets lost there: close and orient the surface before "
              "rendering");
    EXPECT_EQ(warning(inspect(fin), false),
              "1 edge joins more than two triangles; shading may show it, and a medium inside "
              "would lose light");

    Mesh flat = good;
    flat.dropped_triangles = 2;
    flat.triangles.push_back({0, 0, 1});
    EXPECT_EQ(inspect(flat).degenerate_triangles, 3u);
    EXPECT_EQ(warning(inspect(flat), false),
              "3 triangles have no area; no ray meets them, so they do no harm");
}

TEST(MeshReport, SplitVerticesAreOnePlaceAndPartsAreCounted) {
    // Triangles that share no vertex, as in STL files, and two spheres, one far away.
    Mesh soup;
    for (const float shift : {0.f, 1000.f}) {
        const Mesh sphere = make_icosphere(2);
        for (const auto& t : sphere.triangles) {
            const auto first = static_cast<std::uint32_t>(soup.positions.size());
            for (const auto v : t)
                soup.positions.push_back(sphere.positions[v] + Vec3f{shift, 0, 0});
            soup.triangles.push_back({first, first + 1, first + 2});
        }
    }
    const MeshReport report = inspect(soup);
    EXPECT_EQ(report.components, 2u);
    EXPECT_TRUE(report.solid());
    EXPECT_EQ(report.vertices, 2u * 162);
    EXPECT_NEAR(report.volume / (2 * inspect(make_icosphere(2)).volume), 1, 1e-3);
}

}  // namespace
}  // namespace nacre
