// Interpolated normals that face away from the viewer: no black rims in a white furnace.
#include "nacre/render/shading_normal.h"
#include "tests/techniques/technique_fixture.h"

namespace nacre {
namespace {

/// A closed mesh with a normal at each vertex; written as OBJ.
struct TestMesh {
    std::vector<Vec3d> p, n;
    std::vector<std::array<int, 3>> triangles;

    std::string obj() const {
        std::string text;
        for (const Vec3d& v : p) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
        for (const Vec3d& v : n) text += fmt::format("vn {} {} {}\n", v.x, v.y, v.z);
        for (const auto& t : triangles)
            text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
        return text;
    }
};

/// An octahedron, its triangles quartered `times` times: 8, 32, 128... triangles, as a sphere.
TestMesh ball(double radius, int times) {
    TestMesh m;
    m.n = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const int x : {0, 1})
        for (const int y : {2, 3})
            for (const int z : {4, 5})
                m.triangles.push_back((x + y + z) % 2 == 0 ? std::array{x, y, z}
                                                           : std::array{y, x, z});
    for (; times > 0; --times) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), int(m.n.size()));
            if (fresh) m.n.push_back(normalize(m.n[std::size_t(a)] + m.n[std::size_t(b)]));
            return at->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (const auto& [a, b, c] : m.triangles) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const auto& t : {std::array{a, ab, ca}, std::array{b, bc, ab},
                                  std::array{c, ca, bc}, std::array{ab, bc, ca}})
                finer.push_back(t);
        }
        m.triangles = std::move(finer);
    }
    for (const Vec3d& n : m.n) m.p.push_back(n * radius);
    return m;
}

/// A torus about the y axis of `around` times `along` quadrilaterals.
TestMesh torus(double large, double small, int around, int along) {
    TestMesh m;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < along; ++j) {
            const double u = 2 * pi * i / around, v = 2 * pi * j / along;
            const Vec3d out{std::cos(u), 0, std::sin(u)};
            m.n.push_back(out * std::cos(v) + Vec3d{0, std::sin(v), 0});
            m.p.push_back(out * large + m.n.back() * small);
            const auto at = [&](int a, int b) { return a % around * along + b % along; };
            m.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return m;
}

class ShadingNormals : public Techniques {
  protected:
    std::string mesh(const TestMesh& m, const std::string& inside, bool face_normals = false) {
        const std::string name = fmt::format("mesh{}.obj", ++count_);
        write(name, m.obj());
        return xml::shape("obj", "<string name=\"filename\" value=\"" + name + "\"/>" +
                                     xml::flag("face_normals", face_normals) + inside);
    }
    /// A nearly white object of some 20 mm.
    static std::string white(const std::string& technique) {
        return "<subsurface type=\"dipole\">" + xml::number("sigma_s", 4) +
               xml::number("sigma_a", 0.0002) + xml::number("int_ior", 1.5) +
               xml::number("ext_ior", 1) + word("method", technique) +
               xml::integer("irradiance_samples", 16) + xml::number("spacing", 2) + "</subsurface>";
    }
    /// Parallel rays of a picture of side x side pixels over 30 mm, from above: those that meet
    /// something, each radiance the mean of `samples`; not a number where they meet nothing.
    std::vector<double> picture(const Scene& s, const RenderPlan& plan, int side, int samples) {
        const Vec3f d = normalize(Vec3f{-0.3f, -0.45f, -0.84f});
        const Framef around = Framef::around(d);
        const auto ray_at = [=](int x, int y) {
            const auto place = [=](int i) {
                return 30.f * ((float(i) + 0.5f) / float(side) - 0.5f);
            };
            return Ray{Point3f{} + around.to_world({place(x), place(y), -60.f}), d};
        };
        FrameSettings frame;
        frame.film.width = frame.film.height = side;
        frame.film.filter.type = "box";
        frame.sampler = {"independent", samples, 5};
        frame.camera = std::make_shared<RayCamera>([=](Vec2f film, Vec2f) {
            return ray_at(int(film.x * float(side)), int(film.y * float(side)));
        });
        const Film film = prepare(s, plan)->render(frame).film;
        std::vector<double> result;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                result.push_back(s.rays.intersect(ray_at(x, y)) ? double(film.mean(x, y).y)
                                                                : std::nan(""));
        return result;
    }
    struct Object {
        std::string name;
        TestMesh mesh;
        bool face_normals = false;
    };
    static std::vector<Object> objects() {
        return {{"hard edges", ball(11, 0), true},
                {"coarse ball", ball(11, 1)},
                {"ball", ball(11, 2)},
                {"coarse torus", torus(8, 4, 8, 6)},
                {"fine ball", ball(11, 4)}};
    }

  private:
    int count_ = 0;
};

TEST_F(ShadingNormals, MakeNoDarkPixelUnderAnyTechnique) {
    constexpr int side = 24, samples = 64;
    for (const Object& object : objects())
        for (const TechniqueDescription* t : techniques()) {
            if (!t->below) continue;
            const Scene s =
                scene(xml::integrator("path") + xml::constant_light() +
                      mesh(object.mesh, white(std::string(t->name)), object.face_normals));
            int seen = 0;
            for (const double v : picture(s, plan_of(s), side, samples)) {
                if (std::isnan(v)) continue;
                ++seen;
                EXPECT_GT(v, 0.5) << object.name << ", " << t->name;
            }
            EXPECT_GT(seen, 100) << object.name;
        }
}

