#include "nacre/scene/content_key.h"

#include "nacre/geometry/mesh_build.h"
#include "nacre/measured/factor/textures.h"
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

/// A material may be a folder of files: each is part of the scene.
TEST_F(ContentKey, FoldersAreTheirFiles) {
    const auto factors = [&](float h) {
        std::filesystem::create_directory(folder_ / "factors");
        write_factors(
            FactoredBrdf({FactorParameters::in_out, 2},
                         {{FactorTexture(4, {0.5f, 0.5f, 0.5f}), FactorTexture(4, {h, h, h})}},
                         false, "made", true),
            folder_ / "factors");
        return content_key(load_scene(write(
            "f.xml",
            "<scene version=\"3.0.0\"><integrator type=\"path\"/><sensor type=\"perspective\"/>"
            "<emitter type=\"constant\"/><shape type=\"obj\"><string name=\"filename\" "
            "value=\"m.obj\"/><bsdf type=\"measured\"><string name=\"filename\" "
            "value=\"factors\"/></bsdf></shape></scene>")));
    };
    const std::string plain = factors(0.4f);
    EXPECT_EQ(factors(0.4f), plain);
    EXPECT_NE(factors(0.3f), plain);
}

/// What differs is named, and only that.
TEST_F(ContentKey, ByPart) {
    const auto parts = [&](const std::string& grey, const LoadOptions& options = {}) {
        key(grey, "independent", options);
        return content_keys_by_part(load_scene(folder_ / "s.xml", options));
    };
    const auto different = [](const auto& a, const auto& b) {
        std::string names;
        for (const auto& [name, value] : a)
            if (!b.contains(name) || b.at(name) != value) names += name + " ";
        return names;
    };
    const auto plain = parts("0.5");
    std::string names;
    for (const auto& [name, value] : plain) names += name + " ";
    EXPECT_EQ(names, "emitter integrator mesh scene sensor shape ");
    EXPECT_EQ(different(plain, parts("0.5")), "");
    EXPECT_EQ(different(plain, parts("0.6")), "shape ");
    LoadOptions wide;
    wide.width = 100, wide.height = 50;
    EXPECT_EQ(different(plain, parts("0.5", wide)), "") << "the film is in none";
    std::ifstream in(folder_ / "s.xml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    text.insert(text.find("<sampler"),
                "<film type=\"hdrfilm\"><integer name=\"width\" value=\"9\"/></film>");
    EXPECT_EQ(different(plain, content_keys_by_part(load_scene(write("film.xml", text)))), "");
    write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n");
    EXPECT_EQ(different(plain, parts("0.5")), "mesh shape ");
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
