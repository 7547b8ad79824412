// glTF materials as those of a scene: values against the formulas of the specification.

#include "nacre/image/image.h"
#include "nacre/scene/content_key.h"
#include "nacre/spectrum/color.h"
#include "tests/geometry/gltf_files.h"
#include "tests/scene/bands.h"
#include "tests/scene/scene_files.h"
#include "tests/support/bound.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

class GltfShapes : public SceneFiles {
  protected:
    /// A scene of the square in that material, given as the members of its JSON object.
    Scene scene(const std::string& material, const std::string& rest = "",
                const std::string& shape = "") {
        write("a.gltf",
              test::square_gltf(R"(,"materials":[{"name":"m",)" + material + "}]" + rest));
        write("scene.xml",
              "<scene version=\"3.0.0\"><emitter type=\"constant\"/><sensor type=\"perspective\"/>"
              "<shape type=\"gltf\">"
              "<string name=\"filename\" value=\"a.gltf\"/>" +
                  shape + "</shape></scene>");
        return load_scene(folder_ / "scene.xml");
    }
    /// A PNG of these colours side by side, given as the values that it stores, of 255.
    void write_row(const std::string& name, const std::vector<std::array<int, 4>>& pixels) {
        Image image(int(pixels.size()), 1, {"R", "G", "B", "A"});
        for (std::size_t x = 0; x < pixels.size(); ++x)
            for (int c = 0; c < 4; ++c) {
                const float v = float(pixels[x][std::size_t(c)]) / 255.f;
                image.at(int(x), 0, c) = c < 3 ? srgb_decode(v) : v;
            }
        write_image(image, folder_ / name);
    }
    static SurfacePoint at(float u) {
        SurfacePoint p;
        p.uv = {u, 0.5f};
        return p;
    }
    static const std::string textures;  ///< of row.png, nearest texels
};
const std::string GltfShapes::textures =
    R"(,"images":[{"uri":"row.png"}],"samplers":[{"magFilter":9728}],)"
    R"("textures":[{"source":0,"sampler":0}])";

Spectral facing(const Material& m, const SurfacePoint& at = {}) {
    return test::Bound(m, at)->eval({0, 0, 1}, {0, 0, 1});
}
std::string dielectric(const std::string& more = "") {
    return R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.8,0.5,0.2,1])" +
           more + "}";
}

TEST_F(GltfShapes, OpaqueOnesHaveTheFormulaOfTheFormat) {
    // Facing, at roughness 1: D = 1/pi, G = 1, F = f0, and the matt base is seen through the
    // boundary twice: (1 - 0.04)^2 / (1 - 0.04 - 0.96/21) = 1.008.
    const Scene matt = scene(dielectric());
    ASSERT_EQ(matt.shapes.size(), 1u);
    EXPECT_EQ(matt.shapes[0].name, "a.gltf");
    EXPECT_TRUE(matt.warnings.empty());
    const Spectral f = facing(*matt.shapes[0].material);
    for (const auto& [c, base] : {std::pair{0, 0.8f}, {1, 0.5f}, {2, 0.2f}})
        EXPECT_NEAR(f[c], 1.008f * base / pi + 0.04f / (4 * pi), 1e-5f);
    // The same from behind.
    const Spectral behind = test::Bound(matt.shapes[0].material)->eval({0, 0, -1}, {0, 0, -1});
    for (int c = 0; c < 3; ++c) EXPECT_EQ(behind[c], f[c]);

    const Scene metal = scene(
        R"("pbrMetallicRoughness":{"baseColorFactor":[0.8,0.5,0.2,1],"roughnessFactor":0.5})");
    // alpha = 0.25: D = 1/(pi alpha^2).
    const Spectral g = facing(*metal.shapes[0].material);
    for (const auto& [c, base] : {std::pair{0, 0.8f}, {1, 0.5f}, {2, 0.2f}})
        EXPECT_NEAR(g[c], base / (4 * pi * 0.0625f), 1e-4f);
}

