// Walks over meshes against unfolded ones, and how triangles hang together.
#include "nacre/geometry/surface_walk.h"

#include <numbers>

#include "nacre/geometry/mesh_build.h"
#include "nacre/geometry/tessellate.h"
#include "nacre/math/random.h"

namespace nacre {
namespace {

// (x, y) as a place on the flat mesh of one quad, triangles {0,1,2} and {2,3,0}, or of any mesh in
// z = 0, by search.
SurfacePlace place_at(const Mesh& mesh, double x, double y) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        const Vec3d a(mesh.positions[t[0]]), e1 = Vec3d(mesh.positions[t[1]]) - a,
                                             e2 = Vec3d(mesh.positions[t[2]]) - a;
        const double det = e1.x * e2.y - e1.y * e2.x;
        const double u = ((x - a.x) * e2.y - (y - a.y) * e2.x) / det;
        const double v = (e1.x * (y - a.y) - e1.y * (x - a.x)) / det;
        if (det != 0 && u >= 0 && v >= 0 && u + v <= 1) return {i, u, v};
    }
    throw std::logic_error("no such place");
}

// A square of columns, cut every other way, whose vertices are shaken.
Mesh shaken_square(int n, std::uint64_t seed) {
    Random random(seed);
    Mesh mesh;
    const auto at = [&](int i, int j) { return std::uint32_t(i * (n + 1) + j); };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const auto coordinate = [&](int k) {
                const float shake = k == 0 || k == n ? 0.f : 0.8f * random.next() - 0.4f;
                return 2.f * (float(k) + shake) / float(n) - 1.f;
            };
            const float x = coordinate(i);
            mesh.positions.push_back({x, coordinate(j), 0.f});
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

TEST(SurfaceWalk, StraightInThePlaneAndAlongBoundaries) {
    const Mesh mesh = shaken_square(12, 5);
    const SurfaceWalk surface(mesh);
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const auto coordinate = [&] { return 1.9 * random.next() - 0.95; };
        const double x = coordinate(), y = coordinate();
        const Vec3d walk{3. * random.next() - 1.5, 3. * random.next() - 1.5, 0};
        const Vec3d end = surface.position(surface.walk(place_at(mesh, x, y), walk));
        // Past the boundary the component along it is left: each coordinate stops on its own.
        ASSERT_NEAR(end.x, std::clamp(x + walk.x, -1., 1.), 1e-6) << i;
        ASSERT_NEAR(end.y, std::clamp(y + walk.y, -1., 1.), 1e-6) << i;
    }
}

// Each side of the cube has vertices of its own, which must not stop the walk; a length of 8 leads
// once round.
TEST(SurfaceWalk, FoldsOverEdges) {
    const Mesh cube = make_cube();
    const SurfaceWalk surface(cube);
    std::uint32_t top = 0;
    while (geometric_normal(cube, top).z < 0.5) ++top;
    const SurfacePlace start{top, 1 / 3., 1 / 3.};
    const Vec3d from = surface.position(start);
    const SurfacePlace side = surface.walk(start, {2, 0, 0});
    EXPECT_LT(length(surface.position(side) - Vec3d{1, from.y, -from.x}), 1e-9);
    EXPECT_LT(length(geometric_normal(cube, side.triangle) - Vec3d{1, 0, 0}), 1e-12);
    EXPECT_LT(length(surface.position(surface.walk(start, {8, 0, 0})) - from), 1e-9);
    EXPECT_LT(length(surface.position(surface.walk(start, {0, -8, 0})) - from), 1e-9);
}

// A prism unrolls to a rectangle: walks are helices of any pitch.
TEST(SurfaceWalk, HelixOnAPrism) {
    const Mesh mesh = tessellate(Cylinder{Transform::scale({2, 2, 50})}, 1e-2);
    const SurfaceWalk surface(mesh);
    const auto steps = double(mesh.positions.size() / 2);
    const double width = 2 * 2 * std::sin(std::numbers::pi / steps);
    // Unrolled: distance along the perimeter from the first vertical edge, and height.
    const auto unrolled = [&](const SurfacePlace& place) {
        const double facet = place.triangle / 2;
        const Vec3d p = surface.position(place);
        const Vec3d corner(mesh.positions[mesh.triangles[place.triangle][0]]);
        return Vec3d{facet * width + std::hypot(p.x - corner.x, p.y - corner.y), p.z, 0};
    };
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const SurfacePlace start{0, 0.5 * random.next(), 0.5 * random.next()};
        const Vec3d from = unrolled(start);
        const Vec3d tangent =
            normalize(Vec3d(mesh.positions[mesh.triangles[0][1]]) - Vec3d(mesh.positions[0]));
        const double along = 30. * random.next() - 15.;
        const double up = std::clamp(from.y + 60. * random.next() - 30., 0.5, 49.5) - from.y;
        const Vec3d to = unrolled(surface.walk(start, tangent * along + Vec3d{0, 0, up}));
        const double turn = std::remainder(to.x - from.x - along, steps * width);
        ASSERT_NEAR(turn, 0, 1e-4);  // the positions are rounded to float
        ASSERT_NEAR(to.y - from.y, up, 1e-4);
    }
}

TEST(SurfaceWalk, PassesFlatTriangles) {
    // A T-junction closed by a triangle without area: the left square's side 1-2 is one edge, the
    // right one's two, 1-4 and 4-2. And one whose corners coincide beside another edge.
    Mesh mesh;
    mesh.positions = {{0, 0, 0},     {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                      {1, 0.25f, 0}, {2, 0, 0}, {2, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {1, 5, 4}, {4, 5, 6}, {4, 6, 2}, {5, 6, 6}};
    const SurfaceWalk surface(mesh);
    for (const double y : {0.1, 0.2, 0.25, 0.3, 0.9}) {
        const SurfacePlace start = place_at(mesh, 0.5, y);
        const SurfacePlace end = surface.walk(start, {1, 0, 0});
        EXPECT_LT(length(surface.position(end) - Vec3d{1.5, y, 0}), 1e-9) << y;
        const Vec3d back = surface.position(surface.walk(end, {-1, 0, 0}));
        EXPECT_LT(length(back - Vec3d{0.5, y, 0}), 1e-9) << y;
    }
}

TEST(MeshTopology, SeamsComponentsAndOddEdges) {
    const Mesh cube = make_cube();
    for (const SideIndex side : side_neighbours(cube)) EXPECT_NE(side, kNoSide);
    EXPECT_EQ(triangle_components(cube), std::vector<std::uint32_t>(12, 0));
    // Two triangles, a third at their common edge, one elsewhere and one without sides.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1},
                      {9, 0, 0}, {9, 1, 0}, {9, 0, 1}, {1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {8, 3, 2}, {5, 6, 7}, {5, 6, 5}};
    EXPECT_EQ(side_neighbours(mesh),
              (std::vector<SideIndex>{kNoSide, 5, kNoSide, kNoSide, kNoSide, 1, kNoSide, kNoSide,
                                      kNoSide, kNoSide, kNoSide, kNoSide}));
    EXPECT_EQ(triangle_components(mesh), (std::vector<std::uint32_t>{0, 0, 1, 1}));
    mesh.triangles.push_back({1, 2, 4});
    for (const SideIndex side : side_neighbours(mesh)) EXPECT_EQ(side, kNoSide);
}

}  // namespace
}  // namespace nacre
