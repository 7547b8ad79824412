// From a scene file to a Scene: defaults, shapes, what the file leaves open.
#include "nacre/spectrum/color.h"
#include "tests/scene/scene_files.h"
#include "tests/support/bound.h"

namespace nacre {
namespace {

class LoadScene : public SceneFiles {
  protected:
    Scene load(const std::string& body) {
        return load_scene(
            write("scene.xml", "<scene version=\"3.0.0\">\n" + body + "\n</scene>\n"));
    }
    /// Normal and distance where the ray first meets the scene.
    std::pair<float, Vec3f> meet(const Scene& scene, const Point3f& o, const Vec3f& d) {
        const Ray ray{o, d};
        const auto hit = scene.rays.intersect(ray);
        if (!hit) return {-1.f, {}};
        return {hit->t, scene.rays.surface_point(ray, *hit).ng};
    }
};

TEST_F(LoadScene, DefaultsAreMitsubas) {
    const Scene scene = load(R"(<emitter type="constant"/><sensor type="perspective"/>)");
    EXPECT_EQ(scene.integrator.type, "path");
    EXPECT_EQ(scene.integrator.max_depth, -1);
    EXPECT_EQ(scene.integrator.rr_depth, 5);
    EXPECT_FALSE(scene.integrator.hide_emitters);
    EXPECT_EQ(scene.film.width, 768);
    EXPECT_EQ(scene.film.height, 576);
    EXPECT_EQ(scene.film.filter.type, "gaussian");
    EXPECT_EQ(scene.sampler.type, "independent");
    EXPECT_EQ(scene.sampler.samples, 4);
    EXPECT_EQ(scene.mm_per_unit, 1.0);
    EXPECT_EQ(scene.camera_medium, nullptr);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(LoadScene, SaysThatAllLightsAreBlack) {
    const std::string
        rest = R"(<sensor type="perspective"/><shape type="sphere"/>)",
        sky = R"(<emitter type="constant"><float name="radiance" value="0"/></emitter>)",
        lamp = R"(<emitter type="point"><float name="intensity" value="0"/></emitter>)";
    EXPECT_EQ(load(sky + lamp + rest).warnings,
              std::vector<std::string>{"the scene's lights are black, and so is the picture"});
    EXPECT_TRUE(load(sky + R"(<emitter type="point"/>)" + rest).warnings.empty());
}

TEST_F(LoadScene, WithoutSensorTheSceneIsFramed) {
    const Scene scene = load(R"(<shape type="sphere"><point name="center" value="5, 6, 7"/>
        <float name="radius" value="3"/></shape>)");
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_TRUE(scene.warnings[0].ends_with(":1:1: the scene has no light: the picture is black"));
    EXPECT_TRUE(scene.warnings[1].ends_with(
        ":1:1: the scene has no <sensor>; a camera that frames it is used"));
    EXPECT_TRUE(scene.rays.intersect(scene.camera->ray({0.5f, 0.5f}, {})));
    for (int i = 0; i <= 10; ++i)
        for (const Vec2f film :
             {Vec2f{i * 0.1f, 0.f}, {i * 0.1f, 1.f}, {0.f, i * 0.1f}, {1.f, i * 0.1f}})
            EXPECT_FALSE(scene.rays.intersect(scene.camera->ray(film, {})));
}

TEST_F(LoadScene, CropWindowReachesTheEdge) {
    const Scene scene = load(R"(<emitter type="constant"/><sensor type="perspective">
        <film type="hdrfilm"><integer name="width" value="100"/><integer name="height" value="50"/>
            <integer name="crop_offset_x" value="30"/><integer name="crop_height" value="10"/>
            <string name="quantity" value="luminance"/><string name="pixel_format" value="rgba"/>
            <rfilter type="mitchell"><float name="A" value="0"/></rfilter></film></sensor>)");
    EXPECT_EQ(scene.film.crop_x, 30);
    EXPECT_EQ(scene.film.crop_width, 70);
    EXPECT_EQ(scene.film.crop_y, 0);
    EXPECT_EQ(scene.film.crop_height, 10);
    EXPECT_EQ(scene.film.quantity, FilmQuantity::luminance);
    EXPECT_EQ(scene.film.filter.b, 0.f);
    EXPECT_NEAR(scene.film.filter.c, 1.f / 3.f, 1e-6f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(scene.warnings[0].ends_with("pixel_format 'rgba' is written as rgb"));
}

TEST_F(LoadScene, CylinderStandsBetweenItsEnds) {
    const Scene scene = load(R"(<shape type="cylinder"><point name="p0" x="1" y="-2"/>
        <point name="p1" x="1" y="4"/><float name="radius" value="0.5"/></shape>)");
    const auto [t, n] = meet(scene, {1, 3.9f, 10}, {0, 0, -1});
    EXPECT_NEAR(t, 9.5f, 1e-5f);
    EXPECT_NEAR(n.z, 1.f, 1e-5f);
    EXPECT_LT(meet(scene, {1, 4.1f, 10}, {0, 0, -1}).first, 0.f);
    EXPECT_LT(meet(scene, {1, -2.1f, 10}, {0, 0, -1}).first, 0.f);
}

TEST_F(LoadScene, OutsideStaysOutsideInTheMirror) {
    for (const char* flip : {"false", "true"}) {
        const Scene scene = load(fmt::format(
            R"(<shape type="cube"><boolean name="flip_normals" value="{}"/>
            <transform name="to_world"><scale x="-2"/></transform></shape>)",
            flip));
        const auto [t, n] = meet(scene, {10, 0.1f, 0.2f}, {-1, 0, 0});
        EXPECT_NEAR(t, 8.f, 1e-5f);
        EXPECT_NEAR(n.x, std::string(flip) == "true" ? -1.f : 1.f, 1e-5f);
    }
}

TEST_F(LoadScene, TextureAndTangentsOfASphereTurnWithIt) {
    // What the unit sphere has at p, a turned one has at the image of p; Mitsuba 3.9.1 has u, v =
    // 0.4136, 0.4196 at (0.25, 0.5, 0.8292) of a sphere turned by 90 degrees about y.
    const Scene plain = load(R"(<shape type="sphere"/>)");
    const Scene turned = load(R"(<shape type="sphere"><transform name="to_world">
        <scale value="2"/><rotate x="1" y="2" z="3" angle="70"/><translate x="1"/>
        </transform></shape>)");
    const Scene known = load(R"(<shape type="sphere"><transform name="to_world">
        <rotate y="1" angle="90"/></transform></shape>)");
    const auto look = [](const Scene& scene, const Vec3f& o, const Vec3f& d) {
        const Ray ray{o, d};
        return scene.rays.surface_point(ray, scene.rays.intersect(ray).value());
    };
    const SurfacePoint at = look(known, {0.25f, 0.5f, 5.f}, {0, 0, -1});
    EXPECT_NEAR(at.uv.x, 0.4136, 1e-4);
    EXPECT_NEAR(at.uv.y, 0.4196, 1e-4);
    const Transform map = Transform::translate({1, 0, 0}) * Transform::rotate({1, 2, 3}, 70) *
                          Transform::scale({2, 2, 2});
    for (const Vec3f p : {Vec3f{1, 0.2f, 0.3f}, Vec3f{-1, 2, 0.7f}, Vec3f{0.1f, -0.4f, -2}}) {
        const Vec3f d = normalize(p);
        const SurfacePoint a = look(plain, d * 3.f, -d);
        const SurfacePoint b =
            look(turned, map.point(d * 3.f), -normalize(Vec3f(map.map_vector(Vec3d(d)))));
        EXPECT_NEAR(a.uv.x, b.uv.x, 1e-5);
        EXPECT_NEAR(a.uv.y, b.uv.y, 1e-5);
        const Vec3d tangent = normalize(map.map_vector(Vec3d(a.shading.s)));
        EXPECT_NEAR(length(tangent - Vec3d(b.shading.s)), 0, 1e-5);
    }
}

TEST_F(LoadScene, MeshesWithoutNormalsAreSmoothButForHardEdges) {
    // Two faces of a roof, at a right angle; where the ridge is smooth its normal points straight
    // up.
    write("roof.off", "OFF\n4 2 0\n-1 0 0\n0 1 1\n0 1 -1\n1 0 0\n3 0 1 2\n3 3 2 1\n");
    const std::pair<const char*, bool> cases[] = {
        {"", false},
        {R"(<float name="crease_angle" value="180"/>)", true},
        {R"(<float name="crease_angle" value="91"/>)", true},
        {R"(<float name="crease_angle" value="89"/>)", false},
        {R"(<float name="crease_angle" value="0"/>)", false},
        {R"(<float name="crease_angle" value="180"/><boolean name="face_normals" value="true"/>)",
         false}};
    for (const auto& [parameters, smooth] : cases) {
        const Scene scene = load(
            fmt::format(R"(<shape type="off"><string name="filename" value="roof.off"/>{}</shape>)",
                        parameters));
        const Ray ray{{-1e-4f, 5, 0}, {0, -1, 0}};
        const auto hit = scene.rays.intersect(ray);
        ASSERT_TRUE(hit);
        const SurfacePoint at = scene.rays.surface_point(ray, *hit);
        EXPECT_NEAR(at.shading.n.y, smooth ? 1.f : std::sqrt(0.5f), 1e-3f) << parameters;
        EXPECT_NEAR(at.ng.y, std::sqrt(0.5f), 1e-5f);
    }
}

TEST_F(LoadScene, InsideOutIsSaidAsFlipNormalsLeavesIt) {
    // A tetrahedron with its outside outside, and one turned round.
    const std::string corners = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    write("good.off", corners + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    write("turned.off", corners + "3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n");
    const auto warnings = [&](const std::string& type, const std::string& parameters, bool flip) {
        const Scene scene =
            load(fmt::format(R"(<shape type="{}">{}<boolean name="flip_normals" value="{}"/>
            <bsdf type="dielectric"/><medium name="interior" type="homogeneous"/></shape>)",
                             type, parameters, flip));
        std::vector<std::string> found;  // those about the surface
        for (const std::string& w : scene.warnings)
            if (w.find("surface") != w.npos) found.push_back(w);
        return found;
    };
    const auto file = [](const char* name) {
        return fmt::format(R"(<string name="filename" value="{}"/>)", name);
    };
    EXPECT_TRUE(warnings("off", file("good.off"), false).empty());
    EXPECT_TRUE(warnings("off", file("turned.off"), true).empty());
    const auto turned = warnings("off", file("turned.off"), false);
    ASSERT_EQ(turned.size(), 1u);
    EXPECT_TRUE(turned[0].ends_with(
        "the surface is inside out (its volume is negative); the medium would fill the outside: "
        "turn the triangles round or set flip_normals"))
        << turned[0];
    for (const auto& shape :
         {std::pair{"off", file("good.off")}, {"cube", std::string()}, {"sphere", std::string()}}) {
        const auto flipped = warnings(shape.first, shape.second, true);
        ASSERT_EQ(flipped.size(), 1u) << shape.first;
        EXPECT_TRUE(
            flipped[0].ends_with("': flip_normals turns the surface inside out; the medium "
                                 "would fill the outside: leave it out"))
            << flipped[0];
    }
    for (const char* open : {"disk", "cylinder"}) {
        const auto found = warnings(open, "", false);
        ASSERT_EQ(found.size(), 1u) << open;
        EXPECT_TRUE(
            found[0].ends_with("': the surface is open by itself; light in the medium "
                               "inside gets lost unless other shapes close it"))
            << found[0];
    }
}

TEST_F(LoadScene, MediaThatMeetAreSaid) {
    const auto box = [](double x, double scale = 1) {
        return fmt::format(
            R"(<shape type="cube"><transform name="to_world"><scale value="{}"/>
            <translate x="{}"/></transform><bsdf type="dielectric"/>
            <medium name="interior" type="homogeneous"/></shape>)",
            scale, x);
    };
    const std::string names = "'cube' and 'cube' (shapes 0 and 1, counted from 0) have media and ";
    const std::string overlap = names +
                                "overlap: light is gained or lost where both are; let one end "
                                "where the other begins";
    const std::string touch = names +
                              "touch face to face: light is gained or lost where two surfaces "
                              "coincide; leave a gap or make them one";
    const std::string camera = R"(<sensor type="perspective"><transform name="to_world">
        <lookat origin="{0}, 0, 0" target="{0}, 0, 1" up="0, 1, 0"/></transform>{1}</sensor>)";
    const auto found = [&](const std::string& body) {
        std::string all;
        for (const std::string& w : load(body).warnings)
            if (w.find("medium") != w.npos || w.find("media") != w.npos) all += w;
        return all;
    };
    const auto outside = fmt::format(fmt::runtime(camera), 9, "");
    EXPECT_EQ(found(outside + box(-1.5) + box(1.5)), "");
    EXPECT_EQ(found(outside + box(-1) + box(1)), touch);
    EXPECT_EQ(found(outside + box(-0.75) + box(0.75)), overlap);
    EXPECT_EQ(found(outside + box(0) + box(0, 0.5)), "") << "one wholly inside the other";
    // Inscribed: its poles lie on the cube's sides, facing the same way.
    EXPECT_EQ(found(outside + box(0) +
                    R"(<shape type="sphere"><bsdf type="dielectric"/>
                    <medium name="interior" type="homogeneous"/></shape>)"),
              "");
    EXPECT_EQ(found(fmt::format(fmt::runtime(camera), 0, "") + box(0)),
              "the camera stands in a medium but does not say so, and light reaches it as through "
              "nothing: give the sensor that <medium>, by <ref>, too");
    EXPECT_EQ(
        found(fmt::format(fmt::runtime(camera), 0, R"(<medium type="homogeneous"/>)") + box(0)),
        "");
}

TEST_F(LoadScene, ShiningShapesAreBlackByDefault) {
    const Scene scene = load(R"(<shape type="sphere"><emitter type="area"/></shape>
        <shape type="sphere"><point name="center" x="5"/></shape>)");
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.shapes[0].light, scene.lights[0].get());
    EXPECT_EQ(scene.shapes[1].light, nullptr);
    const test::Bound shining(scene.shapes[0].material), other(scene.shapes[1].material);
    EXPECT_EQ(shining->eval({0, 0, 1}, {0, 0, 1})[0], 0.f);
    // Half of the light, over pi.
    EXPECT_NEAR(other->eval({0, 0, 1}, {0, 0, 1})[0], 0.5f / 3.14159265f, 1e-6f);
}

