// Peers: what nacre writes for them. How they are run is asked in test_peer_process.cpp, what they
// render in test_peer_renders.cpp.
#include "nacre/peers/peer.h"

#include <gtest/gtest.h>

#include <numbers>

#include "nacre/geometry/mesh_io.h"
#include "nacre/peers/cycles_scene.h"
#include "nacre/peers/mesh.h"
#include "nacre/peers/view.h"
#include "nacre/peers/xml.h"
#include "nacre/scene/xml/scene_node.h"
#include "tests/peers/peer_fixture.h"

namespace nacre {
namespace {

class Peer : public PeerTest {
  protected:
    nlohmann::json cycles(const Scene& scene, bool random_walk = false) {
        said_ = {};
        return cycles_scene(request(scene), "picture.exr", random_walk, said_);
    }
    /// The scene that nacre reads from what it has written for Mitsuba.
    SceneNodePtr mitsuba(const Scene& scene) {
        said_ = {};
        const auto file = write("written.xml", mitsuba_scene(request(scene), said_).xml);
        std::vector<std::filesystem::path> folders;
        return read_scene_xml(file, {}, folders);
    }

    Substitutions said_;
};

TEST_F(Peer, AreFoundByName) {
    EXPECT_EQ(peers().find("Cycles Random-Walk").name, "cycles_random_walk");
    EXPECT_EQ(error_of([] { peers().find("mitsubo"); }),
              "unknown peer 'mitsubo'; did you mean 'mitsuba'?");
}

TEST_F(Peer, AbsentProgramsSayHowToInstallThem) {
    const Scene scene = load(plane);
    const std::pair<const char*, const char*> cases[] = {
        {"cycles", "Blender is not installed; install it with: apt-get install blender"},
        {"cycles_random_walk",
         "Blender is not installed; install it with: apt-get install blender"},
        {"mitsuba", "Mitsuba 3 is not installed; install it with: pip install mitsuba"},
    };
    for (const auto& [name, message] : cases) {
        EXPECT_FALSE(peers().find(name).find(request(scene).search_path)) << name;
        EXPECT_EQ(error_of([&, n = name] { peers().find(n).run(request(scene)); }), message);
    }
    // A Python without the module is no Mitsuba.
    write_program("python3", "exit 1");
    EXPECT_FALSE(peers().find("mitsuba").find(request(scene).search_path));
    write_program("python3", "test \"$1 $2\" = '-c import mitsuba'");
    EXPECT_EQ(peers().find("mitsuba").find(request(scene).search_path), folder_ / "bin/python3");
}

TEST_F(Peer, RefusesPicturesThatOnlyNacreMakes) {
    write_program("blender", "exit 0");
    Scene scene = load(plane);
    scene.film.quantity = FilmQuantity::luminance;
    EXPECT_EQ(error_of([&] { peers().find("cycles").run(request(scene)); }),
              "Blender Cycles renders radiance only; leave 'quantity' of the film out of the "
              "scene");
    scene.film.quantity = FilmQuantity::radiance;
    scene.integrator.type = "legacy";
    EXPECT_EQ(error_of([&] { peers().find("cycles").run(request(scene)); }),
              "Blender Cycles has no illumination models from before the BRDF; compare scenes of "
              "integrator path or volpath");
    scene.integrator.type = "path";
    scene.integrator.max_depth = 1;
    EXPECT_EQ(error_of([&] { peers().find("cycles").run(request(scene)); }),
              "Blender Cycles always shows light that was scattered once; compare with a "
              "max_depth of 2 or more");
}

TEST_F(Peer, CyclesGetsCameraFilmAndDepth) {
    const Scene scene = load(std::string(R"(
        <integrator type="path"><integer name="max_depth" value="6"/></integrator>
        <sensor type="thinlens">
            <float name="fov" value="60"/><float name="near_clip" value="0.5"/><float name="far_clip" value="100"/>
            <float name="aperture_radius" value="0.25"/><float name="focus_distance" value="8"/>
            <transform name="to_world"><lookat origin="1, 2, 3" target="1, 2, -7" up="0, 1, 0"/></transform>
            <film type="hdrfilm"><integer name="width" value="40"/><integer name="height" value="20"/>
                <integer name="crop_offset_x" value="10"/><integer name="crop_offset_y" value="5"/>
                <integer name="crop_width" value="8"/><integer name="crop_height" value="4"/>
                <rfilter type="gaussian"><float name="stddev" value="0.4"/></rfilter></film>
        </sensor>)") + plane);
    PeerRequest asked = request(scene);
    asked.samples = 7, asked.seed = 11, asked.threads = 3;
    const nlohmann::json job = cycles_scene(asked, "picture.exr", false, said_);
    EXPECT_EQ(job["render"], nlohmann::json::parse(R"({"samples": 7, "seed": 11, "threads": 3,
                                                       "max_bounces": 4})"));
    EXPECT_EQ(job["film"]["crop"], nlohmann::json::parse("[10, 5, 8, 4]"));
    EXPECT_EQ(job["film"]["filter"][0], "GAUSSIAN");
    EXPECT_NEAR(job["film"]["filter"][1], 4 * 0.4, 1e-6);
    const nlohmann::json& camera = job["camera"];
    EXPECT_NEAR(camera["width"], 2 * std::tan(std::numbers::pi / 6), 1e-5);
    EXPECT_NEAR(camera["aperture_radius"], 0.25, 1e-6);
    EXPECT_NEAR(camera["focus_distance"], 8, 1e-3);
    EXPECT_NEAR(camera["clip"][0], 0.5, 1e-6);
    // Seen from +z the axes of picture and world are the same.
    const double expected[] = {1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1};
    for (int i = 0; i < 16; ++i) EXPECT_NEAR(camera["to_world"][i], expected[i], 1e-5) << i;
    EXPECT_TRUE(said_.sentences.empty());
}

TEST_F(Peer, CyclesGetsMediaPerSceneUnit) {
    // 1 unit is 10 mm.
    const Scene scene = load(R"(
        <float name="mm_per_unit" value="10"/>
        <emitter type="point"><point name="position" x="1" y="2" z="3"/><rgb name="intensity" value="8, 4, 2"/></emitter>
        <shape type="sphere"><float name="radius" value="2"/>
            <bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>
            <medium type="homogeneous" name="interior"><rgb name="sigma_t" value="2, 1, 0.5"/>
                <rgb name="albedo" value="0.75, 0.5, 0"/><phase type="hg"><float name="g" value="0.3"/></phase></medium>
        </shape>)");
    const nlohmann::json job = cycles(scene), &mesh = job["meshes"][0];
    EXPECT_EQ(mesh["shader"]["type"], "glass");
    EXPECT_NEAR(mesh["shader"]["ior"], 1.5, 1e-6);
    const double scattering[] = {15, 5, 0}, absorption[] = {5, 5, 5};
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(mesh["volume"]["sigma_s"][c], scattering[c], 1e-5);
        EXPECT_NEAR(mesh["volume"]["sigma_a"][c], absorption[c], 1e-5);
    }
    EXPECT_NEAR(mesh["volume"]["anisotropy"], 0.3, 1e-6);
    EXPECT_EQ(job["lights"][0]["strength"], 8);
    EXPECT_EQ(job["lights"][0]["color"], nlohmann::json::parse("[1.0, 0.5, 0.25]"));
    EXPECT_EQ(job["lights"][0]["position"], nlohmann::json::parse("[1.0, 2.0, 3.0]"));
    const auto bytes = std::filesystem::file_size(folder_ / "job/mesh_000.bin");
    EXPECT_EQ(bytes,
              24u * mesh["vertices"].get<unsigned>() + 12u * mesh["triangles"].get<unsigned>());
    EXPECT_EQ(said_.sentences, std::vector<std::string>{"paths end after 1024 scatterings"});
}

TEST_F(Peer, MaterialsAreBlackFromTheInsideUnlessTwoSided) {
    const Scene scene = load(R"(
        <shape type="rectangle"><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>
        <shape type="rectangle"><bsdf type="diffuse"/></shape>
        <shape type="rectangle"><emitter type="area"><rgb name="radiance" value="2, 1, 0"/></emitter></shape>)");
    const nlohmann::json meshes = cycles(scene)["meshes"];
    EXPECT_EQ(meshes[0]["shader"],
              nlohmann::json::parse(R"({"type": "diffuse", "color": [0.5, 0.5, 0.5]})"));
    EXPECT_EQ(meshes[1]["shader"], nlohmann::json::parse(R"({"type": "mix",
        "factor": {"backfacing": true}, "a": {"type": "diffuse", "color": [0.5, 0.5, 0.5]}, "b": null})"));
    EXPECT_EQ(meshes[2]["shader"],
              nlohmann::json::parse(R"({"type": "add", "a": null, "b": {"type": "mix",
        "factor": {"backfacing": true}, "a": {"type": "emission", "color": [1.0, 0.5, 0.0], "strength": 2.0},
        "b": null}})"));
    EXPECT_TRUE(said_.sentences.empty());
}

const char* const unsupported = R"(
    <sensor type="perspective"><film type="hdrfilm"><rfilter type="tent"/></film></sensor>
    <emitter type="constant"/>
    <shape type="rectangle" id="floor"><bsdf type="lambert"><rgb name="reflectance" value="0.25, 0.5, 0.75"/></bsdf></shape>
    <shape type="sphere" id="ball"><bsdf type="roughplastic"/></shape>
    <shape type="sphere" id="wax">
        <bsdf type="dielectric"><string name="int_ior" value="dispersive bk7"/></bsdf>
        <medium type="homogeneous" name="interior"><phase type="schlick"><float name="k" value="0"/></phase></medium>
    </shape>)";

