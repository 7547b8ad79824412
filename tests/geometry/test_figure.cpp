// Distances against geometry by hand, the mesher on fields whose surface is known and on noise,
// and the built-in sculpture.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <map>
#include <set>

#include "nacre/geometry/figure.h"
#include "nacre/geometry/figure_parts.h"
#include "nacre/geometry/sdf.h"
#include "nacre/geometry/surface_nets.h"
#include "nacre/math/error.h"
#include "tests/support/constants.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

// --- Distances
// ------------------------------------------------------------------------------------

TEST(Sdf, SphereCapsuleTorusByHand) {
    EXPECT_FLOAT_EQ(sdf::sphere({3, 4, 12}, 5), 8);
    EXPECT_FLOAT_EQ(sdf::sphere({}, 5), -5);
    // Beside, beyond the end, inside.
    EXPECT_FLOAT_EQ(sdf::capsule({3, 5, 4}, {0, 0, 0}, {0, 10, 0}, 2), 3);
    EXPECT_FLOAT_EQ(sdf::capsule({3, 14, 0}, {0, 0, 0}, {0, 10, 0}, 2), 3);
    EXPECT_FLOAT_EQ(sdf::capsule({0, 1, 0}, {0, 0, 0}, {0, 10, 0}, 2), -2);
    // 5 from the circle of radius 10 (3 outwards, 4 up); the centre of the hole; inside the ring.
    EXPECT_FLOAT_EQ(sdf::torus({0, 4, 13}, 10, 2), 3);
    EXPECT_FLOAT_EQ(sdf::torus({}, 10, 2), 8);
    EXPECT_FLOAT_EQ(sdf::torus({9, 0, 0}, 10, 2), -1);
}

TEST(Sdf, BoxAndCylinderByHand) {
    EXPECT_FLOAT_EQ(sdf::rounded_box({5, 0, 0}, {2, 3, 4}, 1), 3);
    EXPECT_FLOAT_EQ(sdf::rounded_box({4, 6, 0}, {1, 2, 9}, 0), 5);  // 3 and 4 from the edge
    EXPECT_FLOAT_EQ(sdf::rounded_box({0, 0, 0}, {2, 3, 4}, 1), -2);
    EXPECT_FLOAT_EQ(sdf::rounded_cylinder({0, 9, 0}, 5, 4, 1), 5);
    EXPECT_FLOAT_EQ(sdf::rounded_cylinder({8, 8, 0}, 5, 4, 0), 5);
    // Along the diagonal of the rounded rim: the corner's centre is (4, 3), the radius 1.
    EXPECT_FLOAT_EQ(sdf::rounded_cylinder({7, 7, 0}, 5, 4, 1), 4);
}

TEST(Sdf, EllipsoidIsExactOnItsAxesAndOnASphere) {
    EXPECT_NEAR(sdf::ellipsoid({2, 0, 0}, {2, 3, 5}), 0, 1e-6);
    EXPECT_NEAR(sdf::ellipsoid({0, 3, 0}, {2, 3, 5}), 0, 1e-6);
    EXPECT_NEAR(sdf::ellipsoid({0, 0, -5}, {2, 3, 5}), 0, 1e-6);
    EXPECT_NEAR(sdf::ellipsoid({0, 6, 8}, {4, 4, 4}), 6, 1e-5);
    EXPECT_LT(sdf::ellipsoid({}, {2, 3, 5}), 0);
}

// The round cone is the union of the balls along its axis, the tube that of the balls along its
// curve: compare with the least distance over many of them.
TEST(Sdf, RoundConeAndBezierAgainstManyBalls) {
    const Point3f a{-3, 1, 2}, b{4, 6, -1}, c{9, -2, 3};
    const int balls = 20000;
    for (int i = 0; i < 200; ++i) {
        const auto coordinate = [&](int k) {
            return float((i * (37 + 14 * k) + 11 * k) % 101) * 0.3f - 12.f;
        };
        const Point3f p{coordinate(0), coordinate(1), coordinate(2)};
        float cone = 1e9f, curve = 1e9f;
        for (int n = 0; n <= balls; ++n) {
            const float t = float(n) / float(balls), s = 1 - t;
            cone = std::min(cone, length(p - (a * s + b * t)) - (3.f * s + 1.f * t));
            curve = std::min(curve, length(p - (a * (s * s) + b * (2 * s * t) + c * (t * t))));
        }
        if (cone > 0) {  // within, the nearest ball gives only a bound
            EXPECT_NEAR(sdf::round_cone(p, a, b, 3, 1), cone, 2e-3) << i;
        }
        EXPECT_NEAR(sdf::bezier(p, a, b, c).distance, curve, 2e-3) << i;
    }
    EXPECT_FLOAT_EQ(sdf::bezier(c + Vec3f(5, 0, 0), a, b, c).t, 1);
}

