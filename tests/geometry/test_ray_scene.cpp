#include "nacre/geometry/ray_scene.h"

#include "nacre/geometry/mesh_build.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "tests/geometry/shapes.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

using test::random_direction;
using test::share;

Vec3f toward(const Point3f& from, const Point3f& to) { return normalize(to - from); }

// |o + t d - c| = r, solved on paper.
std::optional<double> sphere_distance(const Vec3d& o, const Vec3d& d, const Vec3d& c, double r) {
    const Vec3d f = o - c;
    const double b = dot(f, d), disc = b * b - dot(f, f) + r * r;
    if (disc < 0) return std::nullopt;
    const double near = -b - std::sqrt(disc), far = -b + std::sqrt(disc);
    if (far < 0) return std::nullopt;
    return near > 0 ? near : far;
}

// Mitsuba 3.9.1's answers to rays along the axes (ray_intersect: p, uv, dp_du).
TEST(RayScene, CubeLaysTexturesAsMitsuba) {
    RayScene scene;
    scene.add(share(make_cube()));
    scene.build();
    const struct {
        Vec3f outside;
        Vec2f uv;
        Vec3f dpdu;
    } faces[] = {
        {{1, 0, 0}, {0.75f, 0.65f}, {0, 1, 0}},   {{-1, 0, 0}, {0.75f, 0.35f}, {0, 1, 0}},
        {{0, 1, 0}, {0.375f, 0.65f}, {-1, 0, 0}}, {{0, -1, 0}, {0.35f, 0.625f}, {0, 0, 1}},
        {{0, 0, 1}, {0.75f, 0.625f}, {0, 1, 0}},  {{0, 0, -1}, {0.25f, 0.625f}, {0, -1, 0}}};
    for (const auto& [outside, uv, dpdu] : faces) {
        const Vec3f at{0.25f, 0.5f, -0.3f};
        const Ray ray{at - outside * dot(at, outside) + outside * 5, -outside};
        const auto hit = scene.intersect(ray);
        ASSERT_TRUE(hit);
        const SurfacePoint point = scene.surface_point(ray, *hit);
        EXPECT_NEAR(point.uv.x, uv.x, 1e-6);
        EXPECT_NEAR(point.uv.y, uv.y, 1e-6);
        EXPECT_NEAR(length(point.shading.s - dpdu), 0, 1e-6);
    }
}

TEST(RayScene, EmptySceneAnswersQueries) {
    RayScene scene;
    scene.build();
    EXPECT_FALSE(scene.intersect({{0, 0, 0}, {0, 0, 1}}));
    EXPECT_FALSE(scene.occluded({{0, 0, 0}, {0, 0, 1}}));
    EXPECT_EQ(scene.distance({0, 0, 0}, 7.f), 7.f);
    EXPECT_EQ(scene.shape_count(), 0u);
    EXPECT_TRUE(scene.bounds().empty());
}

TEST(RayScene, SphereMatchesTheQuadratic) {
    RayScene scene;
    scene.add(Sphere{{1, -2, 3}, 2.5f});
    scene.build();
    Random random(1);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3f d = random_direction(random);
        const Point3f o = random_direction(random) * (8 * random.next()) + Vec3f{1, -2, 3};
        const auto expected = sphere_distance(Vec3d(o), Vec3d(d), {1, -2, 3}, 2.5);
        const auto hit = scene.intersect({o, d});
        ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
        ASSERT_EQ(scene.occluded({o, d}), hit.has_value());
        if (!hit) continue;
        ++hits;
        ASSERT_NEAR(hit->t, *expected, 1e-5);
        const SurfacePoint point = scene.surface_point({o, d}, *hit);
        const Vec3d radial = Vec3d(point.p) - Vec3d{1, -2, 3};
        ASSERT_NEAR(length(radial), 2.5, 1e-6);
        ASSERT_NEAR(dot(Vec3d(point.ng), radial) / 2.5, 1, 1e-6);
        ASSERT_LT(length(point.p - (o + d * hit->t)), 2e-5);
        ASSERT_FALSE(scene.occluded({o, d, 0.f, hit->t * 0.999f}));
    }
    EXPECT_GT(hits, 5000);
}