TEST_F(ShadingNormals, MakeNoDarkPixelBehindRoughBoundaries) {
    // Such an object shows more than 0.9 in complete simulation.
    const std::string inside =
        xml::bsdf("roughdielectric", word("distribution", "ggx") + xml::number("alpha", 0.1) +
                                         xml::number("int_ior", 1.5) + xml::number("ext_ior", 1)) +
        xml::medium("interior", xml::number("sigma_s", 4) + xml::number("sigma_a", 0.0002));
    for (const Object& object : objects())
        for (const char* technique : {"brdf", "surface"}) {
            const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                                  mesh(object.mesh, inside, object.face_normals));
            for (const double v : picture(s, plan_of(s, {technique}), 24, 128))
                EXPECT_FALSE(v < 0.5) << v << " " << object.name << ", " << technique;
        }
}

TEST_F(ShadingNormals, MakeNoBlackPixelOnOpaqueObjects) {
    // A lobe whose middle lies at the horizon loses half of its light below, and facets some more.
    constexpr double half_a_lobe = 0.45, nearly_white = 0.8;
    const std::string rough = word("distribution", "ggx") + xml::number("alpha", 0.2);
    struct Opaque {
        const char* type;
        std::string inside;
        double least;
    };
    const Opaque materials[] = {
        {"diffuse", xml::rgb("reflectance", {1, 1, 1}), nearly_white},
        {"conductor", "", nearly_white},
        {"roughconductor", rough, half_a_lobe},
        {"plastic", xml::rgb("diffuse_reflectance", {1, 1, 1}), nearly_white},
        {"roughplastic", rough + xml::rgb("diffuse_reflectance", {1, 1, 1}), half_a_lobe}};
    for (const char* integrator : {"path", "volpath"})
        for (const Object& object : objects())
            for (const Opaque& m : materials) {
                const Scene s =
                    scene(xml::integrator(integrator) + xml::constant_light() +
                          mesh(object.mesh, xml::bsdf(m.type, m.inside), object.face_normals));
                for (const double v : picture(s, plan_of(s), 20, 400))
                    EXPECT_FALSE(v < m.least) << v << " " << object.name << ", " << m.type;
            }
}

TEST_F(ShadingNormals, AreTurnedNoMoreThanNeeded) {
    const auto point = [](const Vec3f& n) {
        SurfacePoint at;
        at.ng = {0.f, 0.f, 1.f};
        at.shading = Framef::with_tangent(normalize(n), {1.f, 0.f, 0.f});
        return at;
    };
    const Vec3f grazing = normalize(Vec3f{0.95f, 0.1f, 0.2f});
    for (const float side : {1.f, -1.f})
        for (const bool mirrors : {true, false}) {
            // Towards the viewer, and straight up: nothing to do, not a bit.
            for (const Vec3f& n : {Vec3f{0.3f, 0.f, 1.f}, Vec3f{0.f, 0.f, 1.f}}) {
                SurfacePoint at = point(n);
                const SurfacePoint before = at;
                EXPECT_FALSE(turn_to_viewer(at, grazing * side, mirrors));
                EXPECT_EQ(at.shading.n, before.shading.n);
                EXPECT_EQ(at.shading.s, before.shading.s);
            }
            // Away from him, in many directions.
            for (int i = 0; i < 200; ++i) {
                const float phi = 0.1f * float(i), tilt = 0.2f + 0.02f * float(i % 50);
                SurfacePoint at = point({tilt * std::cos(phi), tilt * std::sin(phi), 1.f});
                const SurfacePoint before = at;
                const Vec3f wo = grazing * side;
                const bool turned = turn_to_viewer(at, wo, mirrors);
                const float cosine = dot(wo, at.shading.n) * side;
                EXPECT_GT(cosine, 0.f);
                EXPECT_GT(dot(at.shading.n, at.ng), 0.f);
                EXPECT_NEAR(length(at.shading.n), 1., 1e-5);
                EXPECT_NEAR(dot(at.shading.n, at.shading.s), 0., 1e-5);
                if (mirrors) {
                    EXPECT_GE(dot(at.shading.n * (2.f * dot(wo, at.shading.n)) - wo, at.ng) * side,
                              -1e-6f);
                } else {
                    EXPECT_EQ(turned, dot(wo, before.shading.n) * side <= 0.f);
                }
                // Once turned, there is nothing left to turn.
                EXPECT_FALSE(turned && turn_to_viewer(at, wo, mirrors));
            }
        }
    // For a mirror: the viewer sees the normal, but the mirrored direction leads below.
    SurfacePoint at = point({-0.12f, 0.f, 1.f});
    EXPECT_FALSE(turn_to_viewer(at, grazing, false));
    EXPECT_TRUE(turn_to_viewer(at, grazing, true));
}

}  // namespace
}  // namespace nacre
