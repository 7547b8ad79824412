// What glTF files say of their materials, read as values.
#include "nacre/geometry/gltf_materials.h"

#include "nacre/math/error.h"
#include "tests/geometry/gltf_files.h"

namespace nacre::test {
namespace {

GltfMaterial only_material(const std::string& json, const std::string& more = "") {
    const GltfObject o =
        parse_gltf_object(square_gltf(R"(,"materials":[)" + json + "]" + more), "a.gltf");
    return o.materials.at(0);
}

TEST(GltfMaterials, DefaultsAreThoseOfTheFormat) {
    const GltfMaterial m = only_material("{}");
    EXPECT_EQ(m.base_color, (Vec3f{1, 1, 1}));
    EXPECT_EQ(m.metallic, 1.f);
    EXPECT_EQ(m.roughness, 1.f);
    EXPECT_EQ(m.alpha_mode, GltfMaterial::Alpha::opaque);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_FALSE(m.thick);
    EXPECT_TRUE(m.left_out.empty());
}

TEST(GltfMaterials, ExtensionsAreRead) {
    const GltfMaterial m = only_material(
        R"({"emissiveFactor":[1,0.5,0],"alphaMode":"MASK","alphaCutoff":0.25,"extensions":{)"
        R"("KHR_materials_emissive_strength":{"emissiveStrength":4},)"
        R"("KHR_materials_ior":{"ior":1.33},)"
        R"("KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,0.5,2]},)"
        R"("KHR_materials_transmission":{"transmissionFactor":0.75},)"
        R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.3,)"
        R"("diffuseTransmissionColorFactor":[1,0.9,0.8]},)"
        R"("KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,)"
        R"("attenuationColor":[0.9,0.5,0.1]},)"
        R"("KHR_materials_volume_scatter":{"multiscatterColor":[0.5,0.4,0.3],)"
        R"("scatterAnisotropy":-0.2}}})");
    EXPECT_EQ(m.emissive, (Vec3f{4, 2, 0}));
    EXPECT_EQ(m.alpha_mode, GltfMaterial::Alpha::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.25f);
    EXPECT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.specular, 0.5f);
    EXPECT_EQ(m.specular_color, (Vec3f{1, 0.5f, 2}));
    EXPECT_EQ(m.transmission, 0.75f);
    EXPECT_EQ(m.diffuse_transmission, 0.3f);
    EXPECT_EQ(m.diffuse_transmission_color, (Vec3f{1, 0.9f, 0.8f}));
    EXPECT_TRUE(m.thick);
    EXPECT_EQ(m.attenuation_distance, 2.f);
    EXPECT_EQ(m.attenuation_color, (Vec3f{0.9f, 0.5f, 0.1f}));
    EXPECT_EQ(m.multiscatter_color, (Vec3f{0.5f, 0.4f, 0.3f}));
    EXPECT_EQ(m.scatter_anisotropy, -0.2f);
    EXPECT_TRUE(m.left_out.empty()) << m.left_out.front();
}

TEST(GltfMaterials, WhatHasNoEqualIsListed) {
    const GltfMaterial m = only_material(
        R"({"normalTexture":{"index":0},"occlusionTexture":{"index":0},)"
        R"("pbrMetallicRoughness":{"baseColorTexture":{"index":1},)"
        R"("metallicRoughnessTexture":{"index":0,"texCoord":1}},"emissiveTexture":{"index":0},)"
        R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1},)"
        R"("KHR_materials_specular":{"specularColorTexture":{"index":0}},)"
        R"("KHR_materials_unlit":{}}})",
        R"(,"images":[{"uri":"a.png"}],"textures":[{"source":0},)"
        R"({"extensions":{"KHR_texture_basisu":{"source":0}}}])");
    EXPECT_EQ(m.left_out, (std::vector<std::string>{
                              "baseColorTexture (a picture by KHR_texture_basisu)", "normalTexture",
                              "occlusionTexture", "KHR_materials_specular: specularColorTexture",
                              "KHR_materials_clearcoat", "KHR_materials_unlit",
                              "emissiveTexture (by TEXCOORD_0, beside others by TEXCOORD_1)"}));
    EXPECT_EQ(m.metallic_roughness_texture.image, 0);
    EXPECT_EQ(m.emissive_texture.image, -1);

    const GltfObject o = parse_gltf_object(
        square_gltf(R"(,"materials":[{}],"cameras":[{"type":"perspective","perspective":)"
                    R"({"yfov":1,"znear":0.1}}],"skins":[{"joints":[0]}])",
                    R"("material":0,"targets":[{"POSITION":0}])", R"("mode":0)",
                    R"(,"skin":0,"weights":[0.5])"),
        "a.gltf");
    EXPECT_EQ(o.left_out, (std::vector<std::string>{"points and lines", "morph targets",
                                                    "skins (it stands as modelled)", "cameras"}));
}