TEST_F(LoadScene, LightsSurviveMovingTheScene) {
    Scene first = load(R"(<shape type="sphere"><emitter type="area"/></shape>)");
    const Scene scene = std::move(first);
    const LightSample s =
        scene.lights[0]->sample({0, 0, 5}, {0.5f, 0.5f}, Wavelengths::rgb_bands());
    EXPECT_GT(s.pdf, 0.f);
    EXPECT_NEAR(s.radiance[0], 1.f, 1e-5f);
}

TEST_F(LoadScene, WavelengthDataAskForWavelengths) {
    const char* bodies[] = {
        R"(<emitter type="constant"><blackbody name="radiance" temperature="3000"/></emitter>)",
        R"(<emitter type="constant"/><shape type="sphere"><bsdf type="diffuse">
            <spectrum name="reflectance" value="400:0.1, 700:0.9"/></bsdf></shape>)",
        R"(<emitter type="constant"/><medium type="homogeneous" id="m">
            <spectrum name="sigma_t" value="400:1, 700:2"/></medium>)",
    };
    for (const char* body : bodies) EXPECT_EQ(load(body).mode, ColorMode::spectral) << body;
    const char* rgb = R"(<emitter type="constant"><spectrum name="radiance" value="2"/></emitter>)";
    EXPECT_EQ(load(rgb).mode, ColorMode::rgb_bands);
    EXPECT_EQ(load_scene(folder_ / "scene.xml", {.mode = ColorMode::spectral}).mode,
              ColorMode::spectral);
}