TEST(Sdf, SmoothJoins) {
    // Further apart than k: the plain operation. Equal: k/6 lower.
    EXPECT_FLOAT_EQ(sdf::smooth_union(1, 5, 3), 1);
    EXPECT_FLOAT_EQ(sdf::smooth_union(2, 2, 3), 1.5f);
    EXPECT_FLOAT_EQ(sdf::smooth_intersection(2, 2, 3), 2.5f);
    EXPECT_FLOAT_EQ(sdf::smooth_subtraction(-4, 1, 3), -1);
    // No jump of slope where the filling ends.
    const float e = 1e-2f;
    EXPECT_NEAR(sdf::smooth_union(0, 3 - e, 3), 0, 1e-6);
    EXPECT_FLOAT_EQ(sdf::brush({1, 2, 3}, {1, 2, 3}, {1, 1, 1}), 1);
    EXPECT_NEAR(sdf::brush({2, 0, 0}, {}, {2, 1, 1}), std::exp(-1.f), 1e-6);
}

// --- Meshes
// ---------------------------------------------------------------------------------------

struct Topology {
    bool closed = false;  // every directed edge once, and once the other way
    bool fans = true;     // the triangles round every vertex are one fan
    int components = 0;
    long euler = 0;  // vertices - edges + faces
    double volume = 0, area = 0;
};

Topology topology(const Mesh& mesh) {
    Topology t;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> directed;
    directed.reserve(3 * mesh.triangles.size());
    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> opposite(
        mesh.positions.size());
    std::vector<std::uint32_t> parent(mesh.positions.size());
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const auto& f : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = f[k], b = f[(k + 1) % 3], c = f[(k + 2) % 3];
            directed.emplace_back(a, b);
            opposite[a].push_back({b, c});
            parent[root(a)] = root(b);
        }
        const Vec3d a(mesh.positions[f[0]]), b(mesh.positions[f[1]]), c(mesh.positions[f[2]]);
        t.volume += dot(a, cross(b, c)) / 6;
        t.area += length(cross(b - a, c - a)) / 2;
    }
    std::sort(directed.begin(), directed.end());
    t.closed = std::adjacent_find(directed.begin(), directed.end()) == directed.end();
    for (const auto& [a, b] : directed)
        t.closed &= std::binary_search(directed.begin(), directed.end(), std::pair(b, a));
    for (const auto& ring : opposite) {
        std::map<std::uint32_t, std::uint32_t> next(ring.begin(), ring.end());
        std::size_t steps = 0;
        std::uint32_t at = ring.empty() ? 0 : ring.front().first;
        do {
            ++steps;
            const auto step = next.find(at);
            if (step == next.end()) break;
            at = step->second;
        } while (at != ring.front().first && steps <= ring.size());
        if (ring.empty() || steps != ring.size()) t.fans = false;
    }
    for (std::uint32_t i = 0; i < parent.size(); ++i) t.components += root(i) == i;
    t.euler = long(mesh.positions.size()) - long(directed.size() / 2) + long(mesh.triangles.size());
    return t;
}

Box3f cube(float half) { return {{-half, -half, -half}, {half, half, half}}; }

TEST(SurfaceNets, SphereHasItsAreaVolumeAndNormals) {
    const auto ball = [](const Point3f& p) {
        return sdf::sphere(p - Vec3f(0.3f, -0.2f, 0.1f), 10);
    };
    const Mesh mesh = surface_nets(ball, {cube(12), 0.5f, 1});
    const Topology t = topology(mesh);
    EXPECT_TRUE(t.closed && t.fans);
    EXPECT_EQ(t.euler, 2);
    EXPECT_EQ(t.components, 1);
    // Chords of length h lie h^2 / 8r inside: 0.1 % of the radius at most.
    EXPECT_NEAR(t.volume, 4.0 / 3.0 * pi * 1000, 12);
    EXPECT_NEAR(t.area, 4 * pi * 100, 4);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3f r = mesh.positions[i] - Vec3f(0.3f, -0.2f, 0.1f);
        EXPECT_NEAR(length(r), 10, 2e-4);
        EXPECT_GT(dot(mesh.normals[i], r) / 10, 0.9999f);
    }
}

