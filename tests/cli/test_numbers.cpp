// Numbers on the command line: every option has a range, and what is no number is refused whole.
#include "tests/cli/command_line.h"

namespace nacre {
namespace {

using test::Outcome;

class Numbers : public test::CommandLine {};

constexpr const char* whole_64 = "is not a whole number from 0 to 18446744073709551615";
constexpr const char* photons = "is not a whole number from 64 to 9007199254740992";
constexpr const char* time = "is not a time above 0 to 1e+09 s, such as 90, 60s, 5m or 1h30m";
constexpr const char* share = "is not a share above 0 to 100%, such as 1% or 0.01";
constexpr const char* samples = "is not a whole number from 1 to 1073741824";

TEST_F(Numbers, OutsideOfTheirRangeAreRefusedWithIt) {
    const struct {
        const char *arguments, *option, *value, *range;
    } cases[] = {
        // What unsigned numbers would wrap to, and signed ones overflow to.
        {"slab --layer thickness=1 --method mc --photons -1", "--photons", "-1", photons},
        {"slab --layer thickness=1 --method mc --photons 18446744073709551616", "--photons",
         "18446744073709551616", photons},
        {"slab --layer thickness=1 --seed -1", "--seed", "-1", whole_64},
        {"check lambert --seed -1", "--seed", "-1", whole_64},
        {"check lambert --seed 18446744073709551616", "--seed", "18446744073709551616", whole_64},
        {"check lambert --samples 999", "--samples", "999",
         "is not a whole number from 1000 to 100000000"},
        {"render quick.xml --seed -1", "--seed", "-1", whole_64},
        {"render quick.xml -t -1", "--threads", "-1", "is not a whole number from 1 to 65536"},
        {"render quick.xml -t 65537", "--threads", "65537",
         "is not a whole number from 1 to 65536"},
        {"render quick.xml -t 4294967297", "--threads", "4294967297",
         "is not a whole number from 1 to 65536"},
        {"compare -t 65537", "--threads", "65537", "is not a whole number from 1 to 65536"},
        {"demo -t 65537", "--threads", "65537", "is not a whole number from 1 to 65536"},
        {"gallery -o g -t 65537", "--threads", "65537", "is not a whole number from 1 to 65536"},
        {"render quick.xml --spp -1", "--spp", "-1", samples},
        {"render quick.xml --spp 4294967297", "--spp", "4294967297", samples},
        {"demo --spp 0", "--spp", "0", samples},
        {"gallery -o g --spp 1073741825", "--spp", "1073741825", samples},
        {"compare --repeats 4294967298", "--repeats", "4294967298",
         "is not a whole number from 2 to 10000"},
        {"profile dipole --sigma-s 1 --mc -1", "--mc", "-1", photons},
        {"profile dipole --sigma-s 1 --seed -1", "--seed", "-1", whole_64},
        {"slab --skin --radial --bins 10001", "--bins", "10001",
         "is not a whole number from 1 to 10000"},
        // What is no number, or only begins like one.
        {"render quick.xml --spp 12abc", "--spp", "12abc", samples},
        {"render quick.xml --spp ' 5'", "--spp", " 5", samples},
        {"render quick.xml --spp 0x10", "--spp", "0x10", samples},
        {"render quick.xml --spp 1.5", "--spp", "1.5", samples},
        {"render quick.xml --spp ''", "--spp", "", samples},
        {"render quick.xml --spp \"1'000\"", "--spp", "1'000", samples},
        {"render quick.xml --timeout nan", "--timeout", "nan", time},
        {"render quick.xml --timeout inf", "--timeout", "inf", time},
        {"render quick.xml --timeout 1.2.3", "--timeout", "1.2.3", time},
        // Units in another order, of another name, twice, or alone.
        {"render quick.xml --timeout 5m1h", "--timeout", "5m1h", time},
        {"render quick.xml --timeout 200ms", "--timeout", "200ms", time},
        {"render quick.xml --timeout 1m1m", "--timeout", "1m1m", time},
        {"render quick.xml --timeout 1h30", "--timeout", "1h30", time},
        {"render quick.xml --timeout m", "--timeout", "m", time},
        {"render quick.xml --timeout -5m", "--timeout", "-5m", time},
        {"render quick.xml --checkpoint 0s", "--checkpoint", "0s", time},
        {"render quick.xml --noise 1", "--noise", "1", share},
        {"render quick.xml --noise 0%", "--noise", "0%", share},
        {"render quick.xml --noise 101%", "--noise", "101%", share},
        {"render quick.xml --noise -1%", "--noise", "-1%", share},
        {"render quick.xml --noise %", "--noise", "%", share},
        {"demo --timeout 0", "--timeout", "0", time},
        {"render quick.xml --exposure nan", "--exposure", "nan",
         "is not a number from -100 to 100"},
        {"image a.exr -o b.exr --exposure 101", "--exposure", "101",
         "is not a number from -100 to 100"},
        {"render flat.obj --height-mm nan", "--height-mm", "nan",
         "is not a number from 1e-09 to 1e+09"},
        {"gallery -o g --scale 17", "--scale", "17", "is not a number above 0 to 16"},
        {"eval lambert --albedo --lambda nan", "--lambda", "nan",
         "is not a number above 0 to 1e+09"},
        {"profile dipole --sigma-s nan", "--sigma-s", "nan", "is not a number"},
        {"profile dipole --sigma-s 1 --g 1e999", "--g", "1e999", "is not a number"},
        {"slab --layer thickness=1 --eta-above 1.2.3", "--eta-above", "1.2.3", "is not a number"},
        {"slab --layer thickness=1 --angle nan", "--angle", "nan",
         "is not a number from 0 to below 90"},
    };
    for (const auto& c : cases) {
        const Outcome r = nacre(c.arguments);
        EXPECT_EQ(r.code, 2) << c.arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}: '{}' {}\n", c.option, c.value, c.range))
            << c.arguments;
        EXPECT_EQ(r.out, "") << c.arguments;
        EXPECT_EQ(written(), std::vector<std::string>{}) << c.arguments;
    }
}

TEST_F(Numbers, WithinOtherTextAreReadWholeToo) {
    const char* direction = "is not a direction; write x,y,z, such as 0.6,0,0.8";
    const std::pair<const char*, std::string> cases[] = {
        {"eval lambert --wo 0,0,1 --wi 0,0,1,5", fmt::format("--wi '0,0,1,5' {}", direction)},
        {"eval lambert --wo 0,0,1 --wi 0,0,nan", fmt::format("--wi '0,0,nan' {}", direction)},
        {"eval lambert --wo 0,0,1 --wi 0,0", fmt::format("--wi '0,0' {}", direction)},
        {"eval lambert --wo 0,0,0x1 --wi 0,0,1", fmt::format("--wo '0,0,0x1' {}", direction)},
        {"eval ggx --albedo --set alpha=1.2.3", "'1.2.3' in 'alpha=1.2.3' is not a number"},
        {"slab --layer 'tau=1.2.3 albedo=1'", "layer 1: tau = '1.2.3' is not a number"},
        {"slab --layer 'tau=nan albedo=1'", "layer 1: tau = 'nan' is not a number"},
        {"render quick.xml --size 4294967297x10",
         "--size: '4294967297x10' is not a size; write WIDTHxHEIGHT in pixels, from 1 to 65536 "
         "each, such as 640x480"},
        {"render quick.xml --crop 0,0,4294967297,1",
         "--crop: '0,0,4294967297,1' is not a window; write x,y,width,height in pixels"},
        {"render quick.xml --crop 0,0,1,1,1",
         "--crop: '0,0,1,1,1' is not a window; write x,y,width,height in pixels"},
        {"compare --spp 4294967297",
         "--spp: '4294967297' is not a number of samples from 1 to 1073741824; write 16, or "
         "several as 4,16"},
        {"compare --reference-error nan",
         "--reference-error: 'nan' is not a share from 0.0001% to 100%; write 0.5% or 0.005"},
        {"render quick.xml -D spp=-1",
         "quick.xml:8:37: 'sample_count' of <sampler type=\"independent\"> must lie within [1, "
         "2147483647]; got -1"},
        {"render quick.xml -D spp=10000000000",
         "quick.xml:8:37: 'sample_count' of <sampler type=\"independent\"> must lie within [1, "
         "2147483647]; got 10000000000"},
        {"render quick.xml -D spp=99999999999999999999",
         "quick.xml:8:37: '99999999999999999999' is too large for an integer"},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome r = nacre(arguments);
        EXPECT_EQ(r.code, 2) << arguments;
        EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
        EXPECT_EQ(written(), std::vector<std::string>{}) << arguments;
    }
}

TEST_F(Numbers, AreTakenInTheFormsThatPeopleWrite) {
    const std::string totals = "slab --layer 'tau=1 albedo=0.9' --method mc --json --photons ";
    const std::string plain = nacre(totals + "10000").out;
    EXPECT_NE(plain, "");
    for (const char* same : {"1e4", "+10000", "010000"})
        EXPECT_EQ(nacre(totals + same).out, plain) << same;
    EXPECT_EQ(nacre("check lambert --seed 18446744073709551615 --samples 1e3").code, 0);
    EXPECT_EQ(nacre("render quick.xml -o a.exr -t 65536 --quiet").code, 0);
}

TEST_F(Numbers, APictureThatTheMemoryCannotHoldIsRefusedAtOnce) {
    const Outcome r = nacre("render quick.xml --size 65536x65536");
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(
        r.err.starts_with("nacre: a picture of 65536 x 65536 pixels takes 343.6 GB of "
                          "memory, and this machine has "))
        << r.err;
    EXPECT_EQ(written(), std::vector<std::string>{});
}

}  // namespace
}  // namespace nacre
