#include "nacre/measured/merl.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/measured/half_angle.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

constexpr std::size_t count = 90 * 90 * 180;

/// A file, its values by plane and node as stored (before the scales).
class File {
  public:
    File() : bytes_(12 + 24 * count, '\0') { header(90, 90, 180); }
    void header(std::int32_t a, std::int32_t b, std::int32_t c) {
        const std::int32_t n[3] = {a, b, c};
        std::memcpy(bytes_.data(), n, 12);
    }
    void set(int plane, std::size_t node, double value) {
        std::memcpy(bytes_.data() + 12 + 8 * (plane * count + node), &value, 8);
    }
    template <class F>
    void fill(F&& f) {
        for (int h = 0; h < 90; ++h)
            for (int d = 0; d < 90; ++d)
                for (int p = 0; p < 180; ++p)
                    for (int c = 0; c < 3; ++c) set(c, node(h, d, p), f(c, h, d, p));
    }
    static std::size_t node(int h, int d, int p) { return (std::size_t(h) * 90 + d) * 180 + p; }
    std::string& bytes() { return bytes_; }

  private:
    std::string bytes_;
};

/// Directions with these coordinates in units of nodes.
DirectionPair at(double h, double d, double p, double phi_h = 0.3) {
    return from_half_angle({.theta_h = h / 90. * h / 90. * 0.5 * pi,
                            .phi_h = phi_h,
                            .theta_d = d / 90. * 0.5 * pi,
                            .phi_d = p / 180. * pi});
}

std::string error_of(const std::string& bytes) {
    try {
        parse_merl(bytes, "felt.binary");
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST(Merl, NodesAndScales) {
    File file;
    file.fill([](int c, int h, int d, int p) { return c + 3. * p + 1000. * d + 100000. * h; });
    const MerlBrdf brdf = parse_merl(file.bytes(), "made");
    EXPECT_EQ(brdf.missing(), 0u);
    for (const auto& [h, d, p] : {std::array{0, 0, 0}, {40, 20, 70}, {12, 3, 179}, {60, 30, 1}}) {
        const double stored = 3. * p + 1000. * d + 100000. * h;
        const Vec3d want{stored / 1500., (stored + 1.) * 1.15 / 1500.,
                         (stored + 2.) * 1.66 / 1500.};
        const auto node = brdf.node(h, d, p);
        ASSERT_TRUE(node);
        // A hair above the node: its own value counts, whatever the lookup.
        const DirectionPair w = at(h + 1e-6, d + 1e-6, p + 1e-6);
        for (MerlLookup lookup : {MerlLookup::linear, MerlLookup::nearest}) {
            const auto found = brdf.eval(w.wi, w.wo, lookup);
            ASSERT_TRUE(found);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR((*node)[c], want[c], 1e-6 * want[c]);
                EXPECT_NEAR((*found)[c], want[c], 1e-5 * want[c] + 1e-3);
            }
        }
    }
}

// A table that is linear in the nodes comes back exactly, between them as well.
TEST(Merl, LinearLookupIsLinear) {
    File file;
    const auto f = [](double h, double d, double p) { return 500. + 7. * h + 3. * d + 2. * p; };
    file.fill([&](int, int h, int d, int p) { return f(h, d, p); });
    const MerlBrdf brdf = parse_merl(file.bytes(), "made");
    for (const auto& [h, d, p] :
         {std::array{3.25, 10.5, 20.75}, {30.5, 40.1, 100.9}, {50.5, 5.75, 2.5}}) {
        for (double half_turn : {0., 180.}) {  // the period of phi_d is half a circle
            const DirectionPair w = at(h, d, p + half_turn);
            const auto found = brdf.eval(w.wi, w.wo);
            ASSERT_TRUE(found);
            EXPECT_NEAR(found->x, f(h, d, p) / 1500., 1e-6);
        }
        const DirectionPair w = at(h, d, p);
        const auto found = brdf.eval(w.wi, w.wo, MerlLookup::nearest);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->x, f(std::floor(h), std::floor(d), std::floor(p)) / 1500., 1e-6);
    }
}