TEST(GltfMaterials, PartsGoByMaterialWithTheirCoordinates) {
    const std::string textures =
        R"(,"images":[{"uri":"a%20b.png"}],"textures":[{"source":0}],"materials":[{},)"
        R"({"emissiveTexture":{"index":0,"texCoord":1}},{}])";
    const GltfObject o =
        parse_gltf_object(square_gltf(textures, "", R"("material":1)"), "folder/a.gltf");
    ASSERT_EQ(o.parts.size(), 2u);
    EXPECT_EQ(o.parts[0].material, -1);
    EXPECT_EQ(o.parts[1].material, 1);
    EXPECT_TRUE(o.has_materials());
    EXPECT_FALSE(o.materials[0].used);
    EXPECT_TRUE(o.materials[1].used);
    for (const GltfPart& part : o.parts) {
        ASSERT_EQ(part.mesh->triangles.size(), 1u);
        for (std::size_t i = 0; i < part.mesh->positions.size(); ++i) {
            const Point3f p = part.mesh->positions[i];
            EXPECT_EQ(part.mesh->uvs[i], (part.material < 0 ? Vec2f{p.x, p.y} : Vec2f{p.y, p.x}));
        }
    }
    EXPECT_EQ(o.images.at(0).path, "folder/a b.png");
    const auto whole = parse_mesh(square_gltf(textures), "a.gltf");
    EXPECT_EQ(whole->triangles.size(), 2u);

    // Nothing says that there is a material.
    EXPECT_FALSE(parse_gltf_object(square_gltf("", "", ""), "a.gltf").has_materials());
}

TEST(GltfMaterials, TexturesKnowHowTheyAreLaidOn) {
    const GltfMaterial m = only_material(
        R"({"emissiveTexture":{"index":0,"texCoord":1,"extensions":{"KHR_texture_transform":)"
        R"({"offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5],"texCoord":0}}}})",
        R"(,"images":[{"uri":"data:image/png;base64,)" + base64("not a picture yet") +
            R"("}],"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}],)"
            R"("textures":[{"source":0,"sampler":0}])");
    const GltfTexture& t = m.emissive_texture;
    EXPECT_EQ(t.coordinates, 0);
    EXPECT_EQ(t.wrap_u, GltfTexture::Wrap::clamp);
    EXPECT_EQ(t.wrap_v, GltfTexture::Wrap::mirror);
    EXPECT_TRUE(t.nearest);
    // The extension's own example: the lower left quadrant of the picture.
    for (const auto& [u, v, x, y] : {std::array{0.f, 0.f, 0.f, 1.f},
                                     {1.f, 0.f, 0.f, 0.5f},
                                     {0.f, 1.f, 0.5f, 1.f},
                                     {1.f, 1.f, 0.5f, 0.5f}}) {
        const Point3f p = t.to_uv.point({u, v, 0});
        EXPECT_NEAR(p.x, x, 1e-6f) << u << " " << v;
        EXPECT_NEAR(p.y, y, 1e-6f) << u << " " << v;
    }
}

TEST(GltfMaterials, PicturesInsideTheFileAreKept) {
    const GltfObject o = parse_gltf_object(
        square_gltf(R"(,"materials":[{}],"images":[{"name":"bark","uri":"data:image/png;base64,)" +
                    base64("abc") + R"("}])"),
        "a.gltf");
    EXPECT_EQ(o.images.at(0).bytes(), "abc");
    EXPECT_EQ(o.images.at(0).name, "a.gltf: picture 'bark'");
}

TEST(GltfMaterials, WrongValues) {
    const auto message = [](const std::string& material) {
        try {
            only_material(R"({"name":"m",)" + material + "}");
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    const auto extension = [](const char* name, const char* members) {
        return fmt::format(R"("extensions":{{"KHR_materials_{}":{{{}}}}})", name, members);
    };
    const std::pair<std::string, const char*> cases[] = {
        {R"("pbrMetallicRoughness":{"metallicFactor":1.5})",
         "metallicFactor is 1.5; it must lie within [0, 1]"},
        {R"("pbrMetallicRoughness":{"roughnessFactor":-1})",
         "roughnessFactor is -1; it must lie within [0, 1]"},
        {R"("pbrMetallicRoughness":{"baseColorFactor":[1,2,0,1]})",
         "baseColorFactor is 2; it must lie within [0, 1]"},
        {R"("alphaMode":"CUTOUT")", "alphaMode 'CUTOUT' is unknown; it is OPAQUE, MASK or BLEND"},
        {R"("emissiveTexture":{"index":3})", nullptr},
        {extension("ior", R"("ior":0.5)"), "ior is 0.5; it must lie within [1, 10]"},
        {extension("volume", R"("attenuationDistance":0)"),
         "attenuationDistance is 0; it must be positive"},
        {extension("volume", R"("attenuationColor":[1,1])"),
         "attenuationColor has 2 numbers; it needs 3"},
        {extension("transmission", R"("transmissionFactor":"all")"),
         "transmissionFactor is not a number"},
        {extension("volume_scatter", R"("scatterAnisotropy":1)"),
         "scatterAnisotropy is 1; it must lie within [-0.999, 0.999]"},
        {extension("transmission", R"("transmissionTexture":{"index":-1})"),
         "transmissionTexture names number -1; it must lie within [0, 2147483647]"},
        {extension("transmission", R"("transmissionTexture":{"index":1e30})"),
         "transmissionTexture names number 1e+30; it must lie within [0, 2147483647]"},
    };
    for (const auto& [json, what] : cases)
        EXPECT_EQ(message(json), what ? fmt::format("a.gltf: material 'm': {}", what)
                                      : "a.gltf: names texture 3, but there are 0");
    // Would wrap to 1.
    EXPECT_EQ(message(extension("transmission", R"("transmissionTexture":{"index":4294967297})")),
              "a.gltf: has 4294967297 as 'index', which is out of range; export it again");
}

}  // namespace
}  // namespace nacre::test