TEST(SurfaceNets, TorusHasAHole) {
    const auto ring = [](const Point3f& p) { return sdf::torus(p, 8, 2.5f); };
    const Topology t = topology(surface_nets(ring, {cube(12), 0.7f, 1}));
    EXPECT_TRUE(t.closed && t.fans);
    EXPECT_EQ(t.euler, 0);
    EXPECT_NEAR(t.volume, 2 * pi * pi * 8 * 2.5 * 2.5, 0.01 * 987);
}

// Noise without any correlation between corners holds every case of a cell, ambiguous ones too.
TEST(SurfaceNets, NoiseGivesAManifold) {
    const auto noise = [](const Point3f& p) {
        const Vec3f a{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
        if (std::max({a.x, a.y, a.z}) > 8.5f) return 1.f;
        const auto cell = [](float x) { return std::uint32_t(std::lround(x) + 1000); };
        std::uint32_t h = cell(p.x) * 73856093u ^ cell(p.y) * 19349663u ^ cell(p.z) * 83492791u;
        h = (h ^ (h >> 13)) * 0x5bd1e995u;
        return float((h ^ (h >> 15)) & 1023u) / 512.f - 1.2f;
    };
    const Mesh mesh = surface_nets(noise, {cube(10), 1, 100});
    const Topology t = topology(mesh);
    EXPECT_GT(mesh.triangles.size(), 3000u);
    EXPECT_TRUE(t.closed);
    EXPECT_TRUE(t.fans);
}

TEST(SurfaceNets, SkippingEmptySpaceChangesNothing) {
    const SurfaceNetsOptions sparse{figure_box(), 4, 1.5f}, dense{figure_box(), 4, 1000};
    const Mesh a = surface_nets(figure_distance, sparse), b = surface_nets(figure_distance, dense);
    // Vertices are ordered by block: compare as sets.
    const auto points = [](const Mesh& m) {
        std::set<std::array<float, 3>> s;
        for (const Point3f& p : m.positions) s.insert({p.x, p.y, p.z});
        return s;
    };
    EXPECT_EQ(a.triangles.size(), b.triangles.size());
    EXPECT_EQ(points(a), points(b));
}

TEST(SurfaceNets, WrongInput) {
    const auto ball = [](const Point3f& p) { return sdf::sphere(p, 10); };
    EXPECT_EQ(test::error_of([&] {
                  surface_nets(ball, {cube(12), 0});
              }),
              "surface nets: the cell, the box and the Lipschitz bound must be positive");
    EXPECT_EQ(test::error_of([&] {
                  surface_nets(ball, {Box3f{}, 1});
              }),
              "surface nets: the cell, the box and the Lipschitz bound must be positive");
    EXPECT_EQ(test::error_of([&] {
                  surface_nets(ball, {{{-12, -12, -4}, {12, 12, 12}}, 1});
              }).substr(0, 55),
              "surface nets: the surface reaches the side of the box a");
    EXPECT_NE(test::error_of([&] {
                  surface_nets(ball, {cube(2), 0.1f});
              }),
              "no error");  // wholly inside
    EXPECT_EQ(test::error_of([&] {
                  surface_nets(ball, {cube(12), 0.5f, 0.1f});
              }),
              "surface nets: the field changes faster than its Lipschitz bound says; raise it");
    EXPECT_EQ(test::error_of([] { make_figure(0); }),
              "figure: a resolution of 0 mm is not possible; give 0.2 to 8 mm");
    EXPECT_EQ(test::error_of([] { make_figure(NAN); }),
              "figure: a resolution of nan mm is not possible; give 0.2 to 8 mm");
}

// --- The sculpture
// --------------------------------------------------------------------------------

TEST(Figure, IsOneClosedManifoldOnItsZeroSet) {
    const Mesh mesh = make_figure();
    const Topology t = topology(mesh);
    EXPECT_TRUE(t.closed);
    EXPECT_TRUE(t.fans);
    EXPECT_EQ(t.components, 1);  // no floating piece and no cavity
    EXPECT_GT(t.volume, 0);
    EXPECT_GT(mesh.triangles.size(), 200000u);
    EXPECT_LT(mesh.triangles.size(), 400000u);
    EXPECT_EQ(t.euler, -2);  // genus 2: either ear touches the head below and the hair above

    const Box3f box = mesh.bounds();
    EXPECT_NEAR(box.lower.y, 0, 0.01);
    EXPECT_NEAR(box.upper.y, 425, 10);
    std::size_t off = 0, against = 0;
    for (const Point3f& p : mesh.positions) off += std::abs(figure_distance(p)) > 0.02f;
    for (const auto& f : mesh.triangles) {
        const Point3f &a = mesh.positions[f[0]], &b = mesh.positions[f[1]],
                      &c = mesh.positions[f[2]];
        const Vec3f n = cross(b - a, c - a);
        const float l = length(n);
        for (const std::uint32_t v : f) against += dot(n, mesh.normals[v]) < 0.5f * l;
    }
    EXPECT_LT(off, mesh.positions.size() / 1000) << "vertices off the zero set";
    EXPECT_LT(against, 3 * mesh.triangles.size() / 1000) << "normals against their triangle";
}

TEST(Figure, IsTheSameWithAnyNumberOfThreads) {
    const auto make = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return make_figure(5);
    };
    const Mesh a = make(1), b = make(4);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.triangles, b.triangles);
}

