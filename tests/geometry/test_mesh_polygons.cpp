// Polygons with more than three corners: areas by closed form, whatever the corner they begin at.
#include <cmath>
#include <map>
#include <numbers>

#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"
#include "tests/geometry/solids.h"

namespace nacre {
namespace {

using namespace test;
using Outline = std::vector<std::array<float, 2>>;

double area_of(const Outline& o) {
    double twice = 0;
    for (std::size_t i = 0; i < o.size(); ++i) {
        const auto &a = o[i], &b = o[(i + 1) % o.size()];
        twice += double(a[0]) * b[1] - double(a[1]) * b[0];
    }
    return twice / 2;
}

double perimeter_of(const Outline& o) {
    double sum = 0;
    for (std::size_t i = 0; i < o.size(); ++i) {
        const auto &a = o[i], &b = o[(i + 1) % o.size()];
        sum += std::hypot(a[0] - b[0], a[1] - b[1]);
    }
    return sum;
}

// Every edge of the outline is the edge of one triangle, every other edge of two, opposite ways.
void expect_edges_used_once(const Mesh& mesh, std::size_t corners) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> used;
    for (const Mesh::Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            ++used[{t[i], t[(i + 1) % 3]}];
            --used[{t[(i + 1) % 3], t[i]}];
        }
    for (std::uint32_t i = 0; i < corners; ++i) {
        const auto next = static_cast<std::uint32_t>((i + 1) % corners);
        EXPECT_EQ((used[{i, next}]), 1) << i;
        used[{i, next}] = used[{next, i}] = 0;
    }
    for (const auto& [edge, count] : used) EXPECT_EQ(count, 0) << edge.first << " " << edge.second;
}

std::string one_polygon(const std::vector<std::array<float, 3>>& points) {
    Solid s{points, {{}}};
    for (std::uint32_t i = 0; i < points.size(); ++i) s.faces[0].push_back(i);
    return solid_obj(s);
}

std::string flat(const Outline& o) {
    std::vector<std::array<float, 3>> points;
    for (const auto& p : o) points.push_back({p[0], p[1], 0});
    return one_polygon(points);
}

Outline comb(int teeth) {
    Outline o = {{0, 0}, {float(2 * teeth), 0}};
    for (int i = 2 * teeth; i > 0; --i) {
        o.push_back({float(i), i % 2 ? 1.f : 3.f});
        o.push_back({float(i - 1), i % 2 ? 1.f : 3.f});
    }
    return o;
}

Outline star(int corners) {
    Outline o;
    for (int i = 0; i < corners; ++i) {
        const double a = 2 * std::numbers::pi * i / corners, r = i % 2 ? 0.5 : 1;
        o.push_back({float(r * std::cos(a)), float(r * std::sin(a))});
    }
    return o;
}

TEST(MeshPolygons, ConcavePrismsInEveryReader) {
    const Outline arrow = {{0, 0}, {2, -1}, {1, 0}, {2, 1}};  // reflex at its third corner
    const Outline flat_sides = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}};
    for (const Outline& outline : {l_shape(), arrow, flat_sides, comb(3), star(10)})
        for (std::size_t start = 0; start < outline.size(); ++start)
            for (const bool mirrored : {false, true}) {
                const Solid s = prism(outline, start, mirrored);
                for (const auto& [name, bytes] : {std::pair{"a.obj", solid_obj(s)},
                                                  {"a.off", solid_off(s)},
                                                  {"text.ply", solid_ply(s, false)},
                                                  {"binary.ply", solid_ply(s, true)}}) {
                    SCOPED_TRACE(fmt::format("{} corners from {}, {}{}", outline.size(), start,
                                             name, mirrored ? ", mirrored" : ""));
                    const MeshReport report = inspect(*parse_mesh(bytes, name));
                    EXPECT_TRUE(report.solid());
                    EXPECT_NEAR(report.area, 2 * area_of(outline) + perimeter_of(outline), 1e-5);
                    EXPECT_NEAR(report.volume, area_of(outline), 1e-5);
                }
            }
}

