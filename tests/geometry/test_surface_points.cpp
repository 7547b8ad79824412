// Evenly spread points: where they lie, how even they are, and what their shares are worth.
#include "nacre/geometry/surface_points.h"

#include <tbb/global_control.h>

#include <cstring>
#include <numbers>

#include "nacre/geometry/area_sampler.h"
#include "nacre/geometry/figure.h"
#include "nacre/geometry/mesh_build.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/geometry/mesh_topology.h"
#include "nacre/geometry/tessellate.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/math/statistics.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

constexpr PointMethod kMethods[] = {PointMethod::random, PointMethod::repulsion,
                                    PointMethod::elimination};
constexpr PointMethod kEven[] = {PointMethod::repulsion, PointMethod::elimination};

SurfacePointSet spread(const Mesh& mesh, std::size_t count, PointMethod method,
                       std::uint64_t seed = 1) {
    if (method == PointMethod::random) return random_points(mesh, count, seed);
    if (method == PointMethod::repulsion) return repelled_points(mesh, count, seed);
    return eliminated_points(mesh, count, seed);
}

// [-1, 1]^2 in columns of very unequal width: x = s^3.
Mesh uneven_square(int columns) {
    Mesh mesh;
    for (int i = 0; i <= columns; ++i) {
        const float s = 2.f * float(i) / float(columns) - 1.f;
        for (const float y : {-1.f, 1.f}) mesh.positions.push_back({s * s * s, y, 0.f});
    }
    for (std::uint32_t i = 0; i < std::uint32_t(columns); ++i) {
        mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    }
    return mesh;
}

Mesh box(Vec3f half_size) {
    Mesh mesh = make_cube();
    for (Point3f& p : mesh.positions) p = p * half_size;
    return mesh;
}

// Appends `b`, moved, to `a`.
Mesh joined(Mesh a, const Mesh& b, Vec3f by) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    for (const Point3f& p : b.positions) a.positions.push_back(p + by);
    for (const auto& [i, j, k] : b.triangles)
        a.triangles.push_back({first + i, first + j, first + k});
    a.normals.clear();
    a.uvs.clear();
    return a;
}

// Distances to the nearest other point that `sees` accepts, in units of the spacing of the densest
// arrangement of as many points; ascending.
template <class Sees>
std::vector<double> nearest(const Mesh& mesh, const SurfacePointSet& points, const Sees& sees) {
    const double spacing = std::sqrt(2 / std::numbers::sqrt3 * inspect(mesh).area / points.size());
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i) {
        double best = 1e30;
        for (std::size_t j = 0; j < points.size(); ++j)
            if (i != j && sees(i, j))
                best = std::min(best, double(length(points.p[i] - points.p[j])));
        distances.push_back(best / spacing);
    }
    std::sort(distances.begin(), distances.end());
    return distances;
}

TEST(SurfacePoints, LieOnTheirTrianglesAndShareTheArea) {
    Mesh flat = make_rectangle();  // with triangles that have no area, first, amid and last
    flat.triangles = {{0, 0, 1}, {0, 1, 2}, {1, 2, 1}, {2, 3, 0}, {3, 3, 3}};
    const Mesh meshes[] = {
        make_icosphere(3), make_cube(), make_torus(2.f, 0.5f, 30, 12),
        make_figure(8.f),  flat,        joined(make_cube(), make_cube(), {9, 0, 0})};
    for (const Mesh& mesh : meshes)
        for (const PointMethod method : kMethods) {
            SurfacePointSet points = spread(mesh, 777, method);
            ASSERT_EQ(points.size(), 777u);
            const double area = inspect(mesh).area;
            for (const bool voronoi : {false, true}) {
                if (voronoi) assign_voronoi_shares(mesh, points, 16);
                double sum = 0;
                for (const float share : points.area) sum += share;
                EXPECT_NEAR(sum, area, 1e-5 * area);
            }
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto& t = mesh.triangles.at(points.triangle[i]);
                const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]),
                    c(mesh.positions[t[2]]);
                const auto [u, v] = points.barycentric[i];
                ASSERT_GE(std::min({u, v, 1.f - u - v}), -1e-7f);
                const Vec3d p = a + (b - a) * double(u) + (c - a) * double(v);
                ASSERT_LE(length(Vec3d(points.p[i]) - p), 1e-7 * length(p));
                ASSERT_LE(length(Vec3d(points.n[i]) - normalize(cross(b - a, c - a))), 1e-6);
            }
        }
}