TEST_F(GltfShapes, TexturesMultiplyFactors) {
    write_row("row.png", {{255, 128, 0, 255}, {64, 255, 255, 255}});
    const Scene s = scene(dielectric(R"(,"baseColorTexture":{"index":0})"), textures);
    for (const auto& [u, rgb] :
         {std::pair{0.25f, std::array{255, 128, 0}}, {0.75f, {64, 255, 255}}}) {
        const Spectral f = facing(*s.shapes[0].material, at(u));
        const float factor[] = {0.8f, 0.5f, 0.2f};
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(f[c],
                        1.008f * factor[c] * srgb_decode(float(rgb[std::size_t(c)]) / 255.f) / pi +
                            0.04f / (4 * pi),
                        1e-5f);
    }
}

TEST_F(GltfShapes, RoughnessIsGreenAndMetalBlue) {
    write_row("row.png", {{9, 51, 255, 255}, {9, 255, 0, 255}});
    const Scene s = scene(R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],)"
                          R"("metallicRoughnessTexture":{"index":0}})",
                          textures);
    const float alpha = 0.2f * 0.2f;  // of 51/255, squared
    EXPECT_NEAR(facing(*s.shapes[0].material, at(0.25f))[1], 0.5f / (4 * pi * alpha * alpha),
                0.01f);
    EXPECT_NEAR(facing(*s.shapes[0].material, at(0.75f))[1], 1.008f * 0.5f / pi + 0.04f / (4 * pi),
                1e-5f);
}

TEST_F(GltfShapes, AlphaCutsOrBlends) {
    write_row("row.png", {{255, 255, 255, 102}, {255, 255, 255, 204}});
    const auto through = [](const Scene& s, float u) {
        return test::Bound(s.shapes[0].material, at(u))->null_transmission({0, 0, 1})[0];
    };
    const std::string picture = dielectric(R"(,"baseColorTexture":{"index":0})");
    const Scene blend = scene(picture + R"(,"alphaMode":"BLEND")", textures);
    EXPECT_NEAR(through(blend, 0.25f), 0.6f, 1e-5f);
    EXPECT_NEAR(through(blend, 0.75f), 0.2f, 1e-5f);
    const Scene mask = scene(picture + R"(,"alphaMode":"MASK")", textures);
    EXPECT_EQ(through(mask, 0.25f), 1.f);
    EXPECT_EQ(through(mask, 0.75f), 0.f);
    const Scene opaque = scene(picture, textures);
    EXPECT_EQ(through(opaque, 0.25f), 0.f);
    EXPECT_FALSE(opaque.shapes[0].material->flags() & has_null);
    const Scene gone = scene(dielectric() + R"(,"alphaMode":"MASK","alphaCutoff":1.5)");
    EXPECT_EQ(through(gone, 0.5f), 1.f);
}

std::string volume(const char* transmission, const char* more = "") {
    return dielectric() + R"(,"extensions":{)" + transmission +
           R"(,"KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,)"
           R"("attenuationColor":[0.9,0.5,0.1]})" +
           more + "}";
}
constexpr const char* glass = R"("KHR_materials_transmission":{"transmissionFactor":1})";

TEST_F(GltfShapes, VolumesAttenuateAsSaid) {
    const Scene s = scene(volume(glass));
    const ShapeBinding& shape = s.shapes[0];
    ASSERT_NE(shape.interior, nullptr);
    const MediumCoefficients c = shape.interior->coefficients({}, bands);
    for (const auto& [i, color] : {std::pair{0, 0.9f}, {1, 0.5f}, {2, 0.1f}}) {
        EXPECT_NEAR(std::exp(-2.f * c.sigma_t[i]), color, 1e-5f);
        EXPECT_EQ(c.sigma_s[i], 0.f);
    }
    EXPECT_TRUE(shape.material->flags() & transmits);
    // Twice as large: the file's distance is in its own units, the scene's are twice as many.
    const Scene twice =
        scene(volume(glass), "", R"(<transform name="to_world"><scale value="2"/></transform>)");
    EXPECT_NEAR(twice.shapes[0].interior->coefficients({}, bands).sigma_t[1], 0.5f * c.sigma_t[1],
                1e-5f);
}

