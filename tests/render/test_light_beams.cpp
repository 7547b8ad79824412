// Ways of light through one smooth boundary to a point below it: closed forms of flat and round
// boundaries, and brute force with a light of a degree.
#include "nacre/geometry/tessellate.h"
#include "nacre/optics/fresnel.h"
#include "nacre/render/light_beams.h"
#include "nacre/render/shadow_ray.h"
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

std::vector<LightBeams::Way> ways(const LightBeams& beams, const Point3f& y) {
    std::vector<LightBeams::Way> found;
    std::vector<std::uint32_t> scratch;
    beams.find(y, 1e30f, found, scratch);
    return found;
}

class LightBeamsTest : public RenderTest {
  protected:
    static std::string directional(const Vec3d& towards) {
        return fmt::format(
            "<emitter type=\"directional\"><vector name=\"direction\" x=\"{}\" y=\"{}\" "
            "z=\"{}\"/><float name=\"irradiance\" value=\"1\"/></emitter>",
            towards.x, towards.y, towards.z);
    }
    static std::string point(const Vec3d& at) {
        return fmt::format(
            "<emitter type=\"point\"><point name=\"position\" x=\"{}\" y=\"{}\" z=\"{}\"/>"
            "<float name=\"intensity\" value=\"1\"/></emitter>",
            at.x, at.y, at.z);
    }
    static std::string matter(double eta) {
        return xml::dielectric(eta) +
               xml::medium("interior", xml::number("sigma_t", 1) + xml::number("albedo", 0.9));
    }
    static std::string slab(double eta) {
        return xml::shape("cube",
                          "<transform name=\"to_world\"><scale x=\"50\" y=\"1\" z=\"50\"/>"
                          "<translate y=\"-1\"/></transform>" +
                              matter(eta));
    }
    Scene lit(const std::string& light, const std::string& shapes) {
        return scene(xml::integrator("volpath") + light + shapes);
    }
};

TEST_F(LightBeamsTest, FlatBoundaryUnderParallelLight) {
    for (const double eta : {1.3, 1.5, 2.4})
        for (const double degrees : {0., 30., 60., 85.}) {
            const double sine = std::sin(degrees * pi / 180), cosine = std::cos(degrees * pi / 180);
            const Scene s = lit(directional({sine, -cosine, 0}), slab(eta));
            const LightBeams beams(s);
            for (const Point3f y : {Point3f(0.3f, -0.1f, 0.2f), Point3f(-3, -1.7f, 2)}) {
                const auto found = ways(beams, y);
                ASSERT_EQ(found.size(), 1u) << eta << ", " << degrees;
                const double cos_in = std::sqrt(1 - sine * sine / (eta * eta));
                EXPECT_NEAR(found[0].length, -y.y / cos_in, 1e-5);
                EXPECT_NEAR(found[0].inside.y, cos_in, 1e-6);
                EXPECT_NEAR(found[0].inside.x, -sine / eta, 1e-6);
                EXPECT_NEAR(found[0].gain, (1 - fresnel_dielectric(cosine, eta)) * cosine / cos_in,
                            1e-6);
            }
        }
}

// A point at height h over the surface, seen from depth z below it and a distance x aside: the
// place of entry follows from Snell's law by bisection. Of the light's intensity, what is within
// an angle reaches an area: gain / s^2 = T dOmega / dA, with the area across the ray inside.
TEST_F(LightBeamsTest, FlatBoundaryUnderAPoint) {
    const double eta = 1.5, h = 2;
    const Scene s = lit(point({0, h, 0}), slab(eta));
    const LightBeams beams(s);
    for (const double x : {0.01, 0.7, 3., 8.})
        for (const double z : {0.05, 0.5, 1.9}) {
            double low = 0, high = x;
            for (int i = 0; i < 100; ++i) {
                const double r = 0.5 * (low + high);
                const double out = r / std::hypot(r, h), in = (x - r) / std::hypot(x - r, z);
                (out > eta * in ? high : low) = r;
            }
            const double r = low, s2 = r * r + h * h, sine = r / std::sqrt(s2),
                         cosine = h / std::sqrt(s2);
            const double cos_in = std::sqrt(1 - sine * sine / (eta * eta));
            // x(theta) = h tan theta + z tan theta', sin theta = eta sin theta'.
            const double dx = h / (cosine * cosine) + z * cosine / (eta * std::pow(cos_in, 3));
            const double per_area = sine / (x * dx * cos_in);
            const auto found = ways(beams, Point3f(Vec3d{0.6 * x, -z, 0.8 * x}));
            ASSERT_EQ(found.size(), 1u) << x << ", " << z;
            EXPECT_NEAR(found[0].gain / s2, (1 - fresnel_dielectric(cosine, eta)) * per_area,
                        2e-5 * found[0].gain / s2);
            EXPECT_NEAR(found[0].at.p.x, 0.6 * r, 1e-5);
        }
}