// The least distance over that of the hexagonal lattice (the relative radius of Lagae and Dutre
// 2008, A Comparison of Methods for Generating Poisson Disk Distributions, CGF 27(1), who call 0.65
// to 0.85 good). Random points have pairs at any distance: of 2000 the least of 2000 distances has
// a median of about 0.02.
TEST(SurfacePoints, LeastDistance) {
    const auto all = [](std::size_t, std::size_t) { return true; };
    const Mesh sphere = make_icosphere(5);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        EXPECT_LT(nearest(sphere, spread(sphere, 2000, PointMethod::random, seed), all)[0], 0.15);
        for (const PointMethod method : kEven)
            EXPECT_GT(nearest(sphere, spread(sphere, 2000, method, seed), all)[0], 0.65);
    }
    // With edges, corners and boundaries; repulsion squeezes a few together there.
    for (const Mesh& mesh : {make_cube(), make_rectangle(), make_figure(8.f)})
        for (const PointMethod method : kEven) {
            const SurfacePointSet points = spread(mesh, 2000, method);
            const auto facing = [&](std::size_t i, std::size_t j) {
                return dot(points.n[i], points.n[j]) > -0.5f;
            };
            EXPECT_GT(nearest(mesh, points, facing)[method == PointMethod::repulsion ? 100 : 0],
                      0.65);
        }
    // The mean nearest distance tells the two apart: repulsion comes closer to the lattice.
    const auto mean = [&](PointMethod method) {
        double sum = 0;
        for (const double d : nearest(sphere, spread(sphere, 2000, method), all)) sum += d / 2000;
        return sum;
    };
    EXPECT_GT(mean(PointMethod::repulsion), mean(PointMethod::elimination) + 0.03);
}

// Counts in regions of equal area. Five sigma (3e-7) against too uneven counts; and even sets have
// counts so steady that random ones would be with a probability below 1e-12.
TEST(SurfacePoints, UniformDensityWhateverTheTriangles) {
    constexpr std::size_t kCount = 4000;
    constexpr int kRegions = 100;
    const Mesh sphere = make_icosphere(5), square = uneven_square(40);
    const auto on_sphere = [](const Point3f& p) {
        const Vec3d d = normalize(Vec3d(p));
        const double turn = std::atan2(d.y, d.x) / (2 * std::numbers::pi) + 0.5;
        return std::min(9, int((d.z + 1) * 5)) * 10 + std::min(9, int(turn * 10));
    };
    const auto on_square = [](const Point3f& p) {
        return std::min(9, int((p.x + 1) * 5)) * 10 + std::min(9, int((p.y + 1) * 5));
    };
    const auto chi_square = [&](const SurfacePointSet& points, const auto& region) {
        std::vector<int> counts(kRegions);
        for (const Point3f& p : points.p) ++counts[region(p)];
        double sum = 0;
        const double expected = double(kCount) / kRegions;
        for (const int n : counts) sum += (n - expected) * (n - expected) / expected;
        return sum;
    };
    for (const PointMethod method : kMethods) {
        const double found[] = {chi_square(spread(sphere, kCount, method), on_sphere),
                                chi_square(spread(square, kCount, method), on_square)};
        for (const double statistic : found) {
            EXPECT_GT(chi_square_probability(statistic, kRegions - 1), 3e-7) << statistic;
            if (method != PointMethod::random) {
                EXPECT_LT(1 - chi_square_probability(statistic, kRegions - 1), 1e-12) << statistic;
            }
        }
    }
}

// Two sheets 0.1 apart, 10 times closer than the spacing: both are covered as if alone. They may be
// the sides of one thin box, or two planes that face the same way.
TEST(SurfacePoints, BothSidesOfThinSheets) {
    Mesh plane = make_rectangle();
    for (Point3f& p : plane.positions) p = p * 10.f;
    const Mesh sheets[] = {box({10.f, 10.f, 0.05f}), joined(plane, plane, {0.f, 0.f, 0.1f})};
    for (const Mesh& mesh : sheets)
        for (const PointMethod method : kEven) {
            const SurfacePointSet points = points_for_spacing(mesh, 1., method, 5);
            const float middle = mesh.bounds().center().z;
            const auto side = [&](std::size_t i) { return points.p[i].z > middle; };
            std::size_t above = 0;
            for (std::size_t i = 0; i < points.size(); ++i) above += side(i);
            EXPECT_NEAR(double(above), points.size() / 2., 0.02 * points.size());
            const auto same = [&](std::size_t i, std::size_t j) { return side(i) == side(j); };
            if (method == PointMethod::elimination) {
                EXPECT_GT(nearest(mesh, points, same)[0], 0.65);
            }
            // A hole wider than the spacing would have room for another point at the full spacing.
            // Within one spacing of the box's rim the other side's points are near, too.
            for (float x = -9.f; x <= 9.f; x += 0.25f)
                for (float y = -9.f; y <= 9.f; y += 0.25f)
                    for (const bool upper : {false, true}) {
                        float best = 1e30f;
                        for (std::size_t i = 0; i < points.size(); ++i)
                            if (side(i) == upper)
                                best = std::min(best,
                                                std::hypot(points.p[i].x - x, points.p[i].y - y));
                        ASSERT_LT(best, 1.f) << x << ' ' << y;
                    }
        }
}