TEST_F(Peer, CyclesListsWhatItReplaces) {
    cycles(load(unsupported));
    EXPECT_EQ(said_.sentences,
              (std::vector<std::string>{
                  "wavelengths are the three bands of linear RGB",
                  "the tent filter is a Gaussian of standard deviation 0.4082",
                  "paths end after 1024 scatterings",
                  "'floor': lambert is diffuse of its albedo (0.25, 0.5, 0.75)",
                  "'ball': roughplastic is a diffuse base below Fresnel's reflection",
                  "'wax': the index of refraction is that of yellow light",
                  "'wax': phase function schlick is Henyey and Greenstein's of mean cosine 0",
              }));
}

TEST_F(Peer, MitsubaListsWhatItReplaces) {
    const Scene scene = load(unsupported);
    mitsuba(scene);
    EXPECT_EQ(said_.sentences,
              (std::vector<std::string>{
                  "'floor': lambert is diffuse of its albedo (0.25, 0.5, 0.75)",
                  "'wax': the index of refraction is that of yellow light",
                  "'wax': phase function schlick is Henyey and Greenstein's of mean cosine 0",
              }));
}

TEST_F(Peer, RandomWalkHasTheMediumsReflectanceAndLength) {
    // Without absorption all that enters leaves; the boundary alone decides the colour.
    const Scene scene = load(R"(
        <shape type="sphere" id="ball">
            <bsdf type="null"/>
            <medium type="homogeneous" name="interior"><rgb name="sigma_t" value="2, 2, 2"/>
                <rgb name="albedo" value="0.99, 0.9, 0.5"/></medium>
        </shape>)");
    const nlohmann::json shader = cycles(scene, true)["meshes"][0]["shader"];
    EXPECT_EQ(shader["type"], "subsurface");
    EXPECT_EQ(shader["specular"], 0);
    // The better dipole's transport coefficient (d'Eon 2012; Grosjean's diffusion coefficient,
    // D = (2 sigma_a + sigma_s') / (3 sigma_t'^2)).
    const double albedo[] = {0.99, 0.9, 0.5};
    for (int c = 0; c < 3; ++c) {
        const double s = 2 * albedo[c], a = 2 - s;
        EXPECT_NEAR(shader["radius"][c], std::sqrt((2 * a + s) / (3 * 4) / a), 1e-4) << c;
        EXPECT_GT(shader["color"][c], 0);
        EXPECT_LT(shader["color"][c], 1);
    }
}

