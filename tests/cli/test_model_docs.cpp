// docs/models/ is what `nacre models docs` writes today.
#include "nacre/reflectance/registry.h"
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using test::Outcome;

const fs::path committed = fs::path(NACRE_SOURCE_DIR) / "docs/models";

class ModelDocs : public test::CommandLine {
  protected:
    /// Names of the files in a folder that are not pictures.
    static std::vector<std::string> texts(const fs::path& folder) {
        std::vector<std::string> names;
        for (const auto& f : fs::directory_iterator(folder))
            if (f.path().extension() != ".png" && f.path().extension() != ".svg")
                names.push_back(f.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }
};

TEST_F(ModelDocs, TheCommittedPagesAreNotStale) {
    const Outcome r = nacre("models docs made --text");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto made = texts(folder_ / "made");
    EXPECT_EQ(made.size(), models().size() + 2);  // README.md, sphere.xml
    EXPECT_EQ(texts(committed), made);
    for (const std::string& name : made)
        // Compared as a truth, so that a failure does not print two pages.
        EXPECT_TRUE(read(committed / name) == read(folder_ / "made" / name))
            << "docs/models/" << name << " is stale: run 'nacre models docs docs/models'";
}

TEST_F(ModelDocs, EveryPageHasItsPictures) {
    for (const ModelDescription* m : models())
        for (const char* picture : {"lobe.svg", "sphere.png"}) {
            const std::string name = fmt::format("{}-{}", m->name, picture);
            ASSERT_TRUE(fs::exists(committed / name)) << name;
            EXPECT_GT(fs::file_size(committed / name), 1000u) << name;
            // Lobes are drawn for the page; spheres are large enough to be printed, and no larger.
            EXPECT_LT(fs::file_size(committed / name),
                      fs::path(picture).extension() == ".svg" ? 20000u : 60000u)
                << name;
            const std::string page = read(committed / fmt::format("{}.md", m->name));
            EXPECT_NE(page.find("(" + name + ")"), std::string::npos) << name;
        }
}

// What a page must not leave out: every parameter with its range and default, every option, every
// erratum's and reference's first words.
TEST_F(ModelDocs, PagesSayAllThatTheModelsSay) {
    ASSERT_EQ(nacre("models docs made --text").code, 0);
    const std::string ward = read(folder_ / "made/ward.md");
    for (const char* part :
         {"# Ward\n", "Measuring and Modeling Anisotropic Reflection",
          "| `alpha_u` | roughness along the tangent", "| number | (0, 10] |  | `0.1` | `alpha`",
          "`kd + ks` must not exceed 1", "- `gmd` (default): ", "- `duer`: ",
          "| `variant=duer` | yes | no |", "## Errata", "Cornell PCG-05-06", "nacre check ward"})
        EXPECT_NE(ward.find(part), std::string::npos) << part;
    EXPECT_NE(read(folder_ / "made/he_torrance.md").find("| micrometres |"), std::string::npos);
}

TEST_F(ModelDocs, AFolderThatCannotBeMadeIsAnError) {
    std::ofstream(folder_ / "file") << "x";
    const Outcome r = nacre("models docs file/inside --text");
    EXPECT_EQ(r.code, 1);
    EXPECT_EQ(r.err, "nacre: cannot make the folder 'file/inside': Not a directory\n");
}

}  // namespace
}  // namespace nacre