TEST(MeshPolygons, ConvexOnesStayFans) {
    const auto mesh = parse_mesh(solid_obj(unit_cube()), "a.obj");
    const auto expected = fans(unit_cube());
    ASSERT_EQ(mesh->triangles.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(mesh->triangles[i], expected[i]);
}

// Planes of any direction and place: the L, turned and far away.
TEST(MeshPolygons, InclinedPlanes) {
    const double c = std::cos(0.7), s = std::sin(0.7), k = std::cos(1.9), l = std::sin(1.9);
    for (const float far : {0.f, 100.f}) {
        std::vector<std::array<float, 3>> points;
        for (const auto& [x, y] : l_shape())
            points.push_back({float(c * x - s * k * y) + far, float(s * x + c * k * y) - far,
                              float(l * y) + far});
        for (std::size_t start = 0; start < points.size(); ++start) {
            std::rotate(points.begin(), points.begin() + 1, points.end());
            const auto mesh = parse_mesh(one_polygon(points), "a.obj");
            EXPECT_NEAR(inspect(*mesh).area, 3, 1e-4);
            expect_edges_used_once(*mesh, points.size());
        }
    }
}

// A square with a hole, joined by an edge that is passed twice; as indices and as points again.
TEST(MeshPolygons, HolesJoinedByABridge) {
    const Outline o = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0},
                       {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
    for (std::size_t start = 0; start < o.size(); ++start) {
        Outline turned = o;
        std::rotate(turned.begin(), turned.begin() + start, turned.end());
        EXPECT_NEAR(inspect(*parse_mesh(flat(turned), "a.obj")).area, 12, 1e-6) << start;
    }
    const std::string shared =
        "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\n"
        "f 1 2 3 4 1 5 6 7 8 5\n";
    EXPECT_NEAR(inspect(*parse_mesh(shared, "a.obj")).area, 12, 1e-6);
}

// What is no proper polygon keeps its edges and its signed area.
TEST(MeshPolygons, DegenerateOnesLoseNothing) {
    for (const Outline& o :
         {Outline{{0, 0}, {2, 0}, {0, 2}, {2, 3}},          // crosses itself
          Outline{{0, 0}, {3, 1}, {0, 1}, {3, 0}, {1, 4}},  // more than once
          Outline{{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 6}, {2, 4}, {0, 4}, {1, 2}}}) {  // a spike
        const auto mesh = parse_mesh(flat(o), "a.obj");
        double twice = 0;
        for (const Mesh::Triangle& t : mesh->triangles) {
            const Point3f &a = mesh->positions[t[0]], &b = mesh->positions[t[1]],
                          &c = mesh->positions[t[2]];
            twice += cross(b - a, c - a).z;
        }
        EXPECT_NEAR(twice / 2, area_of(o), 1e-5);
        if (mesh->dropped_triangles == 0) expect_edges_used_once(*mesh, o.size());
    }
    // A corner named twice, and one at the place of the one before it.
    EXPECT_NEAR(
        inspect(*parse_mesh("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 2 0 0\n"
                            "f 1 2 7 3 4 4 5 6\n",
                            "a.obj"))
            .area,
        3, 1e-6);
    // All on one line: no area, no plane, no harm.
    EXPECT_EQ(
        parse_mesh("v 0 0 0\nv 1 0 0\nv 3 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 5\n", "a.obj")
            ->triangles.size(),
        3u);
}

TEST(MeshPolygons, TenThousandCorners) {
    for (const Outline& o : {comb(2500), star(10000)}) {
        const auto mesh = parse_mesh(flat(o), "a.obj");
        EXPECT_EQ(mesh->triangles.size() + mesh->dropped_triangles, o.size() - 2);
        EXPECT_NEAR(inspect(*mesh).area / area_of(o), 1, 1e-5);
        expect_edges_used_once(*mesh, o.size());
    }
}

}  // namespace
}  // namespace nacre