TEST(SurfacePoints, SameBitsForAnyNumberOfThreads) {
    const Mesh mesh = make_figure(8.f);
    const auto bytes = [&](PointMethod method, std::size_t threads, std::uint64_t seed) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const SurfacePointSet points = points_for_spacing(mesh, 16., method, seed);
        std::string all;
        const auto append = [&](const auto& v) {
            all.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(v[0]));
        };
        append(points.p), append(points.n), append(points.triangle), append(points.barycentric);
        append(points.area);
        return all;
    };
    for (const PointMethod method : kMethods) {
        const std::string one = bytes(method, 1, 3);
        EXPECT_TRUE(one == bytes(method, 2, 3));
        EXPECT_TRUE(one == bytes(method, 7, 3));
        EXPECT_FALSE(one == bytes(method, 1, 4));
    }
}

// The integral of z^2 over the triangles themselves, in closed form. Independent points would err
// by area sigma / sqrt(count) with sigma^2 = 1/5 - 1/9 of z^2 on the sphere.
TEST(SurfacePoints, IntegralsConvergeFasterThanRandom) {
    const Mesh mesh = make_icosphere(5);
    double area = 0, exact = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3d a(mesh.positions[i]), b(mesh.positions[j]), c(mesh.positions[k]);
        const double one = 0.5 * length(cross(b - a, c - a));
        area += one;
        exact += one / 6 * (a.z * a.z + b.z * b.z + c.z * c.z + a.z * b.z + b.z * c.z + c.z * a.z);
    }
    // Root mean square error over that of independent points.
    const auto relative = [&](PointMethod method, std::size_t count, bool voronoi) {
        double squares = 0;
        constexpr int kRuns = 8;
        for (int seed = 1; seed <= kRuns; ++seed) {
            SurfacePointSet points = spread(mesh, count, method, std::uint64_t(seed));
            if (voronoi) assign_voronoi_shares(mesh, points, 32);
            double sum = 0;
            for (std::size_t i = 0; i < count; ++i)
                sum += double(points.area[i]) * points.p[i].z * points.p[i].z;
            squares += (sum - exact) * (sum - exact) / kRuns;
        }
        return std::sqrt(squares) / (area * std::sqrt((1 / 5. - 1 / 9.) / double(count)));
    };
    // The mean square of 8 errors lies within a factor of 3 of its expectation (3 sigma of chi-
    // square with 8 degrees of freedom), their root within 1.8. Equal shares: better than
    // random by a constant. Voronoi shares: by a factor that grows with the count.
    for (const PointMethod method : kEven) {
        EXPECT_LT(relative(method, 200, false), 0.5);
        EXPECT_LT(relative(method, 3200, false), 0.5);
        const double few = relative(method, 200, true), many = relative(method, 3200, true);
        EXPECT_LT(few, 0.1);
        EXPECT_LT(many, 0.5 * few);
    }
}

// Shares that are known: a square lattice, whose cells are all alike, on a coarse and on a fine
// mesh. The bound is that of surface_point_set.h, 0.5 / 64^0.75 = 0.022, with a third to spare.
TEST(SurfacePoints, VoronoiSharesOfALattice) {
    constexpr int kSide = 30;
    for (const Mesh& mesh : {make_rectangle(), uneven_square(25)}) {
        SurfacePointSet points = random_points(mesh, kSide * kSide, 1);
        for (int i = 0; i < kSide * kSide; ++i) {
            points.p[i] = {(2.f * float(i % kSide) + 1.f) / kSide - 1.f,
                           (2.f * float(i / kSide) + 1.f) / kSide - 1.f, 0.f};
            points.area[i] = 0;
        }
        assign_voronoi_shares(mesh, points, 64);
        double squares = 0;
        for (const float share : points.area)
            squares += std::pow(share * kSide * kSide / 4. - 1, 2) / (kSide * kSide);
        EXPECT_LT(std::sqrt(squares), 0.03);
    }
    // A component too small for a point of its own: its area is not lost.
    const Mesh pair = joined(make_icosphere(3), make_rectangle(), {500.f, 0.f, 0.f});
    SurfacePointSet points = random_points(pair, 1, 1);
    assign_voronoi_shares(pair, points, 64);
    EXPECT_NEAR(points.area[0], inspect(pair).area, 1e-4);
}