TEST_F(LoadScene, WarnsOfMediaThatCannotWork) {
    const Scene scene = load(R"(<emitter type="constant"/><sensor type="perspective">
        <transform name="to_world"><translate z="9"/></transform></sensor><medium type="homogeneous" id="m"/>
        <shape type="rectangle" id="pane"><bsdf type="null"/><ref name="interior" id="m"/></shape>
        <shape type="sphere" id="ball"><ref name="interior" id="m"/></shape>
        <shape type="cube"><bsdf type="dielectric"/><ref name="interior" id="m"/></shape>)");
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_NE(scene.warnings[0].find(":4:9: 'pane': "), std::string::npos) << scene.warnings[0];
    EXPECT_TRUE(scene.warnings[1].ends_with(
        ":5:9: 'ball': no light passes its material, so the medium inside cannot be seen"))
        << scene.warnings[1];
    EXPECT_EQ(scene.media.size(), 1u);
}

TEST_F(LoadScene, UnitOfLengthScalesMedia) {
    const Scene scene = load(R"(<float name="mm_per_unit" value="10"/><emitter type="constant"/>
        <medium type="homogeneous" id="m">
            <float name="sigma_t" value="2"/><float name="albedo" value="0.5"/></medium>
        <sensor type="perspective"><ref id="m"/></sensor>)");
    ASSERT_NE(scene.camera_medium, nullptr);
    // 2 per millimetre are 20 per unit of ten millimetres.
    const MediumCoefficients c = scene.camera_medium->coefficients({}, Wavelengths::rgb_bands());
    EXPECT_NEAR(c.sigma_t[0], 20.f, 1e-5f);
    EXPECT_NEAR(c.sigma_s[0], 10.f, 1e-5f);
}

}  // namespace
}  // namespace nacre