// Light must pass through the ears and the collar: walk through each sheet along its normal.
float thickness(Point3f p) {
    for (int i = 0; i < 20; ++i) {  // on to the surface
        const Vec3f n = gradient(figure_distance, p, 0.1f);
        p += n * (-figure_distance(p) / std::max(dot(n, n), 0.1f));
    }
    const Vec3f in = -normalize(gradient(figure_distance, p, 0.1f));
    float t = 0.2f;
    while (t < 50 && figure_distance(p + in * t) < 0) t += 0.02f;
    return t;
}

TEST(Figure, EarsAndCollarAreThin) {
    // The middle of each ear's blade, and the collar behind the neck.
    for (const Point3f& h : {Point3f{94, 18, -16}, Point3f{-94, 18, -16}}) {
        const float ear = thickness(figure::from_head(h));
        EXPECT_GT(ear, 1.5f);
        EXPECT_LT(ear, 3.f);
    }
    const float collar = thickness({0, 185, -150});
    EXPECT_GT(collar, 1.5f);
    EXPECT_LT(collar, 3.f);
}

TEST(Figure, FollowsTheCanonOfTheHead) {
    // Chin, nose and brow stand where figure_parts.h says, and the frames are each other's inverse.
    EXPECT_LT(figure::face({0, -105, 80}), 0);
    EXPECT_GT(figure::face({0, -125, 80}), 0);
    EXPECT_LT(figure::face({0, -36, 108}), 0);  // tip of the nose
    EXPECT_GT(figure::face({0, -58, 104}), 0);  // below it
    const Point3f p{31, 300, -12}, q = figure::from_head(figure::to_head(p));
    EXPECT_NEAR(length(p - q), 0, 1e-3);
    EXPECT_GT(figure::from_head({0, 0, 100}).x, 15);  // turned to its left
}

// --- The drape
// ------------------------------------------------------------------------------------

// On the ball where it lies on it, down to the floor, its normals those of its triangles, its threads
// along u and v of the flat cloth.
TEST(Drape, LiesOnItsBallAndHangsToTheFloor) {
    const Mesh mesh = make_figure(2, "drape");
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    const Box3f box = mesh.bounds();
    EXPECT_NEAR(box.lower.y, 0., 1e-3);
    EXPECT_NEAR(box.upper.y, 157., 1e-3);
    const Point3f middle{0, 97, 0};
    int on_ball = 0;
    float nearest = 1e9f, farthest = 0.f;  // of the hem
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3f from = mesh.positions[i] - middle;
        if (mesh.positions[i].y > 142.f) {
            EXPECT_NEAR(length(from), 60., 1e-3);
            EXPECT_GT(dot(mesh.normals[i], normalize(from)), 0.9999f);
            // As long along the cloth as along the ball.
            const double along = 60. * std::acos(std::min(1.f, from.y / 60.f));
            const Vec2f uv = mesh.uvs[i] - Vec2f{0.5f, 0.5f};
            EXPECT_NEAR(std::hypot(uv.x, uv.y) * 2. * 194.3, along, 1.);
            ++on_ball;
        }
        if (mesh.positions[i].y < 1e-3f) {
            const float r = std::hypot(from.x, from.z);
            nearest = std::min(nearest, r);
            farthest = std::max(farthest, r);
        }
    }
    EXPECT_GT(on_ball, 500);
    EXPECT_GT(farthest, 1.3f * nearest);  // folds
    for (const Mesh::Triangle& t : mesh.triangles) {
        const Vec3f n = cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                              mesh.positions[t[2]] - mesh.positions[t[0]]);
        ASSERT_GT(dot(normalize(n), mesh.normals[t[0]]), 0.8f);
    }
}

}  // namespace
}  // namespace nacre