TEST_F(Peer, MitsubaRunsTheFileItselfWhereItCan) {
    const Scene scene = load(std::string(R"(<integrator type="path"/>)") + plane);
    PeerRequest asked = request(scene);
    EXPECT_FALSE(mitsuba_scene(asked, said_).same_as_file) << "no file, and no sensor";
    const Scene with_camera =
        load(std::string(R"(<integrator type="path"/><sensor type="perspective">
        <sampler type="independent"/></sensor>)") +
             plane);
    PeerRequest again = request(with_camera);
    EXPECT_FALSE(mitsuba_scene(again, said_).same_as_file) << "no file";
    again.scene_file = folder_ / "scene.xml";
    EXPECT_TRUE(mitsuba_scene(again, said_).same_as_file);
    LoadOptions smaller;
    smaller.width = 8, smaller.height = 576;
    const Scene resized = load_scene(folder_ / "scene.xml", smaller);
    PeerRequest third = request(resized);
    third.scene_file = folder_ / "scene.xml";
    EXPECT_FALSE(mitsuba_scene(third, said_).same_as_file) << "another size";
}

TEST_F(Peer, MitsubaGetsWhatItKnows) {
    const Scene scene = load(R"(
        <float name="mm_per_unit" value="10"/>
        <integrator type="volpath"><boolean name="guided_exits" value="false"/></integrator>
        <shape type="sphere"><subsurface type="dipole"><rgb name="sigma_s" value="3, 2, 1"/>
            <rgb name="sigma_a" value="1, 2, 0"/><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></subsurface></shape>
        <shape type="figure" id="bust"><float name="resolution" value="8"/></shape>)");
    const SceneNodePtr root = mitsuba(scene);
    EXPECT_FALSE(root->has("mm_per_unit"));
    EXPECT_FALSE(root->children_of("integrator")[0]->node->has("guided_exits"));
    // Roulette would make media glare; the scene does not ask for it.
    EXPECT_EQ(root->children_of("integrator")[0]->node->get_int("rr_depth", 0), 100000);
    const auto shapes = root->children_of("shape");
    ASSERT_EQ(shapes.size(), 2u);
    const SceneNode& ball = *shapes[0]->node;
    EXPECT_EQ(ball.children_of("bsdf")[0]->node->get_float("int_ior"), 1.5);
    const SceneNode& medium = *ball.child("interior", "medium")->node;
    const Vec3f extinction = medium.get_color("sigma_t")->rgb,
                albedo = medium.get_color("albedo")->rgb;
    const double scale = medium.get_float("scale");
    const float sigma_t[] = {40, 40, 10}, share[] = {0.75f, 0.5f, 1};
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_LE(extinction[c], 1.f);  // lest Mitsuba refuse it
        EXPECT_NEAR(scale * extinction[c], sigma_t[c], 1e-4);
        EXPECT_NEAR(albedo[c], share[c], 1e-6f);
    }
    EXPECT_EQ(shapes[1]->node->type, "ply");
    const auto mesh = load_mesh(shapes[1]->node->get_string("filename"));
    EXPECT_EQ(mesh->triangles.size(), scene.rays.mesh(1)->triangles.size());
    EXPECT_EQ(mesh->normals.size(), mesh->positions.size());
}

