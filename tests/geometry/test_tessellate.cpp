// Meshes of analytic shapes against the shapes.
#include "nacre/geometry/tessellate.h"

#include <numbers>

#include "nacre/geometry/analytic.h"
#include "nacre/geometry/mesh_report.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

struct Tessellation {
    Primitive primitive;
    double radius;  // longest semi-axis
    bool flipped;
};

const std::vector<Tessellation>& cases() {
    static const std::vector<Tessellation> all = [] {
        const Transform mirror = Transform::scale({-2, 1, 3}) * Transform::rotate({1, 2, 3}, 40);
        std::vector<Tessellation> made;
        for (const bool flip : {false, true}) {
            made.push_back({Sphere{{1, 2, 3}, 2.5f, flip}, 2.5, flip});
            made.push_back({Disk{Transform::scale({3, 0.5, 1}), flip}, 3, flip});
            made.push_back({Disk{mirror, flip}, 3, flip});
            made.push_back({Cylinder{Transform::scale({2, 2, 7}), flip}, 2, flip});
            made.push_back({Cylinder{mirror, flip}, 3, flip});
        }
        return made;
    }();
    return all;
}

TEST(Tessellate, WithinTheChordErrorAndTheRightWayRound) {
    for (const double error : {0.3, 0.02, 1e-3})
        for (const auto& [primitive, radius, flipped] : cases()) {
            const Mesh mesh = tessellate(primitive, error);
            const AnalyticShape shape(primitive);
            ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
            const double rounding = 1e-6 * shape.size();
            for (std::size_t i = 0; i < mesh.positions.size(); ++i)
                ASSERT_LT(shape.closest(Vec3d(mesh.positions[i])).t, rounding);
            for (const Mesh::Triangle& t : mesh.triangles) {
                const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]),
                    c(mesh.positions[t[2]]);
                const Vec3d n = cross(b - a, c - a);
                for (const Vec3d& p :
                     {(a + b + c) / 3., (a + b) / 2., (b + c) / 2., (c + a) / 2.}) {
                    const AnalyticHit hit = shape.closest(p);
                    ASSERT_LE(hit.t, error * radius + rounding);
                    ASSERT_GT(dot(n, shape.at(hit.u, hit.v).n), 0);
                }
                for (const std::uint32_t v : t) ASSERT_GT(dot(n, Vec3d(mesh.normals[v])), 0);
            }
            EXPECT_TRUE(inspect(mesh).oriented());
        }
}

// Not finer than needed, and area and volume by the header's figures.
TEST(Tessellate, AreaMissing) {
    constexpr double kPi = std::numbers::pi, kError = 1e-3;
    const MeshReport sphere = inspect(tessellate(Sphere{}, kError));
    EXPECT_TRUE(sphere.solid());
    EXPECT_LT(inspect(tessellate(Sphere{{}, 1.f, true}, kError)).volume, 0);
    EXPECT_LT(1 - sphere.area / (4 * kPi), 1.25 * kError);
    EXPECT_GT(1 - sphere.area / (4 * kPi), 1.25 * kError / 5);
    const double disk = inspect(tessellate(Disk{}, kError)).area / kPi;
    EXPECT_NEAR(1 - disk, 4 / 3. * kError, 0.05 * kError);
    const MeshReport cylinder = inspect(tessellate(Cylinder{}, kError));
    EXPECT_NEAR(1 - cylinder.area / (2 * kPi), kError / 3, 0.05 * kError);
    EXPECT_EQ(cylinder.boundary_edges, cylinder.triangles);
}

TEST(Tessellate, Errors) {
    const auto message = [](const Primitive& primitive, double error) {
        try {
            tessellate(primitive, error);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(message(Disk{}, 0),
              "chord error 0 of a tessellation; give a fraction of the radius from 0.00001 to 0.5");
    EXPECT_EQ(message(Disk{}, 0.6),
              "chord error 0.6 of a tessellation; give a fraction of the "
              "radius from 0.00001 to 0.5");
    EXPECT_EQ(message(Sphere{{}, 0.f}, 0.01),
              "sphere radius is not a positive number; give a radius above zero");
}

}  // namespace
}  // namespace nacre