TEST_F(GltfShapes, VolumesScatterAsSaid) {
    const Scene s =
        scene(volume(R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":1})",
                     R"(,"KHR_materials_volume_scatter":{"multiscatterColor":[0.572,0.227,0.075],)"
                     R"("scatterAnisotropy":0.3})"));
    ASSERT_NE(s.shapes[0].interior, nullptr);
    const MediumCoefficients c = s.shapes[0].interior->coefficients({}, bands);
    // The extension's formula, computed elsewhere.
    for (const auto& [i, albedo] : {std::pair{0, 0.94184f}, {1, 0.65883f}, {2, 0.30684f}})
        EXPECT_NEAR(c.sigma_s[i] / c.sigma_t[i], albedo, 1e-4f);
    EXPECT_NEAR(s.shapes[0].interior->phase.mean_cosine(), 0.3f, 1e-6f);
}

TEST_F(GltfShapes, ThinWallsLetLightPassStraightOn) {
    const Scene s = scene(R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0,)"
                          R"("baseColorFactor":[0.8,0.5,0.2,1]},"extensions":{)" +
                          std::string(glass) + "}");
    EXPECT_EQ(s.shapes[0].interior, nullptr);
    EXPECT_TRUE(s.warnings.empty());
    const Spectral t = test::Bound(s.shapes[0].material)->null_transmission({0, 0, 1});
    // Of index 1.5, all reflections between the faces: 1 - 2 R / (1 + R) = 12/13.
    for (const auto& [c, base] : {std::pair{0, 0.8f}, {1, 0.5f}, {2, 0.2f}})
        EXPECT_NEAR(t[c], base * 12.f / 13.f, 1e-5f);
}

TEST_F(GltfShapes, SharesOfGlassAndMetal) {
    // 0.6 of the dielectric half is glass, 0.3 of all; of the rest five sevenths are metal.
    const Scene s =
        scene(R"("pbrMetallicRoughness":{"metallicFactor":0.5,"roughnessFactor":0},"extensions":{)"
              R"("KHR_materials_transmission":{"transmissionFactor":0.6}})");
    const Spectral t = test::Bound(s.shapes[0].material)->null_transmission({0, 0, 1});
    EXPECT_NEAR(t[0], 0.3f * 12.f / 13.f, 1e-5f);
    const Scene rough = scene(R"("pbrMetallicRoughness":{"metallicFactor":0.5},"extensions":{)"
                              R"("KHR_materials_transmission":{"transmissionFactor":0.6}})");
    // Half metal of reflectance 1, a fifth matt: 0.5 and 0.2 of what each gives by itself.
    EXPECT_NEAR(facing(*rough.shapes[0].material)[0],
                0.5f / (4 * pi) + 0.2f * (1.008f / pi + 0.04f / (4 * pi)), 1e-5f);
}

TEST_F(GltfShapes, LeavesPassLightOn) {
    const Scene s = scene(
        dielectric() +
        R"(,"extensions":{"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.25,)"
        R"("diffuseTransmissionColorFactor":[1,0.5,0]}})");
    const Material& m = *s.shapes[0].material;
    const Spectral back = test::Bound(m)->eval({0, 0, -1}, {0, 0, 1}), front = facing(m);
    for (const auto& [c, color, base] :
         {std::tuple{0, 1.f, 0.8f}, {1, 0.5f, 0.5f}, {2, 0.f, 0.2f}}) {
        EXPECT_NEAR(back[c], 0.25f * color * 1.008f / pi, 1e-5f);
        EXPECT_NEAR(front[c], 0.75f * base * 1.008f / pi + 0.04f / (4 * pi), 1e-5f);
    }
}

TEST_F(GltfShapes, Shine) {
    const Scene s =
        scene(R"("emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_emissive_strength":)"
              R"({"emissiveStrength":3}})");
    ASSERT_NE(s.shapes[0].light, nullptr);
    SurfacePoint p;
    p.ng = {0, 0, 1};
    const Spectral l = s.shapes[0].light->radiance(&p, {0, 0, -1}, bands);
    EXPECT_EQ(Vec3f(l[0], l[1], l[2]), (Vec3f{3, 1.5f, 0}));
}

TEST_F(GltfShapes, WhatIsLeftOutIsToldOnce) {
    const Scene s = scene(
        R"("normalTexture":{"index":0},"extensions":{"KHR_materials_sheen":{},)" +
            std::string(glass) + R"(},"pbrMetallicRoughness":{"metallicFactor":0})",
        textures + R"(,"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}])");
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_EQ(s.warnings[0],
              "a.gltf: the picture leaves out cameras; of material 'm': normalTexture, "
              "KHR_materials_sheen, the blur of what is transmitted (light passes a thin wall "
              "straight on)");
}

