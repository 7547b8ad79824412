// Lists of descriptions, and finding in them.
#include "nacre/catalogue/catalogue.h"

#include "tests/support/error_of.h"

namespace nacre {
namespace {

using test::error_of;

struct Tree {
    std::string_view name;
    std::vector<std::string_view> aliases = {};
};
const Tree oak{"oak", {"Quercus"}}, silver_fir{"silver_fir"}, ash{"ash", {"3"}};
const Tree* const forest[] = {&oak, &silver_fir, &ash};

}  // namespace

TEST(Catalogue, FindsByNameAndAlias) {
    const Catalogue<Tree> trees("tree", forest);
    for (const auto& [name, tree] : {std::pair{"oak", &oak},
                                     {"OAK", &oak},
                                     {"Quercus", &oak},
                                     {"Silver Fir", &silver_fir},
                                     {"silver-fir", &silver_fir},
                                     {"3", &ash}})
        EXPECT_EQ(&trees.find(name), tree) << name;
    for (const char* name : {"elm", "-3", "quercus"}) EXPECT_EQ(trees.look(name), nullptr) << name;
    EXPECT_EQ(error_of([&] { trees.find("silver_fur"); }),
              "unknown tree 'silver_fur'; did you mean 'silver_fir'?");
    EXPECT_EQ(error_of([&] { trees.find("magnolia"); }),
              "unknown tree 'magnolia'; known are: oak, silver_fir, ash");
    EXPECT_EQ(error_of([&] { trees.find(""); }),
              "unknown tree ''; known are: oak, silver_fir, ash");
}

TEST(Catalogue, IsARangeInTheOrderOfTheList) {
    const Catalogue<Tree> trees("tree", forest);
    EXPECT_EQ(trees.size(), 3u);
    EXPECT_EQ(trees.what(), "tree");
    EXPECT_EQ(trees.names(), (std::vector<std::string_view>{"oak", "silver_fir", "ash"}));
    EXPECT_TRUE(std::equal(trees.begin(), trees.end(), std::begin(forest), std::end(forest)));
    EXPECT_EQ(trees.all().data()[2], &ash);
}

// A name wins over another's alias: what is listed can be found.
TEST(Catalogue, NamesComeBeforeAliases) {
    const Tree first{"elm", {"oak"}};
    const Tree* const both[] = {&first, &oak};
    EXPECT_EQ(&Catalogue<Tree>("tree", both).find("oak"), &oak);
}

TEST(Catalogue, TwoOfOneNameAreAMistakeOfTheProgram) {
    const Tree other{"Silver-Fir"};
    const Tree* const twice[] = {&oak, &silver_fir, &other};
    EXPECT_THROW(Catalogue<Tree>("tree", twice), std::logic_error);
}

}  // namespace nacre
