#include "nacre/geometry/polygon.h"

#include <map>
#include <numbers>

#include "nacre/geometry/mesh_io.h"
#include "nacre/geometry/mesh_report.h"

namespace nacre {
namespace {

double area_of(const std::vector<Point3f>& p, const Mesh::Triangle& t) {
    return 0.5 * length(cross(Vec3d(p[t[1]]) - Vec3d(p[t[0]]), Vec3d(p[t[2]]) - Vec3d(p[t[0]])));
}

/// The sum of the triangles' areas, none of which may be counted twice or lie outside: it is the
/// polygon's own area then and more otherwise. Checks on the way that every side is used once.
double cut_area(const std::vector<Point3f>& p) {
    std::vector<Mesh::Triangle> triangles;
    cut_polygon(p, triangles);
    EXPECT_EQ(triangles.size(), p.size() - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    double area = 0;
    for (const Mesh::Triangle& t : triangles) {
        area += area_of(p, t);
        for (int k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
    }
    for (std::uint32_t i = 0; i < p.size(); ++i)
        EXPECT_EQ((sides[{i, std::uint32_t((i + 1) % p.size())}]), 1) << "side " << i;
    for (const auto& [side, count] : sides) {
        const bool outline = side.second == (side.first + 1) % p.size();
        EXPECT_EQ(count, 1);
        if (!outline) {
            EXPECT_EQ((sides[{side.second, side.first}]), 1);
        }
    }
    return area;
}

/// The same from every corner on, both ways round, and in a plane that is not an axis'.
void expect_area(const std::vector<Point3f>& p, double area) {
    for (const bool reversed : {false, true})
        for (const bool tilted : {false, true})
            for (std::size_t first = 0; first < p.size(); ++first) {
                std::vector<Point3f> q;
                for (std::size_t i = 0; i < p.size(); ++i) {
                    const Point3f v = p[(first + i) % p.size()];
                    // A right angle between (1, 2, 2) / 3 and (2, 1, -2) / 3.
                    q.push_back(tilted ? (Vec3f{1, 2, 2} * v.x + Vec3f{2, 1, -2} * v.y) / 3.f : v);
                }
                if (reversed) std::reverse(q.begin(), q.end());
                EXPECT_NEAR(cut_area(q), area, 1e-5 * area) << "from corner " << first;
            }
}

TEST(Polygon, ConcaveOnesKeepTheirArea) {
    const std::vector<Point3f> l = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                    {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    expect_area(l, 3);
    const std::vector<Point3f> arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
    expect_area(arrow, 1);
    const std::vector<Point3f> comb = {
        {0, 0, 0}, {7, 0, 0}, {7, 3, 0}, {6, 3, 0}, {6, 1, 0}, {5, 1, 0}, {5, 3, 0}, {4, 3, 0},
        {4, 1, 0}, {3, 1, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    expect_area(comb, 7 + 4 * 2);
    // Straight corners on two sides.
    const std::vector<Point3f> straight = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                           {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    expect_area(straight, 3);
    // A square of 3 x 3 with a hole of 1 x 1 that a bridge joins to the outline.
    const std::vector<Point3f> hole = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                       {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    expect_area(hole, 8);
}

TEST(Polygon, ConvexOnesStayFans) {
    std::vector<Point3f> p;
    for (int i = 0; i < 12; ++i) {
        const double a = 2 * std::numbers::pi * i / 12;
        p.emplace_back(Vec3d{std::cos(a), std::sin(a), 0.3});
    }
    std::vector<Mesh::Triangle> triangles;
    cut_polygon(p, triangles);
    for (std::uint32_t i = 0; i < 10; ++i)
        EXPECT_EQ(triangles[i], (Mesh::Triangle{0, i + 1, i + 2}));
}

TEST(Polygon, WhatIsNoneGetsItsTrianglesAllTheSame) {
    cut_area({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}});              // crosses itself
    cut_area({{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {3, -2, 0}, {2, 4, 0}});  // more than once
    cut_area({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});              // has no area
    cut_area({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}});   // is a point
    const float nan = std::numeric_limits<float>::quiet_NaN();
    cut_area({{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}});
}

TEST(Polygon, ManyCornersAreCutInLittleTime) {
    // A star of 10,000 corners; its area is n / 2 R r sin(2 pi / n) for n / 2 points of radius R.
    constexpr int n = 10'000;
    std::vector<Point3f> p;
    for (int i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n, r = i % 2 ? 1 : 2;
        p.emplace_back(Vec3d{r * std::cos(a), r * std::sin(a), 0});
    }
    EXPECT_NEAR(cut_area(p), 0.5 * n * 2 * std::sin(2 * std::numbers::pi / n), 1e-3);
}

// A prism over an L in every format that knows polygons, from every corner of its caps.
TEST(Polygon, ReadersCutConcaveFaces) {
    constexpr int outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (int first = 0; first < 6; ++first) {
        std::string points, obj, ply, faces_of_ply;
        for (int z = 0; z < 2; ++z)
            for (const auto& p : outline) points += fmt::format("{} {} {}\n", p[0], p[1], z);
        const auto face = [&](const std::vector<int>& corners) {
            obj += 'f';
            faces_of_ply += fmt::format("{}", corners.size());
            for (const int c : corners) {
                obj += fmt::format(" {}", c + 1);
                faces_of_ply += fmt::format(" {}", c);
            }
            obj += '\n', faces_of_ply += '\n';
        };
        std::vector<int> top, bottom;
        for (int i = 0; i < 6; ++i) {
            top.push_back(6 + (first + i) % 6);
            bottom.push_back((first + 6 - i) % 6);
            face({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
        }
        face(top), face(bottom);
        std::string vertices;
        for (std::size_t at = 0, end; at < points.size(); at = end + 1) {
            end = points.find('\n', at);
            vertices += "v " + points.substr(at, end + 1 - at);
        }
        const std::string header =
            "ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\n"
            "property float z\nelement face 8\nproperty list uchar int vertex_index\nend_header\n";
        const std::string faces_first =
            "ply\nformat ascii 1.0\nelement face 8\nproperty list uchar int vertex_index\n"
            "element vertex 12\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
        const std::pair<const char*, std::string> files[] = {
            {"a.obj", vertices + obj},
            {"b.obj", obj + vertices},  // faces before what they name
            {"a.ply", header + points + faces_of_ply},
            {"b.ply", faces_first + faces_of_ply + points},
            {"a.off", "OFF 12 8 0\n" + points + faces_of_ply}};
        for (const auto& [name, bytes] : files) {
            const MeshReport report = inspect(*parse_mesh(bytes, name));
            EXPECT_NEAR(report.area, 14, 1e-5) << name << " from corner " << first;
            EXPECT_NEAR(report.volume, 3, 1e-5) << name;
            EXPECT_TRUE(report.solid()) << name;
        }
    }
}

}  // namespace
}  // namespace nacre
