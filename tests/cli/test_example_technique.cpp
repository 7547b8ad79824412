// The example of docs/adding-a-technique.md, added to the program as that page says: by its file and
// a line. Everything that knows techniques knows it.
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.h"

namespace nacre::test {
namespace {

constexpr const char* ball = R"(<scene version="3.0.0"><integrator type="path"/>
<sensor type="perspective"><transform name="to_world"><lookat origin="0, 0, 5" target="0, 0, 0" up="0, 1, 0"/></transform><float name="fov" value="24"/>
<sampler type="independent"><integer name="sample_count" value="4"/></sampler>
<film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="64"/><rfilter type="box"/></film></sensor>
<emitter type="constant"><rgb name="radiance" value="1, 1, 1"/></emitter>
<shape type="sphere"><subsurface type="dipole"><string name="method" value="thickness"/>
<float name="share" value="{}"/><float name="sigma_s" value="1"/><float name="sigma_a" value="0.1"/></subsurface></shape></scene>
)";

class ExampleTechnique : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        program_ = NACRE_WITH_EXAMPLE;
        if (folder_.empty()) return;
        if (!fs::exists(program_)) GTEST_SKIP() << "no program at " << program_;
        std::ofstream(folder_ / "ball.xml") << fmt::format(ball, 0.5);
        std::ofstream(folder_ / "wrong.xml") << fmt::format(ball, 2);
    }
    double mean_of(const std::string& arguments) const {
        const Outcome r = nacre("render ball.xml -o a.exr --quiet --json " + arguments);
        EXPECT_EQ(r.code, 0) << r.err;
        return nlohmann::json::parse(r.out)["mean"][0];
    }
};

TEST_F(ExampleTechnique, AppearsInTheListsOfModels) {
    EXPECT_NE(nacre("models").out.find("\n  thickness              attenuation by thickness (S. "
                                       "Green, 2004)\n"),
              std::string::npos);
    EXPECT_NE(nacre("render --help").out.find("diffusion_grid, thickness"), std::string::npos);
    const auto json = nlohmann::json::parse(nacre("models show thickness --json").out);
    EXPECT_EQ(json["kind"], "technique");
    EXPECT_EQ(json["may_change"], "view, light, geometry");
    ASSERT_EQ(json["parameters"].size(), 4u);
    EXPECT_EQ(json["parameters"][3]["name"], "length");
    EXPECT_EQ(json["parameters"][3]["high"], 1000.);
}

TEST_F(ExampleTechnique, Renders) {
    const double half = mean_of(""), none = mean_of("--technique thickness --set share=0"),
                 all = mean_of("--technique thickness --set share=1 --set length=1000");
    // Nothing comes through, or all of it unweakened: in even light on a ball it is the same.
    EXPECT_NEAR(none, mean_of("--technique brdf"), 0.01 * none);
    EXPECT_NEAR(all, none, 0.02 * none);
    EXPECT_LT(half, 0.95 * none);
}

TEST_F(ExampleTechnique, IsCompared) {
    const Outcome r = nacre(
        "compare ball.xml --techniques thickness,thickness:share=0.1:profile=better_dipole "
        "--spp 2 --repeats 2 --size 64x64 --reference-error 0.1 --quiet -o out --keep kept");
    ASSERT_EQ(r.code, 0) << r.err;
    const std::string page = read(folder_ / "out" / "index.html");
    for (const char* row : {"thickness share=0.3 2 spp", "thickness share=0.6 2 spp",
                            "thickness profile=better_dipole share=0.1 2 spp"})
        EXPECT_NE(page.find(row), std::string::npos) << row;
}

TEST_F(ExampleTechnique, RefusesWhatIsWrong) {
    const std::pair<const char*, const char*> cases[] = {
        {"render ball.xml -o a.exr --technique thicknes",
         "unknown technique 'thicknes'; did you mean 'thickness'?"},
        {"render ball.xml -o a.exr --technique thickness --set shar=0.1",
         "thickness: unknown parameter 'shar'; did you mean 'share'?"},
        {"render ball.xml -o a.exr --technique thickness --set length=0",
         "thickness: length = 0 is out of range: must lie within (0, 1000]"},
        {"compare ball.xml --techniques thickness:share=2 -o out",
         "thickness: share = 2 is out of range: must lie within [0, 1]"},
        {"render wrong.xml -o a.exr",
         "wrong.xml:7:1: thickness: share = 2 is out of range: must lie within [0, 1]"},
        {"compare wrong.xml --techniques brdf -o out",
         "wrong.xml:7:1: thickness: share = 2 is out of range: must lie within [0, 1]"},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
    }
    EXPECT_FALSE(fs::exists(folder_ / "a.exr") || fs::exists(folder_ / "out"));
}

/// What the page quotes is what is built.
TEST_F(ExampleTechnique, IsThatOfTheDocumentation) {
    const fs::path source = NACRE_SOURCE_DIR;
    std::ifstream page(source / "docs" / "adding-a-technique.md");
    const std::string example = read(source / "examples" / "thickness.cpp"),
                      list = read(source / "src/nacre/techniques/techniques.cpp");
    const auto squeezed = [](std::string text) {
        std::erase_if(text, [](unsigned char c) { return std::isspace(c) || c == '\\'; });
        return text;
    };
    int quoted = 0;
    for (std::string line; std::getline(page, line);) {
        if (!line.starts_with("    ") || line.find("nacre ") == 4) continue;
        const std::string code = squeezed(line);
        if (code == "..." || code == "X(thickness)") continue;
        EXPECT_TRUE(squeezed(example).find(code) != std::string::npos ||
                    squeezed(list).find(code) != std::string::npos)
            << line;
        ++quoted;
    }
    EXPECT_GT(quoted, 15);
}

}  // namespace
}  // namespace nacre::test
