#include "nacre/scene/content_key.h"

#include "nacre/geometry/mesh_build.h"
#include "nacre/scene/demo_scene.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

class ContentKey : public SceneFiles {
  protected:
    std::string key(const std::string& grey, const std::string& sampler = "independent",
                    const LoadOptions& options = {}) {
        return content_key(load_scene(
            write(
                "s.xml",
                "<scene version=\"3.0.0\"><integrator type=\"path\"/><sensor type=\"perspective\">"
                "<sampler type=\"" +
                    sampler +
                    "\"/></sensor><emitter type=\"constant\"/><shape type=\"obj\">"
                    "<string name=\"filename\" value=\"m.obj\"/><bsdf type=\"diffuse\">"
                    "<rgb name=\"reflectance\" value=\"" +
                    grey + "\"/></bsdf></shape></scene>"),
            options));
    }
    void SetUp() override {
        SceneFiles::SetUp();
        write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    }
};

}  // namespace

TEST_F(ContentKey, IsThatOfWhatIsSeen) {
    const std::string plain = key("0.5");
    EXPECT_EQ(plain.size(), 16u);
    EXPECT_EQ(key("0.5"), plain);
    EXPECT_EQ(key("0.5", "sobol"), plain) << "samples do not change the true picture";
    EXPECT_NE(key("0.5, 0.5, 0.51"), plain);
    LoadOptions wide;
    wide.width = 100, wide.height = 50;
    EXPECT_NE(key("0.5", "independent", wide), plain);
    LoadOptions spectral;
    spectral.mode = ColorMode::spectral;
    EXPECT_NE(key("0.5", "independent", spectral), plain);
    write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n");
    EXPECT_NE(key("0.5"), plain) << "the mesh is part of the scene";
}

TEST_F(ContentKey, OfScenesWithoutAFile) {
    EXPECT_EQ(content_key(make_demo_scene(30, 40)), content_key(make_demo_scene(30, 40)));
    EXPECT_NE(content_key(make_demo_scene(30, 40)), content_key(make_demo_scene(40, 40)));
    // Two meshes of one size, one with a dent.
    auto round = std::make_shared<Mesh>(make_icosphere(2)), dented = std::make_shared<Mesh>(*round);
    for (Point3f& p : dented->positions)
        if (p.x > 0.5f && p.y > 0.5f) p = p * 0.8f;
    EXPECT_EQ(content_key(make_mesh_scene(round, {})), content_key(make_mesh_scene(round, {})));
    EXPECT_NE(content_key(make_mesh_scene(round, {})), content_key(make_mesh_scene(dented, {})));
    EXPECT_EQ(error_of([] { content_key(Scene()); }),
              "the scene was put together by hand: there is nothing to make a key of");
}

}  // namespace nacre