TEST(RayScene, DiskAndCylinderUnderAffineMaps) {
    const Transform map = Transform::translate({1, 2, 3}) * Transform::rotate({1, 1, 0}, 40) *
                          Transform::scale({2, 0.5, 3});
    RayScene scene;
    scene.add(Disk{map});
    scene.add(Cylinder{map});
    scene.build();
    Random random(2);
    int disks = 0, cylinders = 0;
    for (int i = 0; i < 20000; ++i) {
        // Aim at a known point of the surface in local coordinates, from either side.
        const double phi = 2 * pi * random.next();
        const bool disk = random.next() < 0.5f;
        const double r = disk ? random.next() : 1;
        const double z = disk ? 0 : random.next();
        const Vec3d target = map.map_point({r * std::cos(phi), r * std::sin(phi), z});
        const Vec3f d = random_direction(random);
        const Point3f o = Point3f(target - Vec3d(d) * 0.01);
        const auto hit = scene.intersect({o, d, 0.f, 1.f});
        // Something else may be in front; only then does the hit differ.
        ASSERT_TRUE(hit || std::abs(dot(Vec3d(d), normalize(map.map_normal({0, 0, 1})))) < 1e-3 ||
                    z < 1e-3 || z > 0.999 || !disk);
        if (!hit || hit->shape != (disk ? 0u : 1u) || std::abs(hit->t - 0.01f) > 1e-4f) continue;
        const SurfacePoint point = scene.surface_point({o, d}, *hit);
        ASSERT_LT(length(Vec3d(point.p) - target), 2e-4);
        const Vec3d n = normalize(
            map.map_normal(disk ? Vec3d{0, 0, 1} : Vec3d{std::cos(phi), std::sin(phi), 0}));
        ASSERT_GT(dot(Vec3d(point.ng), n), 0.999);
        ASSERT_NEAR(dot(point.shading.s, point.shading.n), 0, 1e-6);
        (disk ? disks : cylinders) += 1;
    }
    EXPECT_GT(disks, 8000);
    EXPECT_GT(cylinders, 8000);
}

TEST(RayScene, CubeAgainstSlabs) {
    RayScene scene;
    scene.add(share(make_cube()));
    scene.build();
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const Point3f o{1.8f * random.next() - 0.9f, 1.8f * random.next() - 0.9f,
                        1.8f * random.next() - 0.9f};
        const Vec3f d = random_direction(random);
        double exit = 1e30;
        int axis = 0;
        for (int a = 0; a < 3; ++a) {
            const double t = ((d[a] > 0 ? 1.0 : -1.0) - o[a]) / d[a];
            if (t < exit) exit = t, axis = a;
        }
        const auto hit = scene.intersect({o, d});
        ASSERT_TRUE(hit);
        ASSERT_NEAR(hit->t, exit, 1e-5);
        const SurfacePoint point = scene.surface_point({o, d}, *hit);
        // Points very near an edge may be given to either side.
        Vec3f inside = point.p;
        inside[axis] = 0;
        if (std::max({std::abs(inside.x), std::abs(inside.y), std::abs(inside.z)}) > 0.9999f)
            continue;
        ASSERT_EQ(point.ng[axis], d[axis] > 0 ? 1.f : -1.f);
        ASSERT_EQ(point.shading.n, point.ng);
    }
}

TEST(RayScene, TangentFollowsTheTextureCoordinates) {
    RayScene scene;
    scene.add(share(make_rectangle()));
    Mesh mirrored = make_rectangle();
    for (Vec2f& uv : mirrored.uvs) uv.x = 1 - uv.x;
    for (Point3f& p : mirrored.positions) p.z = -1;
    scene.add(share(mirrored));
    scene.add(share(make_rectangle()), false, true);
    scene.build();
    const Ray down{{0.25f, -0.5f, 1}, {0, 0, -1}};
    const SurfacePoint point = scene.surface_point(down, {1, 0, 0, 0.25f, 0.5f});
    EXPECT_EQ(point.shading.s, (Vec3f{1, 0, 0}));
    EXPECT_EQ(point.shading.t, (Vec3f{0, 1, 0}));
    EXPECT_EQ(point.uv, (Vec2f{0.75f, 0.5f}));
    EXPECT_EQ(scene.surface_point(down, {1, 1, 0, 0.25f, 0.5f}).shading.s, (Vec3f{-1, 0, 0}));
    const SurfacePoint flipped = scene.surface_point(down, {1, 2, 0, 0.25f, 0.5f});
    EXPECT_EQ(flipped.ng, (Vec3f{0, 0, -1}));
    EXPECT_EQ(flipped.shading.n, (Vec3f{0, 0, -1}));
    EXPECT_EQ(flipped.shading.s, (Vec3f{1, 0, 0}));
}

