// The layer over OpenGL: shaders, textures, errors.
#include <epoxy/gl.h>

#include "nacre/realtime/gl/gpu.h"
#include "tests/realtime/frames.h"

namespace nacre {
namespace {

class Gl : public Frames {};

template <class F>
std::string run_error_of(F&& f) {
    try {
        f();
    } catch (const RunError& error) {
        return error.what();
    }
    return "no error";
}

/// Every file that is a program compiles on this driver.
TEST_F(Gl, AllShadersCompile) {
    int programs = 0;
    for (const ShaderFile& file : shader_files()) {
        if (file.text.find("local_size_x") == std::string_view::npos) continue;
        ++programs;
        const bool steps = file.text.find("STEP") != std::string_view::npos ||
                           file.text.find("visibility_pixel") != std::string_view::npos;
        for (const char* defines : {"STEP=0", "STEP=1", "PAPER", ""}) {
            if (steps != std::string_view(defines).starts_with("STEP")) continue;
            EXPECT_NO_THROW(gpu().program(file.name, defines)) << file.name;
        }
    }
    EXPECT_GE(programs, 8);
    EXPECT_NO_THROW(gpu().program(
        {.vertex = "visibility_raster.vert.glsl", .fragment = "visibility_raster.frag.glsl"}));
}

TEST_F(Gl, WhatIsWrongIsSaid) {
    EXPECT_EQ(run_error_of([&] { gpu().program("no.glsl"); }), "there is no shader file 'no.glsl'");
    // A define that breaks the text.
    const std::string error =
        run_error_of([&] { gpu().program("light_mip.glsl", "position_from=5"); });
    EXPECT_TRUE(
        error.starts_with("the shader light_mip.glsl (position_from=5) cannot be compiled "
                          "by this driver (0 is light_mip.glsl): "))
        << error;
    EXPECT_TRUE(run_error_of([] {
                    Texture(TexelFormat::r32f, 1 << 20, 4);
                }).starts_with("a picture of 1048576 x 4 does not fit the device, which takes "));
    EXPECT_EQ(run_error_of([] {
                  Texture t(TexelFormat::rgba32f, 2, 2);
                  t.upload(std::vector<float>(3));
              }),
              "a picture of 2 x 2 was given 3 numbers instead of 16");
}

/// What the driver complains of names the pass.
TEST_F(Gl, ErrorsNameTheirPass) {
    const Program& program = gpu().program("light_mip.glsl");
    const Texture one(TexelFormat::rgba32f, 4, 4);
    // A level that the texture does not have.
    const std::string error = run_error_of([&] {
        gpu()
            .compute("a pass", program)
            .reads_image(0, one, -1)
            .reads_image(1, one)
            .writes(2, one)
            .writes(3, one)
            .threads(4, 4);
        gpu().check_errors();
    });
    EXPECT_TRUE(error.starts_with("OpenGL in the pass '")) << error;
}

TEST_F(Gl, IncludesComeOnce) {
    const std::string source = shader_source("light_view.glsl");
    std::size_t count = 0;
    for (std::size_t at = source.find("struct Material"); at != std::string::npos;
         at = source.find("struct Material", at + 1))
        ++count;
    EXPECT_EQ(count, 1u);
    EXPECT_EQ(source.find("#include"), std::string::npos);
    EXPECT_TRUE(source.starts_with("#version 450 core\n"));
}

TEST_F(Gl, TexturesHoldWhatTheyAreGiven) {
    Texture t(TexelFormat::rgba32f, 3, 2, 1);
    std::vector<float> texels;
    for (int i = 0; i < 24; ++i) texels.push_back(float(i) * 1.25f);
    t.upload(texels);
    EXPECT_EQ(t.read(), texels);
    EXPECT_EQ(t.bytes(), 3u * 2u * 16u);
    EXPECT_EQ(Texture(TexelFormat::rgba16f, 8, 8, 4).bytes(), (64u + 16u + 4u + 1u) * 8u);
    std::vector<std::uint32_t> numbers{1, 2, 3};
    const Buffer b(numbers);
    std::uint32_t back[2];
    b.read(4, 8, back);
    EXPECT_EQ(back[0], 2u);
    EXPECT_EQ(back[1], 3u);
}

/// Passes of one name are added up, in the order of their first appearance.
TEST_F(Gl, PassesAreTimed) {
    const Texture a(TexelFormat::rgba32f, 64, 64), b(TexelFormat::rgba32f, 32, 32);
    gpu().begin_timing();
    for (const char* name : {"first", "second", "first"})
        gpu()
            .compute(name, gpu().program("light_mip.glsl"))
            .reads_image(0, a)
            .reads_image(1, a)
            .writes(2, b)
            .writes(3, b)
            .threads(32, 32);
    const std::vector<PassTime> times = gpu().end_timing();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "first");
    EXPECT_EQ(times[1].name, "second");
    EXPECT_GT(times[0].ms, 0.);
    EXPECT_TRUE(gpu().end_timing().empty());
}

/// What was made is given back: of all names so far no more are textures than before.
TEST_F(Gl, NothingIsLeft) {
    const auto living = [] {
        const Texture last(TexelFormat::r32f, 4, 4);
        int count = 0;
        for (std::uint32_t name = 1; name < last.name(); ++name) count += glIsTexture(name);
        return count;
    };
    const int before = living();
    for (int i = 0; i < 1000; ++i) {
        Texture a(TexelFormat::rgba32f, 8, 8, 3), b(TexelFormat::r32ui, 4, 4);
        a = Texture(TexelFormat::rgba32f, 4, 4);
        Texture c = std::move(b);
    }
    EXPECT_EQ(living(), before);
}

}  // namespace
}  // namespace nacre
