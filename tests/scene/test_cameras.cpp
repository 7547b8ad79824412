#include "nacre/math/random.h"
#include "nacre/scene/build.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

class Cameras : public SceneFiles {
  protected:
    CameraPtr camera(const std::string& type, const std::string& parameters, float aspect = 1.f) {
        root_ = read("<sensor type=\"" + type + "\">" + parameters + "</sensor>");
        return make_camera(*root_->children.at(0).node, aspect, context_);
    }

    SceneNodePtr root_;
    BuildContext context_;
};

std::string number_xml(const std::string& name, double value) {
    return fmt::format("<float name=\"{}\" value=\"{}\"/>", name, value);
}
std::string text_xml(const std::string& name, const std::string& value) {
    return fmt::format("<string name=\"{}\" value=\"{}\"/>", name, value);
}

void expect_near(const Vec3f& a, const Vec3f& b, float tolerance = 1e-6f) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST_F(Cameras, FieldOfViewMeasuresTheNamedAxis) {
    // The camera sees 90 degrees along the axis, so half of that side is at distance 1 from the
    // centre of the plane z = 1. In camera space x points to the left of the picture.
    struct Case {
        const char* axis;
        float aspect;
        float right, top;  ///< tangents at the middle of the right and of the upper edge
    };
    const float diagonal = 1.f / std::sqrt(5.f);  // of a film 2 wide and 1 high
    for (const Case& c : {Case{"x", 2.f, 1.f, 0.5f},
                          {"y", 2.f, 2.f, 1.f},
                          {"smaller", 2.f, 2.f, 1.f},
                          {"larger", 2.f, 1.f, 0.5f},
                          {"smaller", 0.5f, 1.f, 2.f},
                          {"larger", 0.5f, 0.5f, 1.f},
                          {"diagonal", 2.f, 2.f * diagonal, diagonal}}) {
        SCOPED_TRACE(fmt::format("{} {}", c.axis, c.aspect));
        const CameraPtr made =
            camera("perspective", number_xml("fov", 90) + text_xml("fov_axis", c.axis), c.aspect);
        expect_near(made->ray({1.f, 0.5f}, {}).d, normalize(Vec3f(-c.right, 0.f, 1.f)));
        expect_near(made->ray({0.5f, 0.f}, {}).d, normalize(Vec3f(0.f, c.top, 1.f)));
        expect_near(made->ray({0.5f, 0.5f}, {}).d, {0.f, 0.f, 1.f});
    }
}

TEST_F(Cameras, FocalLengthIsThatOf35MillimetreFilm) {
    // The corner of the film lies at half the diagonal of 36 mm x 24 mm, whatever its shape.
    for (const float aspect : {1.5f, 1.f, 0.4f}) {
        for (const auto& [parameters, mm] : {std::pair{text_xml("focal_length", "35mm"), 35.f},
                                             {text_xml("focal_length", "85"), 85.f},
                                             {std::string(), 50.f}}) {
            const Vec3f d = camera("perspective", parameters, aspect)->ray({0.f, 0.f}, {}).d;
            EXPECT_NEAR(std::hypot(d.x, d.y) / d.z, std::hypot(18.f, 12.f) / mm, 1e-5f);
        }
    }
}

TEST_F(Cameras, LookAtHasTheRightOfThePictureOnTheRight) {
    const CameraPtr made =
        camera("perspective", number_xml("fov", 90) +
                                  "<transform name=\"to_world\"><lookat origin=\"1, 2, 10\" "
                                  "target=\"1, 2, 0\" up=\"0, 1, 0\"/></transform>");
    const Ray ray = made->ray({1.f, 0.25f}, {});
    expect_near(ray.o, {1.f, 2.f, 10.f});
    expect_near(ray.d, normalize(Vec3f(1.f, 0.5f, -1.f)));
}

TEST_F(Cameras, PrincipalPointMovesThePicture) {
    // Mitsuba adds the offset to the film position.
    const CameraPtr made =
        camera("perspective", number_xml("fov", 90) + number_xml("principal_point_offset_x", 0.25) +
                                  number_xml("principal_point_offset_y", -0.1));
    expect_near(made->ray({0.25f, 0.6f}, {}).d, {0.f, 0.f, 1.f});
}