// Two planes 0.1 apart, the lower one with half the points: each point's share is of its own plane.
TEST(SurfacePoints, VoronoiSharesOfThinSheets) {
    const Mesh plane = make_rectangle();
    for (const bool box_like : {false, true}) {
        Mesh mesh = joined(plane, plane, {0.f, 0.f, 0.01f});
        if (box_like) mesh = box({1.f, 1.f, 0.005f});
        const SurfacePointSet all = eliminated_points(mesh, 800, 1);
        const float middle = mesh.bounds().center().z;
        SurfacePointSet some;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all.p[i].z > middle || i % 2) {
                some.p.push_back(all.p[i]);
                some.n.push_back(all.n[i]);
                some.triangle.push_back(all.triangle[i]);
                some.barycentric.push_back(all.barycentric[i]);
                some.area.push_back(0);
            }
        assign_voronoi_shares(mesh, some);
        double above = 0;
        for (std::size_t i = 0; i < some.size(); ++i)
            if (some.p[i].z > middle) above += some.area[i];
        EXPECT_NEAR(above, 4, 0.1);  // the rim of the box has 0.04
    }
}

// At boundaries repelled points gather, and equal shares weigh the rim too much: the mean of r^2
// over the unit disk, 1/2 (of its polygon a little less), comes out too large.
TEST(SurfacePoints, VoronoiSharesMendBoundaries) {
    const Mesh disk = tessellate(Disk{}, 1e-4);
    SurfacePointSet points = repelled_points(disk, 1000, 1);
    const auto mean = [&] {
        double sum = 0, area = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            sum += double(points.area[i]) * length_squared(points.p[i]);
            area += points.area[i];
        }
        return sum / area;
    };
    EXPECT_GT(mean(), 0.51);
    assign_voronoi_shares(disk, points);
    EXPECT_NEAR(mean(), 0.5, 0.005);
}

TEST(SurfacePoints, Errors) {
    const Mesh square = make_rectangle();
    Mesh none, line = square, nowhere = square;
    line.triangles = {{0, 1, 1}, {2, 2, 2}};
    nowhere.name.clear();
    nowhere.positions[2].x = std::numeric_limits<float>::quiet_NaN();
    const auto by_spacing = [&](double spacing) {
        return [&square, spacing] { points_for_spacing(square, spacing, PointMethod::random, 1); };
    };
    const std::pair<std::function<void()>, std::string> cases[] = {
        {[&] { random_points(none, 5, 1); },
         "mesh has no triangles; points can only be spread over a surface"},
        {[&] { eliminated_points(line, 5, 1); },
         "mesh 'rectangle' has no area: all its triangles are flat; points can only be spread over "
         "a surface"},
        {[&] { repelled_points(nowhere, 5, 1); },
         "mesh has coordinates that are not finite; export it again"},
        {[&] { random_points(square, 0, 1); },
         "0 surface points are asked for; give a number from 1 to 50000000"},
        {[&] { repelled_points(square, 50000001, 1); },
         "50000001 surface points are asked for; give a number from 1 to 50000000"},
        {by_spacing(0), "spacing of surface points is 0; give a length above zero"},
        {by_spacing(-0.5), "spacing of surface points is -0.5; give a length above zero"},
        {by_spacing(std::numeric_limits<double>::quiet_NaN()),
         "spacing of surface points is nan; give a length above zero"},
        {by_spacing(1e-5),
         "a spacing of 1e-05 on an area of 4 takes 4.62e+10 surface points; the limit is "
         "50000000: give a spacing of at least 0.0003039"},
        {[&] { eliminated_points(square, 5, 1, {0.5f}); },
         "sample elimination from 0.5 candidates per point; give a number from 1 to 100"},
        {[&] { eliminated_points(square, 20'000'000, 1); },
         "sample elimination of 20000000 points would take 100000000 candidates; the limit is "
         "50000000: ask for fewer points or fewer candidates per point, or use repulsion"},
        {[&] { repelled_points(square, 5, 1, {.sweeps = -1}); },
         "point repulsion in -1 sweeps; give a number from 0 to 1000"},
        {[&] { repelled_points(square, 5, 1, {.step = 0.5f}); },
         "point repulsion with step 0.5; give a number above 0, at most 0.24"},
        {[&] {
             SurfacePointSet points = random_points(square, 5, 1);
             assign_voronoi_shares(square, points, 0);
         },
         "Voronoi shares by 0 samples per point; give a number from 1 to 10000"}};
    for (const auto& [call, expected] : cases) EXPECT_EQ(test::error_of(call), expected);
    // 2 * 4 / (sqrt(3) * 0.1^2) = 461.9, and at least one.
    EXPECT_EQ(point_count(4, 0.1), 462u);
    EXPECT_EQ(point_count(4, 100), 1u);
}

}  // namespace
}  // namespace nacre