TEST_F(Peer, CyclesGetsTheEnvironmentAsBlenderMapsIt) {
    Image sky(8, 5);  // red above, where y > 0, and green below
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 8; ++x) sky.at(x, y, y < 2 ? 0 : 1) = 2.f;
    write_image(sky, folder_ / "sky.exr");
    const Scene scene =
        load(R"(<emitter type="envmap"><string name="filename" value="sky.exr"/></emitter>)");
    EXPECT_EQ(cycles(scene)["environment"]["image"], "environment.exr");
    const Image seen = read_image(folder_ / "job/environment.exr");
    ASSERT_EQ(seen.width, 1024);
    ASSERT_EQ(seen.height, 512);
    // Blender's picture has +x in its middle, +y in the middle of its left half and +z at its top.
    EXPECT_EQ(seen.rgb(256, 256), (Vec3f{2, 0, 0}));
    EXPECT_EQ(seen.rgb(768, 256), (Vec3f{0, 2, 0}));
}

TEST_F(Peer, FlippedMeshesAreTurnedRound) {
    const Scene scene =
        load(R"(<shape type="rectangle"><boolean name="flip_normals" value="true"/></shape>)");
    const Mesh mesh = peer_mesh(scene, 0);
    for (const Mesh::Triangle& t : mesh.triangles) {
        const Point3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]],
                      &c = mesh.positions[t[2]];
        EXPECT_LT(cross(b - a, c - a).z, 0.f);
    }
    for (const Vec3f& n : mesh.normals) EXPECT_EQ(n.z, -1.f);
}