// Between the last node of phi_d and the end of the half circle stand that node and the first one.
TEST(Merl, TheAzimuthGoesRound) {
    File file;
    file.fill([](int, int, int, int p) { return p == 179 ? 1500. : p == 0 ? 3000. : 0.; });
    const MerlBrdf brdf = parse_merl(file.bytes(), "made");
    const DirectionPair w = at(30., 20., 179.25);
    EXPECT_NEAR(brdf.eval(w.wi, w.wo)->x, 0.75 * 1. + 0.25 * 2., 1e-6);
}

TEST(Merl, WhatIsNotMeasuredIsToldApart) {
    File file;
    // Black is a measurement, -1 is none; one band without one is none at all.
    file.fill([](int c, int h, int, int) { return h < 30 ? 0. : h == 40 && c == 2 ? -1. : 1500.; });
    const MerlBrdf brdf = parse_merl(file.bytes(), "made");
    EXPECT_EQ(brdf.missing(), 90u * 180u);
    EXPECT_EQ(brdf.node(10, 5, 5)->x, 0.);
    EXPECT_FALSE(brdf.node(40, 5, 5));
    const auto red = [&](double h) {
        const DirectionPair w = at(h, 20.5, 30.5);
        const auto v = brdf.eval(w.wi, w.wo);
        return v ? v->x : -1.;
    };
    EXPECT_NEAR(red(10.), 0., 1e-12);
    EXPECT_NEAR(red(38.), 1., 1e-6);
    EXPECT_NEAR(red(39.25), 1., 1e-6);  // three quarters of the weight are known
    EXPECT_EQ(red(39.75), -1.);
    EXPECT_EQ(red(40.25), -1.);
    EXPECT_NEAR(red(40.75), 1., 1e-6);
    EXPECT_FALSE(brdf.eval({0., 0., 1.}, {0.6, 0., -0.8}));
}

Vec3f hemisphere(Random& random) {
    const float z = random.next(), s = std::sqrt(1.f - z * z), phi = float(2. * pi) * random.next();
    return {s * std::cos(phi), s * std::sin(phi), z};
}

TEST(Merl, DirectionsThatAreNoNumbersStayWithinTheTable) {
    File file;
    file.fill([](int, int, int, int) { return 1.; });
    const MerlBrdf brdf = parse_merl(file.bytes(), "a.binary");
    for (const double bad : {nan, inf, -inf, 1e300}) {
        // What comes back is of no importance.
        brdf.eval(Vec3d{bad, 0., 0.5}, Vec3d{0., 0.6, 0.8});
        brdf.eval(Vec3d{0.6, 0., 0.8}, Vec3d{0., bad, 0.8}, MerlLookup::nearest);
        brdf.eval_float(Vec3f{float(bad), 0.f, 0.5f}, Vec3f{0.f, 0.6f, 0.8f});
        brdf.eval_float(Vec3f{0.f, 0.6f, 0.8f}, Vec3f{0.1f, float(bad), float(std::abs(bad))});
    }
}

TEST(Merl, SinglePrecisionSaysTheSame) {
    File file;
    file.fill([](int c, int h, int d, int p) {
        return (h * 7 + d * 3 + p) % 11 == 0 || h + d > 150 ? -1.
                                                            : 1000. + 10 * c + h - d + 0.1 * p;
    });
    const MerlBrdf brdf = parse_merl(file.bytes(), "a.binary");
    Random random(stream_key(3, 1));
    int known = 0, told = 0;
    for (int i = 0; i < 20000; ++i) {
        Vec3f wi = hemisphere(random), wo = hemisphere(random);
        if (i % 10 == 0) wo = {-wi.x, -wi.y, wi.z};                // theta_h = 0
        if (i % 10 == 1) wo = normalize(wi + Vec3f{1e-4f, 0, 0});  // theta_d near 0
        if (!(wo.z > 0.f)) continue;
        const auto expected = brdf.eval(Vec3d(wi), Vec3d(wo));
        const auto value = brdf.eval_float(wi, wo);
        const bool close = i % 10 == 1;  // theta_d near 0, where phi_d has few digits
        told += !close && value.has_value() != expected.has_value();
        if (!value || !expected) continue;
        ++known;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR((*value)[c], (*expected)[c], (close ? 2e-3 : 2e-4) * (*expected)[c]);
    }
    EXPECT_GT(known, 15000);
    EXPECT_LE(told, 2);  // just half the weight missing, by rounding
}