TEST_F(GltfShapes, ShapesOfTheirOwnMaterialKeepIt) {
    const Scene s = scene(dielectric() + R"(,"normalTexture":{"index":0})", textures,
                          R"(<bsdf type="diffuse"/>)");
    EXPECT_TRUE(s.warnings.empty());
    EXPECT_NEAR(facing(*s.shapes[0].material)[0], 0.5f / pi, 1e-6f);
}

TEST_F(GltfShapes, PartsKeepWhatTheShapeSays) {
    write("a.gltf", test::square_gltf(R"(,"materials":[{"name":"m"}])", ""));
    write("scene.xml",
          R"(<scene version="3.0.0"><emitter type="constant"/><shape type="gltf" id="s">
             <string name="filename" value="a.gltf"/><boolean name="flip_normals" value="true"/>
             </shape></scene>)");
    const Scene s = load_scene(folder_ / "scene.xml");
    ASSERT_EQ(s.shapes.size(), 2u);
    EXPECT_EQ(s.shapes[0].name, "s: default");
    EXPECT_EQ(s.shapes[1].name, "s: m");
    const auto hit = s.rays.intersect({{0.3f, 0.6f, 1}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_LT(s.rays.surface_point({{0.3f, 0.6f, 1}, {0, 0, -1}}, *hit).ng.z, 0.f);
}

TEST_F(GltfShapes, WrongPictures) {
    const std::string picture = dielectric(R"(,"baseColorTexture":{"index":0})");
    EXPECT_EQ(
        error_of([&] { scene(picture, textures); }),
        "row.png: cannot be opened (No such file or directory); check the path; the glTF names "
        "it as a texture: put it there, or give the object a material of nacre's");
    write("row.png", "GIF89a");
    EXPECT_EQ(error_of([&] { scene(picture, textures); }), "row.png: is neither PNG nor JPEG");
    EXPECT_EQ(error_of([&] {
                  scene(picture, textures, R"(<string name="colour" value="x"/>)");
              }).substr(0, 9),
              "row.png: ");
    EXPECT_EQ(error_of([&] { scene(dielectric(), "", R"(<float name="to_word" value="1"/>)"); }),
              "scene.xml:1:137: <shape type=\"gltf\"> has no parameter 'to_word'; did you mean "
              "'to_world'?");
}

TEST_F(GltfShapes, BareMeshesHaveTheirOwnMaterialsUnlessAnotherIsAskedFor) {
    // Turned upright: a square of height 1 in the file's units, 100 mm in the scene.
    write("a.gltf", test::square_gltf(R"(,"materials":[{)" + volume(glass) + "}]"));
    const Scene own = load_mesh_scene(folder_ / "a.gltf");
    const auto object = [](const Scene& s) { return s.shapes.back(); };
    ASSERT_NE(object(own).interior, nullptr);
    EXPECT_NEAR(object(own).interior->coefficients({}, bands).sigma_t[1],
                -std::log(0.5f) / 2.f / 100.f, 1e-6f);
    EXPECT_EQ(own.rays.bounds(std::uint32_t(own.shapes.size() - 1)).diagonal().y, 100.f);
    const Scene marble = load_mesh_scene(folder_ / "a.gltf", {.material = "marble"});
    EXPECT_NEAR(object(marble).interior->coefficients({}, bands).sigma_s[0], 2.19f, 1e-4f);
    for (const std::string& w : marble.warnings) EXPECT_EQ(w.find("leaves out"), w.npos) << w;
}

TEST_F(GltfShapes, PicturesArePartOfTheContent) {
    const std::string picture = dielectric(R"(,"baseColorTexture":{"index":0})");
    write_row("row.png", {{255, 128, 0, 255}, {64, 255, 255, 255}});
    const std::string before = content_key(scene(picture, textures));
    EXPECT_EQ(content_key(scene(picture, textures)), before);
    write_row("row.png", {{255, 128, 0, 255}, {64, 255, 254, 255}});
    EXPECT_NE(content_key(scene(picture, textures)), before);
}

}  // namespace
}  // namespace nacre
