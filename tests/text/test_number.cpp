#include "nacre/text/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nacre/text/lines.h"

namespace nacre {
namespace {

TEST(Number, WholeWordsOnly) {
    const std::pair<const char*, double> good[] = {{"1", 1},
                                                   {"+1.0", 1},
                                                   {"-2.5e1", -25},
                                                   {".5", 0.5},
                                                   {"5.", 5},
                                                   {"1E+2", 100},
                                                   {"1e-50", 1e-50},
                                                   {"-1e-999", 0},
                                                   {"0e999999999999999999999", 0},
                                                   {"1e-99999999999999999999", 0}};
    for (const auto& [word, value] : good) {
        ASSERT_TRUE(parse_number(word)) << word;
        EXPECT_EQ(*parse_number(word), value) << word;
    }
    for (const char* word :
         {"",      "+",   "-",   ".",   "1e",  "1e+", "1.0+01", "1.2.3", "1e5e5", "0x10",
          "0x1p3", "1,5", "1d5", "+-1", "++1", "--1", "one",    "1 ",    "1.#",   "1f"})
        EXPECT_FALSE(parse_number(word)) << word;
}

TEST(Number, BeyondTheRange) {
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(parse_number("1e999"), inf);
    EXPECT_EQ(parse_number("-1e99999999999999999999"), -inf);
    EXPECT_EQ(parse_number("0.001e400"), inf);
    EXPECT_EQ(parse_number("1" + std::string(400, '0')), inf);
    EXPECT_EQ(parse_number("1" + std::string(400, '0') + "e-800"), 0);
    EXPECT_EQ(parse_number("0." + std::string(400, '0') + "1"), 0);
    EXPECT_EQ(parse_number("1" + std::string(400, '0') + "e-400"), 1);
    EXPECT_TRUE(std::signbit(*parse_number("-1e-999")));
    for (const char* word : {"inf", "Infinity", "-inf", "1.#INF", "-1.#INF00"})
        EXPECT_TRUE(parse_number(word) && std::isinf(*parse_number(word))) << word;
    for (const char* word :
         {"nan", "NaN", "-nan(ind)", "1.#IND", "-1.#IND", "1.#QNAN", "nan(snan)"})
        EXPECT_TRUE(parse_number(word) && std::isnan(*parse_number(word))) << word;
}

TEST(Number, IntegersDoNotWrap) {
    EXPECT_EQ(parse_integer("-7"), -7);
    EXPECT_EQ(parse_integer("+4294967297"), 4294967297);
    for (const char* word :
         {"", "1.0", "1e3", "9223372036854775808", "18446744073709551617", "+-1"})
        EXPECT_FALSE(parse_integer(word)) << word;
}

TEST(Lines, EndsOfAnySystem) {
    const std::string text =
        "\xef\xbb\xbf"
        "a\nb\r\nc\rd\r\r\n\n e  f # g\r";
    LineSplitter lines(text);
    std::vector<std::string> found;
    for (std::string_view line; lines.next(line);) found.emplace_back(line);
    EXPECT_EQ(found, (std::vector<std::string>{"a", "b", "c", "d", "", "", " e  f # g"}));
    EXPECT_EQ(lines.line(), 7u);
    EXPECT_EQ(lines.offset(), text.size());
    std::string_view line = without_comment(found.back());
    EXPECT_EQ(take_word(line), "e");
    EXPECT_EQ(take_word(line), "f");
    EXPECT_EQ(take_word(line), "");
    EXPECT_EQ(without_comment("1.#IND -1.#QNAN 1.#INF 1.#comment"), "1.#IND -1.#QNAN 1.#INF 1.");
    EXPECT_EQ(without_comment("#IND"), "");
}

}  // namespace
}  // namespace nacre