TEST(Merl, WrongFiles) {
    File good;
    good.set(0, 0, 1.);
    std::string longer = good.bytes() + "x", shorter = good.bytes();
    shorter.pop_back();
    File other, endless, empty, nan;
    other.header(90, 90, 360);
    endless.header(2000000000, 2000000000, 2000000000);
    empty.fill([](int, int, int, int) { return -1.; });
    nan.set(1, 41, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(error_of(good.bytes()), "no error");
    const std::pair<std::string, std::string> cases[] = {
        {"", "felt.binary: has 0 bytes, too few for a header; it is incomplete: fetch it again"},
        {"12345678901",
         "felt.binary: has 11 bytes, too few for a header; it is incomplete: fetch it again"},
        {other.bytes(),
         "felt.binary: the header says 90 x 90 x 360 values, not 90 x 90 x 180: it is not an "
         "isotropic BRDF of MERL's format"},
        {endless.bytes(),
         "felt.binary: the header says 2000000000 x 2000000000 x 2000000000 values, not 90 x 90 x "
         "180: it is not an isotropic BRDF of MERL's format"},
        {good.bytes().substr(0, 12),
         "felt.binary: has 12 bytes, but a BRDF of MERL's format has 34992012; it is incomplete or "
         "of another format: fetch it again"},
        {shorter,
         "felt.binary: has 34992011 bytes, but a BRDF of MERL's format has 34992012; it is "
         "incomplete or of another format: fetch it again"},
        {longer,
         "felt.binary: has 34992013 bytes, but a BRDF of MERL's format has 34992012; it is of "
         "another format"},
        {empty.bytes(), "felt.binary: all values are negative: there is no measurement in it"},
        {nan.bytes(),
         "felt.binary: value 42 of green is nan, not a finite number; it is damaged: fetch it "
         "again"},
    };
    for (const auto& [bytes, message] : cases) EXPECT_EQ(error_of(bytes), message);
}

TEST(Merl, WrongPaths) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / fmt::format("nacre_merl_{}", getpid());
    std::filesystem::create_directories(folder);
    const auto message = [](const std::filesystem::path& path) {
        try {
            read_merl(path);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(message(folder / "none.binary"),
              (folder / "none.binary").string() + ": cannot be read; check the name");
    EXPECT_EQ(message(folder), folder.string() + ": cannot be read; check the name");
    const std::filesystem::path text = folder / "text.binary";
    std::ofstream(text) << "not a BRDF";
    EXPECT_EQ(message(text), text.string() +
                                 ": has 10 bytes, too few for a header; it is incomplete: fetch it "
                                 "again");
    std::filesystem::remove_all(folder);
}

// A slice of the real measurement of pink felt (theta_d = 0, theta_h to 84 degrees, from ALTA)
// against a file that a network trained on the measurement produced: both know the same felt, whose
// values double towards grazing angles.
TEST(Merl, FeltAgreesWithItsMeasuredSlice) {
    const std::filesystem::path folder = std::filesystem::path(NACRE_SHARED_DIR) / "data/brdf/merl";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no reference data at " << folder;
    const MerlBrdf felt = read_merl(folder / "pink-felt.nbrdf.binary");
    EXPECT_NEAR(double(felt.missing()) / count, 0.248, 0.001);  // as the data's list says
    std::ifstream slice(folder / "pink-felt-1d.alta");
    std::string line;
    int compared = 0;
    double worst = 0., sum = 0.;
    while (std::getline(slice, line)) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        double cosine, rgb[3];
        ASSERT_TRUE(words >> cosine >> rgb[0] >> rgb[1] >> rgb[2]) << line;
        const Vec3d w{std::sqrt(1. - cosine * cosine), 0., cosine};
        const auto found = felt.eval(w, w);
        ASSERT_TRUE(found) << line;
        for (int c = 0; c < 3; ++c) {
            const double off = std::abs((*found)[c] - rgb[c]) / rgb[c];
            worst = std::max(worst, off);
            sum += off;
        }
        ++compared;
    }
    EXPECT_EQ(compared, 90);
    // What the network lost of it: grazing values are twice those at the normal, far outside.
    EXPECT_LT(sum / (3. * compared), 0.05);
    EXPECT_LT(worst, 0.2);
}

}  // namespace nacre
