// Names that people type, and the one sentence that refuses them.
#include "nacre/text/names.h"

namespace nacre {

TEST(Names, AreComparedWithoutCaseBlanksDashesAndUnderscores) {
    EXPECT_EQ(plain_name("Head & Shoulders_sham-POO"), "head&shouldersshampoo");
    EXPECT_EQ(plain_name(" _-"), "");
    const std::vector<std::string> known = {"to_world", "fov"};
    EXPECT_EQ(find_name("toWorld", known), 0);
    EXPECT_EQ(find_name("FOV", known), 1);
    EXPECT_EQ(find_name("fo", known), -1);
    EXPECT_EQ(find_name("fov", {}), -1);
}

TEST(Names, TheNearestIsAPlausibleMisspelling) {
    const std::vector<std::string> known = {"reflectance", "radiance", "to_world", "fov",
                                            "sigma_t",     "gaussian", "ward"};
    const std::pair<const char*, const char*> cases[] = {
        {"reflectanse", "reflectance"},  // another letter
        {"toWorld", "to_world"},         // other separators
        {"fvo", "fov"},                  // neighbours swapped
        {"wrad", "ward"},                // as two changes it would be too far
        {"sigma", "sigma_t"},            // one letter short
        {"gauss", "gaussian"},           // cut short by more than a third
        {"gau", "gaussian"},
        {"ga", ""},  // two letters say nothing
        {"rfelectnace", "reflectance"},
        {"banana", ""},
        {"", ""},
        {"x", ""},
    };
    for (const auto& [word, nearest] : cases) EXPECT_EQ(nearest_name(word, known), nearest) << word;
    // Of two that are as near, the first.
    EXPECT_EQ(nearest_name("hat", {"cat", "bat"}), "cat");
    // A single letter is never near: every name of one letter would be.
    EXPECT_EQ(nearest_name("x", {"y"}), "");
}

TEST(Names, OneSentenceRefusesThem) {
    const std::string_view models[] = {"phong", "ward"};
    EXPECT_EQ(unknown_name("model", "wart", models), "unknown model 'wart'; did you mean 'ward'?");
    EXPECT_EQ(unknown_name("model", "lambert", models),
              "unknown model 'lambert'; known are: phong, ward");
    EXPECT_EQ(unknown_name("model", "ward", {}), "unknown model 'ward'");
    EXPECT_EQ(suggestion("banana", {"a", "b"}), "; known are: a, b");
    EXPECT_EQ(suggestion("phnog", models), "; did you mean 'phong'?");
    EXPECT_EQ(suggestion("banana", {}), "");
}

TEST(Names, NounsHaveTheirArticle) {
    EXPECT_EQ(with_article("integer"), "an integer");
    EXPECT_EQ(with_article("float"), "a float");
    EXPECT_EQ(with_article("rgb"), "an rgb");
}

}  // namespace nacre