TEST_F(Peer, ViewIsThatOfTheCamera) {
    const auto view = [&](const std::string& sensor) {
        return view_of(*load(sensor + plane).camera);
    };
    const PeerView shifted = view(R"(<sensor type="perspective"><float name="fov" value="90"/>
        <float name="principal_point_offset_x" value="0.1"/><float name="principal_point_offset_y" value="-0.2"/>
        <film type="hdrfilm"><integer name="width" value="40"/><integer name="height" value="20"/></film></sensor>)");
    EXPECT_NEAR(shifted.half_width, 1, 1e-5);
    EXPECT_NEAR(shifted.half_height, 0.5, 1e-5);
    // The ray through film (0.5, 0.5) has camera x = -0.2 half widths to the left, so +0.1 widths
    // to the right, and y = +0.4 half heights.
    EXPECT_NEAR(shifted.shift.x, 0.1, 1e-5);
    EXPECT_NEAR(shifted.shift.y, 0.2, 1e-5);
    EXPECT_NEAR(shifted.right.x, -1, 1e-5);  // looks along +z, x to the left
    EXPECT_NEAR(shifted.forward.z, 1, 1e-5);
    EXPECT_FALSE(shifted.mirrored);

    const PeerView mirrored = view(
        R"(<sensor type="perspective"><transform name="to_world"><scale x="-1" y="1" z="1"/></transform></sensor>)");
    EXPECT_TRUE(mirrored.mirrored);
    EXPECT_NEAR(mirrored.right.x, 1, 1e-5);
    EXPECT_NEAR(mirrored.forward.z, 1, 1e-5);

    const PeerView parallel = view(
        R"(<sensor type="orthographic"><transform name="to_world"><scale x="3" y="3" z="1"/></transform>
        <film type="hdrfilm"><integer name="width" value="40"/><integer name="height" value="20"/></film></sensor>)");
    EXPECT_TRUE(parallel.orthographic);
    EXPECT_NEAR(parallel.half_width, 3, 1e-5);
    EXPECT_NEAR(parallel.half_height, 1.5, 1e-5);
    EXPECT_NEAR(parallel.forward.z, 1, 1e-5);
    EXPECT_FALSE(parallel.mirrored);
}

}  // namespace
}  // namespace nacre
