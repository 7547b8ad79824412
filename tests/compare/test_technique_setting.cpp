#include "nacre/compare/technique_setting.h"
#include "tests/compare/experiment_fixture.h"

namespace nacre::test {

TEST(TechniqueSettings, AllHoldsEveryTechnique) {
    const auto all = parse_techniques("all", {4, 16});
    for (const TechniqueDescription* t : techniques()) {
        const auto n = std::ranges::count_if(
            all, [&](const TechniqueSetting& s) { return s.choice.technique == t->name; });
        EXPECT_EQ(std::size_t(n), 2 * variants_of(*t).size()) << t->name;
    }
}

TEST(TechniqueSettings, SayWhatTheyAre) {
    const auto s = parse_techniques("two_pass:profile=better_dipole:error=0.1:spacing=2", {8});
    ASSERT_EQ(s.size(), 1u);
    EXPECT_EQ(s[0].options(), "profile=better_dipole error=0.1 spacing=2");
    EXPECT_EQ(s[0].id(), "two_pass profile=better_dipole error=0.1 spacing=2 8 spp");
    EXPECT_EQ(
        s[0].arguments(),
        "--technique two_pass --profile better_dipole --set error=0.1 --set spacing=2 --spp 8");
}

TEST(TechniqueSettings, MistakesAreNamed) {
    const struct {
        const char *list, *message;
    } cases[] = {
        {",", "no technique is named; write all, or see 'nacre models'"},
        {"two_pass:error", "'error' of two_pass is not of the form name=value"},
        {"two_pass:eror=1", "two_pass: unknown parameter 'eror'; did you mean 'error'?"},
        {"brdf,brdf", "'brdf profile=dipole 1 spp' is asked for twice"},
    };
    for (const auto& c : cases)
        EXPECT_EQ(error_of([&] { parse_techniques(c.list, {1}); }), c.message);
    // Those that end in the list of all.
    const auto begins = [&](const char* list) {
        const std::string text = error_of([&] { parse_techniques(list, {1}); });
        return text.substr(0, text.find('?') + 1);
    };
    EXPECT_EQ(begins("twopas"), "unknown technique 'twopas'; did you mean 'two_pass'?");
    EXPECT_EQ(begins("surface:profile=diple"),
              "surface: unknown profile 'diple'; did you mean 'dipole'?");
}

}  // namespace nacre::test