TEST_F(Cameras, RaysRunFromTheNearToTheFarPlane) {
    for (const char* type : {"perspective", "thinlens", "orthographic"}) {
        SCOPED_TRACE(type);
        const CameraPtr made =
            camera(type, (type[0] == 'o' ? std::string() : number_xml("fov", 60)) +
                             (type[0] == 't' ? number_xml("aperture_radius", 0.3) : std::string()) +
                             number_xml("near_clip", 0.5) + number_xml("far_clip", 20));
        const Ray ray = made->ray({0.1f, 0.8f}, {0.9f, 0.2f});
        EXPECT_NEAR(length(ray.d), 1.f, 1e-6f);
        EXPECT_NEAR((ray.o + ray.d * ray.tmin).z, 0.5f, 1e-5f);
        EXPECT_NEAR((ray.o + ray.d * ray.tmax).z, 20.f, 1e-4f);
    }
}

TEST_F(Cameras, ThinLensFocusesOnePlaneToAPoint) {
    const CameraPtr pinhole = camera("perspective", number_xml("fov", 50), 1.2f);
    const CameraPtr lens = camera("thinlens",
                                  number_xml("fov", 50) + number_xml("aperture_radius", 0.25) +
                                      number_xml("focus_distance", 3),
                                  1.2f);
    const Vec2f film{0.2f, 0.7f};
    const Vec3f d = pinhole->ray(film, {}).d;
    const Point3f focus = d * (3.f / d.z);
    Random random(7);
    double radius2 = 0.0;
    const int count = 4000;
    for (int i = 0; i < count; ++i) {
        const Ray ray = lens->ray(film, random.next2());
        expect_near(ray.o + ray.d * ((3.f - ray.o.z) / ray.d.z), focus, 2e-6f);
        EXPECT_EQ(ray.o.z, 0.f);
        const double r2 = length_squared(ray.o);
        EXPECT_LE(r2, 0.25 * 0.25 * 1.000001);
        radius2 += r2;
    }
    // A uniform disk has a mean square radius of R^2 / 2, with standard deviation R^2 / sqrt(12).
    EXPECT_NEAR(radius2 / count / (0.25 * 0.25), 0.5, 3.0 / std::sqrt(12.0 * count));
}

TEST_F(Cameras, OrthographicFilmIsTwoUnitsWide) {
    const CameraPtr made = camera("orthographic", "", 2.f);
    const Ray ray = made->ray({0.f, 1.f}, {});
    expect_near(ray.o, {1.f, -0.5f, 0.f});
    expect_near(ray.d, {0.f, 0.f, 1.f});
    // The usual way to frame a scene: a scale in to_world.
    const Ray scaled =
        camera("orthographic",
               "<transform name=\"to_world\"><scale x=\"10\" y=\"10\"/></transform>", 2.f)
            ->ray({0.f, 1.f}, {});
    expect_near(scaled.o, {10.f, -5.f, 0.f}, 1e-5f);
}

TEST_F(Cameras, WrongInputIsExplained) {
    const std::string at = "scene.xml:2:";
    struct Case {
        const char* type;
        std::string parameters, message;
    };
    for (const Case& c : {
             Case{"perspektive", "",
                  "unknown sensor type 'perspektive'; did you mean 'perspective'?"},
             {"perspective", number_xml("fov", 180),
              "fov must lie between 0 and 180 degrees; got 180"},
             {"perspective", number_xml("fov", 40) + text_xml("focal_length", "50mm"),
              "give either fov or focal_length, not both"},
             {"perspective", text_xml("focal_length", "50cm"),
              "focal_length must be a length in millimetres such as '50mm'; got '50cm'"},
             {"perspective", number_xml("fov", 40) + text_xml("fov_axis", "z"),
              "'fov_axis' of <sensor type=\"perspective\"> cannot be 'z'; known are: x, y, "
              "diagonal, "
              "smaller, larger"},
             {"perspective", number_xml("near_clip", 0), "near_clip must be greater than 0; got 0"},
             {"perspective", number_xml("near_clip", 2) + number_xml("far_clip", 1),
              "far_clip must be greater than near_clip; got 1 and 2"},
             {"perspective", number_xml("fow", 40),
              "<sensor type=\"perspective\"> has no parameter 'fow'; did you mean 'fov'?"},
             {"thinlens", number_xml("fov", 40),
              "<sensor type=\"thinlens\"> needs a float "
              "'aperture_radius'"},
             {"thinlens", number_xml("aperture_radius", -1),
              "aperture_radius must not be negative; got -1"},
             {"thinlens", number_xml("aperture_radius", 1) + number_xml("focus_distance", 0),
              "focus_distance must be greater than 0; got 0"},
         }) {
        const std::string error = error_of([&] { camera(c.type, c.parameters); });
        EXPECT_TRUE(error.starts_with(at)) << error;
        EXPECT_EQ(error.substr(std::min(error.size(), error.find(' ') + 1)), c.message);
    }
}

}  // namespace
}  // namespace nacre