TEST(RayScene, ShadingNormalsInterpolateOnTheGeometricSide) {
    Mesh mesh = make_rectangle();
    mesh.normals = {{-0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}};
    Mesh inward = mesh;
    for (Vec3f& n : inward.normals) n = -n;
    RayScene scene;
    scene.add(share(mesh));
    scene.add(share(inward));
    scene.add(share(mesh), true);
    scene.build();
    const Hit middle{1, 0, 0, 0.5f, 0.f};  // halfway between vertices 0 and 1
    EXPECT_NEAR(scene.surface_point({}, middle).shading.n.z, 1.f, 1e-6f);
    const Hit corner{1, 0, 0, 0.f, 0.f};
    EXPECT_NEAR(scene.surface_point({}, corner).shading.n.x, -0.6f, 1e-6f);
    const Hit turned{1, 1, 0, 0.f, 0.f};
    EXPECT_NEAR(scene.surface_point({}, turned).shading.n.x, -0.6f, 1e-6f);
    const Hit faceted{1, 2, 0, 0.f, 0.f};
    EXPECT_EQ(scene.surface_point({}, faceted).shading.n, (Vec3f{0, 0, 1}));
}

TEST(RayScene, UvsDefaultToBarycentrics) {
    Mesh mesh = make_rectangle();
    mesh.uvs.clear();
    RayScene scene;
    scene.add(share(mesh));
    scene.build();
    EXPECT_EQ(scene.surface_point({}, {1, 0, 0, 0.25f, 0.5f}).uv, (Vec2f{0.25f, 0.5f}));
}

TEST(RayScene, MeshWithoutPaddingIsCopied) {
    Mesh mesh = make_cube();
    mesh.positions.shrink_to_fit();
    ASSERT_EQ(mesh.positions.capacity(), mesh.positions.size());
    RayScene scene;
    scene.add(std::make_shared<const Mesh>(std::move(mesh)));
    scene.build();
    EXPECT_FLOAT_EQ(scene.intersect({{0, 0, 0}, {0, 0, 1}})->t, 1.f);
}

