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
    // With edges, corners and boundaries.
    for (const Mesh& mesh : {make_cube(), make_rectangle()}) {
        EXPECT_GT(nearest(mesh, spread(mesh, 2000, PointMethod::elimination), all)[0], 0.65);
        EXPECT_GT(nearest(mesh, spread(mesh, 2000, PointMethod::repulsion), all)[20], 0.65);
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
            RecordProperty("chi_square", std::to_string(statistic));
            printf("chi %d %.2f\n", int(method), statistic);
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
            if (method == PointMethod::elimination) EXPECT_GT(nearest(mesh, points, same)[0], 0.65);
            // No holes: with a spacing of 1 the hexagonal lattice leaves none beyond 0.58, and
            // maximal Poisson disk sets of least distance 0.7 none beyond 0.7.
            for (float x = -10.f; x <= 10.f; x += 0.25f)
                for (float y = -10.f; y <= 10.f; y += 0.25f)
                    for (const bool upper : {false, true}) {
                        float best = 1e30f;
                        for (std::size_t i = 0; i < points.size(); ++i)
                            if (side(i) == upper)
                                best = std::min(best,
                                                std::hypot(points.p[i].x - x, points.p[i].y - y));
                        ASSERT_LT(best, 1.f);
                    }
        }
}

TEST(SurfacePoints, SameBitsForAnyNumberOfThreads) {
    const Mesh mesh = make_figure(8.f);
    const auto bytes = [&](PointMethod method, std::size_t threads, std::uint64_t seed) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const SurfacePointSet points =
            points_for_spacing(mesh, 8., method, seed, {.shares = PointShares::voronoi});
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
// by sigma / sqrt(count) with sigma^2 = 1/5 - 1/9 of the mean square.
TEST(SurfacePoints, IntegralsConvergeFasterThanRandom) {
    const Mesh mesh = make_icosphere(5);
    double area = 0, exact = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3d a(mesh.positions[i]), b(mesh.positions[j]), c(mesh.positions[k]);
        const double one = 0.5 * length(cross(b - a, c - a));
        area += one;
        exact += one / 6 * (a.z * a.z + b.z * b.z + c.z * c.z + a.z * b.z + b.z * c.z + c.z * a.z);
    }
    const auto rms = [&](PointMethod method, std::size_t count, bool voronoi) {
        double squares = 0;
        constexpr int kRuns = 8;
        for (int seed = 1; seed <= kRuns; ++seed) {
            SurfacePointSet points = spread(mesh, count, method, std::uint64_t(seed));
            if (voronoi) assign_voronoi_shares(mesh, points, 64);
            double sum = 0;
            for (std::size_t i = 0; i < count; ++i)
                sum += double(points.area[i]) * points.p[i].z * points.p[i].z;
            squares += (sum - exact) * (sum - exact) / kRuns;
        }
        return std::sqrt(squares) / area;
    };
    const double sigma = std::sqrt(1 / 5. - 1 / 9.);
    for (const PointMethod method : kMethods)
        for (const bool voronoi : {false, true})
            printf("int %d %d: 200: %.3g x  3200: %.3g x\n", int(method), voronoi,
                   rms(method, 200, voronoi) / (sigma / std::sqrt(200.)),
                   rms(method, 3200, voronoi) / (sigma / std::sqrt(3200.)));
}

}  // namespace
}  // namespace nacre