// On the axis of a ball parallel light is gathered as by a lens of focal length eta R / (eta - 1),
// and light of a point at distance s as by one with the image where eta / b = (eta - 1) / R - 1 / s.
TEST_F(LightBeamsTest, AxisOfABall) {
    const double eta = 1.5, radius = 2, s = 5;
    const std::string ball = xml::sphere({0, 0, 0}, radius, matter(eta));
    const double transmitted = 1 - std::pow((eta - 1) / (eta + 1), 2);
    for (const bool distant : {true, false}) {
        const Scene scene =
            lit(distant ? directional({0, 0, -1}) : point({0, 0, radius + s}), ball);
        const LightBeams beams(scene);
        for (const double depth : {0.1, 1., 2., 3.5}) {
            const auto found = ways(beams, Point3f(Vec3d{1e-3, 1e-3, radius - depth}));
            ASSERT_EQ(found.size(), 1u) << depth;
            const double image = eta / ((eta - 1) / radius - (distant ? 0 : 1 / s));
            EXPECT_NEAR(found[0].gain, transmitted / std::pow(1 - depth / image, 2),
                        1e-4 * found[0].gain);
        }
    }
}

std::string obj_of(const Mesh& mesh) {
    std::string text;
    for (const Point3f& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const Vec3f& n : mesh.normals) text += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
    for (const Mesh::Triangle& t : mesh.triangles)
        text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return text;
}

/// The irradiance at y from a light of `half_angle` around the direction `to_light` whose own is 1,
/// by directions drawn at y.
RadianceEstimate by_chance(const Scene& scene, const Point3f& y, const Vec3f& to_light,
                           double half_angle, int n) {
    const double radiance = 1 / (pi * std::pow(std::sin(half_angle), 2));
    std::vector<Vec3d> values(200);
    tbb::parallel_for(std::size_t(0), values.size(), [&](std::size_t k) {
        Random random(stream_key(7, k));
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            const float z = 1 - 2 * random.next(), phi = float(2 * pi) * random.next();
            const float r = std::sqrt(std::max(0.f, 1 - z * z));
            const Vec3f d{r * std::cos(phi), r * std::sin(phi), z};
            const auto hit = scene.rays.intersect({y, d});
            if (!hit) continue;
            const SurfacePoint at = scene.rays.surface_point({y, d}, *hit);
            const double eta = scene.shapes[hit->shape].material->smooth_boundary_eta();
            const double cos_in = dot(d, at.shading.n);
            const double sin2 = eta * eta * (1 - cos_in * cos_in);
            if (cos_in <= 0 || sin2 >= 1) continue;
            const double cos_out = std::sqrt(1 - sin2);
            const Vec3f out =
                (d - at.shading.n * float(cos_in)) * float(eta) + at.shading.n * float(cos_out);
            if (dot(out, at.ng) <= 0 || dot(out, to_light) < std::cos(half_angle)) continue;
            const Ray ray{at.spawn(out), out};
            if (scene.rays.occluded(ray)) continue;
            sum += 4 * pi * radiance * eta * eta * (1 - fresnel_dielectric(cos_out, eta));
        }
        values[k] = Vec3d{1, 1, 1} * (sum / n);
    });
    return RadianceEstimate::of(std::move(values));
}

/// The same by the ways.
double by_ways(const Scene& scene, const LightBeams& beams, const Point3f& y,
               const Vec3f& to_light) {
    double sum = 0;
    for (const LightBeams::Way& way : ways(beams, y)) {
        if (scene.rays.occluded({y, way.inside, 0.f, way.length * 0.9999f})) continue;
        if (scene.rays.occluded({way.at.spawn(to_light), to_light})) continue;
        sum += way.gain;
    }
    return sum;
}

// A ball, and one of so few triangles that interpolated normals and the surface's own differ much:
// what the path tracer would see, were the light wide enough to be met.
TEST_F(LightBeamsTest, AgreesWithDirectionsDrawnAtThePoint) {
    const Vec3f to_light = normalize(Vec3f{1, 2, 3});
    const double half_angle = 2 * pi / 180;
    const std::string light = directional(Vec3d(to_light * -1.f));
    write("ball.obj", obj_of(tessellate(Sphere{}, 0.03)));
    const std::map<std::string, std::string> shapes{
        {"ball", xml::sphere({}, 1, matter(1.4))},
        {"few triangles",
         xml::shape("obj",
                    std::string("<string name=\"filename\" value=\"ball.obj\"/>") + matter(1.4))},
        {"flat triangles",
         xml::shape("obj", std::string("<string name=\"filename\" value=\"ball.obj\"/>") +
                               xml::flag("face_normals", true) + matter(1.4))}};
    for (const auto& [name, shape] : shapes) {
        const Scene s = lit(light, shape);
        const LightBeams beams(s);
        double exact = 0, drawn = 0, variance = 0;
        for (int i = 0; i < 8; ++i) {
            Random random(stream_key(3, std::uint64_t(i)));
            const Framef frame = Framef::around(to_light);
            // In the lit half, where the light is smooth over the angle; off the axis.
            const float r = 0.25f + 0.4f * random.next(), phi = float(2 * pi) * random.next();
            const Point3f y = frame.to_world(
                {r * std::cos(phi), r * std::sin(phi), -0.2f + 0.8f * random.next()});
            const RadianceEstimate e = by_chance(s, y, to_light, half_angle, 700);
            exact += by_ways(s, beams, y, to_light);
            drawn += e.mean.x;
            variance += e.error.x * e.error.x;
        }
        EXPECT_NEAR(exact, drawn, 3.5 * std::sqrt(variance)) << name;
        EXPECT_LT(std::sqrt(variance), 0.12 * drawn) << name;
    }
}

}  // namespace
}  // namespace nacre
