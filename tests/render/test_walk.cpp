// The random walk by itself, in bodies whose surface is known in closed form.
#include "nacre/render/walk.h"

#include <gtest/gtest.h>

#include <limits>

#include "nacre/math/sampling.h"
#include "tests/support/constants.h"
#include "tests/support/statistics.h"

namespace nacre {
namespace {

struct Place {
    float clearance = 0.f;
    bool outside = false;
};

/// No surface anywhere.
struct Nowhere {
    Place locate(const Point3f&) const { return {}; }
    bool surface(const Point3f&, const Vec3f&, float, float&) const { return false; }
    void collided(const Walker&, const Place&) {}
};

/// A ball of radius 1 about the origin. Its clearance may be given away, which must change nothing.
struct Ball {
    bool knows_clearance = true;
    int asked = 0;

    Place locate(const Point3f& p) const {
        return {knows_clearance ? std::max(0.f, 0.999f - length(p)) : 0.f, false};
    }
    bool surface(const Point3f& p, const Vec3f& d, float s, float& t) {
        ++asked;
        const float b = dot(p, d), c = dot(p, p) - 1.f;
        t = -b + std::sqrt(std::max(0.f, b * b - c));
        return t < s;
    }
    void collided(const Walker&, const Place&) {}
};

/// The slab between the planes z = 0 and z = depth.
struct WalkedSlab {
    float depth;
    Place locate(const Point3f& p) const {
        return {0.999f * std::max(0.f, std::min(p.z, depth - p.z)), false};
    }
    bool surface(const Point3f& p, const Vec3f& d, float s, float& t) const {
        t = d.z > 0.f   ? (depth - p.z) / d.z
            : d.z < 0.f ? -p.z / d.z
                        : std::numeric_limits<float>::infinity();
        return t < s;
    }
    void collided(const Walker&, const Place&) {}
};

constexpr std::uint32_t unlimited = 1u << 30;

const PhaseFunction phases[] = {PhaseFunction::isotropic(), PhaseFunction::henyey_greenstein(0.8f),
                                PhaseFunction::mie_murky()};

/// Mean of samples with its standard error.
struct Mean {
    double n = 0, sum = 0, sum2 = 0;
    void add(double v) { ++n, sum += v, sum2 += v * v; }
    double mean() const { return sum / n; }
    double error() const { return std::sqrt((sum2 / n - mean() * mean()) / (n - 1)); }
    void expect(double truth, const char* what) const {
        EXPECT_NEAR(mean(), truth, 4 * error()) << what;
        EXPECT_LT(error(), 0.01 * std::max(1e-3, truth)) << what << ": too noisy to tell";
    }
};

TEST(Walk, FreePathsAreExponential) {
    const float sigma = 2.5f;
    constexpr int cells = 60, n = 200000;
    std::vector<double> observed(cells), expected(cells);
    for (int i = 0; i < n; ++i) {
        Walker w{{}, {0, 0, 1}, {0, 0, 1}, Random(stream_key(7, std::uint64_t(i)))};
        Nowhere nowhere;
        ASSERT_EQ(walk(w, sigma, phases[0], 1, nowhere), WalkEnd::paused);
        ASSERT_EQ(w.collisions, 1u);
        EXPECT_EQ(w.length, w.p.z);
        ++observed[std::min(cells - 1, int(w.length * 20))];
    }
    for (int c = 0; c < cells; ++c)
        expected[c] = n * (std::exp(-sigma * c / 20.) -
                           (c + 1 < cells ? std::exp(-sigma * (c + 1) / 20.) : 0));
    EXPECT_TRUE(test::chi_square_passes(observed, expected));
}

// After n free paths of mean 1 along directions that keep the share g of the one before, the walk
// is on average (1 - g^n) / (1 - g) ahead, and the squared distance is
// 2 (n - (1 - g^n) g / (1 - g)) / (1 - g)... summed here term by term: free paths have E[s^2] = 2,
// and E[d_i . d_j] = g^|i-j|.
TEST(Walk, GoesAsFarAsItsPhaseFunctionSays) {
    const float sigma = 3.f;
    for (const PhaseFunction& phase : phases) {
        const double g = phase.mean_cosine();
        constexpr int steps = 12;
        double ahead = 0, squared = 0;
        for (int i = 0; i < steps; ++i) {
            ahead += std::pow(g, i) / sigma;
            squared += 2 / (sigma * sigma);
            for (int j = 0; j < i; ++j) squared += 2 * std::pow(g, i - j) / (sigma * sigma);
        }
        Mean z, r2, length_of_path;
        for (int i = 0; i < 150000; ++i) {
            Walker w{{}, {0, 0, 1}, {0, 0, 1}, Random(stream_key(8, std::uint64_t(i)))};
            Nowhere nowhere;
            walk(w, sigma, phase, steps, nowhere);
            z.add(w.p.z);
            r2.add(length_squared(w.p - Point3f(0, 0, 0)));
            length_of_path.add(w.length);
        }
        z.expect(ahead, "ahead");
        r2.expect(squared, "squared distance");
        length_of_path.expect(steps / sigma, "length");
    }
}

// Light that enters a body evenly and isotropically spends there the mean path length 4 V / S,
// whatever the scattering (Blanco and Fournier 2003, An invariance property of diffusive random
// walks, Europhysics Letters 61; Mazzolo 2004). For the unit ball 4/3, and so sigma 4/3 collisions.
TEST(Walk, MeanPathLengthOfABallDoesNotDependOnScattering) {
    for (const PhaseFunction& phase : phases)
        for (const float sigma : {0.1f, 1.f, 5.f, 25.f}) {
            Mean path, collisions;
            for (int i = 0; i < 60000; ++i) {
                Walker w{{0, 0, -1}, {}, {}, Random(stream_key(9, std::uint64_t(i)))};
                const Vec2f u = w.random.next2();
                const float s = std::sqrt(u.x), phi = float(2 * pi) * u.y;
                w.d = w.d_in = {s * std::cos(phi), s * std::sin(phi), std::sqrt(1.f - u.x)};
                w.p = Point3f(0, 0, -1) + w.d * 1e-5f;
                Ball ball;
                ASSERT_EQ(walk(w, sigma, phase, unlimited, ball), WalkEnd::surface);
                path.add(w.length + w.free_path);
                collisions.add(w.collisions);
            }
            EXPECT_NEAR(path.mean(), 4. / 3, 4 * path.error() + 2e-5)
                << phase.name() << ' ' << sigma;
            EXPECT_NEAR(collisions.mean(), sigma * 4. / 3, 4 * collisions.error() + 1e-3)
                << phase.name() << ' ' << sigma;
            EXPECT_LT(path.error(), 0.04);
        }
}

// The same for a slab of depth h: 4 V / S = 2 h.
TEST(Walk, MeanPathLengthOfASlab) {
    for (const PhaseFunction& phase : phases) {
        Mean path, passed;
        const float sigma = 2.f, depth = 1.5f;
        for (int i = 0; i < 100000; ++i) {
            Walker w{{}, {}, {}, Random(stream_key(10, std::uint64_t(i)))};
            const Vec2f u = w.random.next2();
            const float s = std::sqrt(u.x), phi = float(2 * pi) * u.y;
            w.d = w.d_in = {s * std::cos(phi), s * std::sin(phi), std::sqrt(1.f - u.x)};
            WalkedSlab slab{depth};
            ASSERT_EQ(walk(w, sigma, phase, unlimited, slab), WalkEnd::surface);
            path.add(w.length + w.free_path);
            if (w.collisions == 0 && w.d.z > 0)
                passed.add(1);
            else
                passed.add(0);
        }
        // A few nearly level paths are very long: their share of the mean is in the error.
        EXPECT_NEAR(path.mean(), 2 * depth, 4 * path.error()) << phase.name();
        EXPECT_LT(path.error(), 0.02);
        // Unscattered share of diffuse light: 2 E3(tau), here by the trapezoidal rule in mu.
        double e3 = 0;
        for (int k = 0; k < 20000; ++k) {
            const double mu = (k + 0.5) / 20000;
            e3 += 2 * mu * std::exp(-sigma * depth / mu) / 20000;
        }
        EXPECT_NEAR(passed.mean(), e3, 4 * passed.error());
    }
}

TEST(Walk, IsTheSameWithAndWithoutClearance) {
    int with = 0, without = 0;
    for (int i = 0; i < 1000; ++i) {
        Walker a{{}, {0, 0, 1}, {0, 0, 1}, Random(stream_key(11, std::uint64_t(i)))};
        Walker b = a;
        Ball knows{true}, asks{false};
        walk(a, 20.f, phases[1], unlimited, knows);
        walk(b, 20.f, phases[1], unlimited, asks);
        ASSERT_EQ(a.p, b.p);
        ASSERT_EQ(a.d, b.d);
        ASSERT_EQ(a.collisions, b.collisions);
        ASSERT_EQ(a.free_path, b.free_path);
        with += knows.asked;
        without += asks.asked;
    }
    EXPECT_LT(3 * with, without);
}

TEST(Walk, StopsWhereItIsTold) {
    struct Leaky : Ball {
        Place locate(const Point3f& p) const { return {0.f, length(p) > 0.5f}; }
    };
    Walker w{{}, {0, 0, 1}, {0, 0, 1}, Random(3)};
    Leaky leaky;
    EXPECT_EQ(walk(w, 30.f, phases[0], unlimited, leaky), WalkEnd::lost);
    EXPECT_GT(length(w.p), 0.5f);

    // Paused: the direction of the next free path is not drawn yet.
    Walker v{{}, {0, 0, 1}, {0, 0, 1}, Random(3)};
    Nowhere nowhere;
    EXPECT_EQ(walk(v, 30.f, phases[0], 1, nowhere), WalkEnd::paused);
    EXPECT_EQ(v.d, Vec3f(0, 0, 1));
    EXPECT_EQ(v.collisions, 1u);
}

}  // namespace
}  // namespace nacre