TEST(RayScene, RefusesBrokenMeshes) {
    const auto message = [](Mesh mesh) {
        RayScene scene;
        try {
            scene.add(share(std::move(mesh)));
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    Mesh mesh = make_rectangle();
    mesh.triangles[1][2] = 4;
    EXPECT_EQ(message(mesh),
              "rectangle: triangle 1 names vertex 4 but there are 4 vertices (counted from 0)");
    mesh.triangles.clear();
    EXPECT_EQ(message(mesh), "rectangle: has no triangles; a shape needs at least one");
    mesh = make_rectangle();
    mesh.uvs.pop_back();
    EXPECT_EQ(message(mesh),
              "rectangle: has 4 positions, 4 normals, 3 uvs; give one normal and uv a position, or "
              "none");
    RayScene scene;
    EXPECT_THROW(scene.add(Sphere{{0, 0, 0}, 0.f}), InputError);
    EXPECT_THROW(scene.add(Sphere{{0, NAN, 0}, 1.f}), InputError);
}

// Fired from points inside in random directions and exactly at edges, a ray leaves a closed mesh
// through a triangle. Exactly at a vertex it may slip through: see RayScene.
TEST(RayScene, ClosedMeshesDoNotLeak) {
    for (const bool torus : {false, true}) {
        const Mesh mesh = torus ? make_torus(1.f, 0.3f, 97, 43) : make_icosphere(4);
        RayScene scene;
        scene.add(share(mesh));
        scene.build();
        Random random(4);
        int vertex_misses = 0;
        for (int i = 0; i < 300000; ++i) {
            const Vec3f r = random_direction(random);
            const Point3f o =
                torus ? Point3f{1, 0, 0} + r * (0.25f * random.next()) : r * (0.9f * random.next());
            ASSERT_TRUE(scene.intersect({o, random_direction(random)}));
            const Mesh::Triangle& t = mesh.triangles[random.next_bits() % mesh.triangles.size()];
            const float s = random.next();
            const Point3f edge = mesh.positions[t[0]] * (1 - s) + mesh.positions[t[1]] * s;
            ASSERT_TRUE(scene.intersect({o, toward(o, edge)}));
            vertex_misses += !scene.intersect({o, toward(o, mesh.positions[t[2]])});
        }
        EXPECT_LT(vertex_misses, 3000);
    }
}

// A ray that leaves a flat or convex surface outwards never meets it again, whatever the size and
// place of the shape.
TEST(RayScene, SpawnedRaysDoNotMeetTheirSurface) {
    struct Case {
        double scale, shift;
    };
    for (const Case c :
         {Case{1, 0}, Case{1e-3, 0}, Case{1e4, 0}, Case{1, 1000}, Case{0.01, 50}, Case{1e4, 1e5}}) {
        const Transform map = Transform::translate({c.shift, -2 * c.shift, 0.5 * c.shift}) *
                              Transform::rotate({1, 2, 3}, 33) *
                              Transform::scale({c.scale, c.scale, c.scale});
        RayScene scene;
        const auto moved = [&](Mesh mesh) {
            for (Point3f& p : mesh.positions) p = map.point(p);
            mesh.normals.clear();
            return share(std::move(mesh));
        };
        const auto add_alone = [&](auto shape) {
            scene = RayScene();
            scene.add(shape);
            scene.build();
        };
        for (int shape = 0; shape < 6; ++shape) {
            if (shape == 0) add_alone(moved(make_cube()));
            if (shape == 1) add_alone(moved(make_icosphere(3)));
            if (shape == 2) add_alone(Primitive(Sphere{map.point({0, 0, 0}), float(c.scale)}));
            if (shape == 3) add_alone(Primitive(Disk{map}));
            if (shape == 4) add_alone(Primitive(Cylinder{map}));
            if (shape == 5) add_alone(moved(make_rectangle()));
            Random random(5 + shape);
            for (int i = 0; i < 20000; ++i) {
                Hit hit{0.f, 0, 0, random.next(), random.next()};
                if (const Mesh* mesh = scene.mesh(0)) {
                    hit.primitive = random.next_bits() % mesh->triangles.size();
                    if (hit.u + hit.v > 1) hit.u = 1 - hit.u, hit.v = 1 - hit.v;
                } else if (shape == 3) {
                    hit.u *= 0.7f, hit.v *= -0.7f;
                }
                const SurfacePoint point = scene.surface_point({}, hit);
                Vec3f d = random_direction(random);
                // Half of the directions graze the surface.
                if (i % 2) d = normalize(d - point.ng * (dot(d, point.ng) * 0.999f));
                if (dot(d, point.ng) < 0) d = -d;
                const bool flat = shape == 3 || shape == 5;
                ASSERT_FALSE(scene.occluded({point.spawn(d), d}))
                    << "shape " << shape << " scale " << c.scale << " shift " << c.shift;
                if (flat) {
                    ASSERT_FALSE(scene.occluded({point.spawn(-d), -d}));
                }
                // Inwards the far side is met, and not the near one.
                if (shape == 2 && dot(d, point.ng) > 0.5f) {
                    const auto far = scene.intersect({point.spawn(-d), -d});
                    ASSERT_TRUE(far);
                    ASSERT_NEAR(far->t / (2 * c.scale * dot(d, point.ng)), 1,
                                0.02 + 4e-6 * c.shift / c.scale);
                }
            }
        }
    }
}

TEST(RayScene, SpawnMovesOnlyByRounding) {
    RayScene scene;
    scene.add(share(make_icosphere(3)));
    scene.build();
    const auto hit = scene.intersect({{0, 0, 3}, {0, 0, -1}});
    const SurfacePoint point = scene.surface_point({}, *hit);
    EXPECT_LT(length(point.spawn({0, 0, 1}) - point.p), 1e-6f);
    EXPECT_GT(point.spawn({0, 0, 1}).z, point.p.z);
    EXPECT_LT(point.spawn({0, 0, -1}).z, point.p.z);
}

}  // namespace
}  // namespace nacre
