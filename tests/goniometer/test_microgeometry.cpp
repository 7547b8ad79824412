// Generated microgeometry: statistics of random heights, open and covered area, periods that fit.
#include "nacre/goniometer/measurement.h"
#include "nacre/goniometer/patch_material.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

/// Heights of the grid points of the tile, row after row; points lie on the grid.
std::vector<double> heights_of(const Microgeometry& g, int columns, int rows) {
    std::vector<double> heights(std::size_t(columns) * rows, 1e9);
    for (const Point3f& p : g.mesh.positions) {
        const int i = int(std::lround(p.x / g.width * columns)),
                  j = int(std::lround(p.y / g.height * rows));
        if (i >= 0 && i < columns && j >= 0 && j < rows)
            heights[std::size_t(j) * columns + i] = p.z;
    }
    return heights;
}

}  // namespace

TEST(Microgeometry, GaussianHeightsHaveTheirCorrelationAndSlope) {
    constexpr int n = 96, periods = 24;
    constexpr double lengths = 12., alpha = 0.4;
    constexpr int one = n / int(lengths);  // a correlation length in steps
    double variance = 0., correlated = 0., fourth = 0.;
    for (int seed = 0; seed < periods; ++seed) {
        const auto g = make_microgeometry(
            fmt::format("gaussian alpha={} lengths={} points={} seed={}", alpha, lengths, n, seed));
        EXPECT_EQ(g.width, lengths);
        const std::vector<double> h = heights_of(g, n, n);
        double slopes = 0.;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double here = h[std::size_t(j) * n + i];
                const double beside = h[std::size_t(j) * n + (i + 1) % n],
                             below = h[std::size_t((j + 1) % n) * n + i];
                variance += here * here;
                fourth += here * here * here * here;
                correlated +=
                    0.5 * here *
                    (h[std::size_t(j) * n + (i + one) % n] + h[std::size_t((j + one) % n) * n + i]);
                slopes += (beside - here) * (beside - here) + (below - here) * (below - here);
            }
        const double step = lengths / n;
        // Of all slopes the mean square is alpha^2/2 along either axis.
        EXPECT_NEAR(slopes / (n * n * step * step), alpha * alpha, 1e-5) << seed;
    }
    const double count = double(n) * n * periods;
    // Some 24 times 12^2 independent heights: 1/sqrt(3456) is 0.017.
    EXPECT_NEAR(correlated / variance, std::exp(-1.), 0.05);
    EXPECT_NEAR(fourth / count / (variance / count * variance / count), 3., 0.25);
    // Slopes of a surface with this correlation: their variance is 2 variance / length^2.
    EXPECT_NEAR(std::sqrt(2. * 2. * variance / count), alpha, 0.05 * alpha);
}

TEST(Microgeometry, BrushedProfilesHaveTheirs) {
    constexpr int n = 8000;
    constexpr double lengths = 1000., alpha = 0.25;
    const auto g =
        make_microgeometry(fmt::format("brushed alpha={} lengths={} points={}", alpha, lengths, n));
    const std::vector<double> h = heights_of(g, 1, n);
    double variance = 0., correlated = 0., slopes = 0.;
    for (int i = 0; i < n; ++i) {
        const double next = h[(i + 1) % n] - h[i];
        variance += h[i] * h[i];
        correlated += h[i] * h[(i + 8) % n];
        slopes += next * next;
    }
    EXPECT_NEAR(correlated / variance, std::exp(-1.), 0.08);
    EXPECT_NEAR(2. * slopes / n * 64., alpha * alpha, 1e-4);
}

// Between black threads the light that falls straight on passes where there are none.
TEST(Microgeometry, ClothIsOpenBetweenItsThreads) {
    const Patch patch = make_patch(make_microgeometry("weave warp=0.6 weft=0.3"),
                                   surface_bsdf("lambert reflectance=0", Wavelengths::rgb_bands()));
    MeasureOptions options{.bins = {2, 2}};
    options.least_rays = options.most_rays = 200'000;
    IncidenceMeasurement m(DirectionCell::at(0., 0.), options.bins);
    measure(patch, options, m);
    EXPECT_NEAR(m.transmitted(0).value, 0.4 * 0.7, 4. * m.transmitted(0).error);
    EXPECT_EQ(m.reflected(0).value, 0.);
}

TEST(Microgeometry, FibresStandAsDenseAndAsHighAsAsked) {
    const auto g = make_microgeometry(
        "fibres fibres=9 spacing=10 length=25 spread=0 lean=30 uneven=0 sides=7");
    EXPECT_EQ(g.width, 90.);
    // Upper ends: the last vertex of each fibre's 15, in the tile 81 feet.
    int feet = 0;
    for (std::size_t first = 0; first + 15 < g.mesh.positions.size(); first += 15) {
        const Vec3d tip(g.mesh.positions[first + 14]);
        const Vec3d foot = tip - normalize(Vec3d{std::tan(std::numbers::pi / 6.), 0., 1.}) * 25.;
        EXPECT_NEAR(foot.z, 0., 1e-4);
        // Feet are set a little below the floor, along the lean.
        const double x = foot.x - std::tan(std::numbers::pi / 6.);
        if (x >= 0. && x < 90. && foot.y >= 0. && foot.y < 90.) ++feet;
    }
    EXPECT_EQ(feet, 81);
}

// Who looks down into velvet sees little light; who looks along it sees the sides of its fibres. By
// reciprocity the share that is reflected is how bright it is in even light.
TEST(Microgeometry, VelvetIsBrightAtItsRim) {
    const Patch patch =
        make_patch(make_microgeometry("fibres spacing=10 length=150 spread=20 fibres=12 sides=8"),
                   surface_bsdf("blinn_phong kd=0.05 ks=0.3 n=10", Wavelengths::rgb_bands()));
    double share[2];
    int i = 0;
    for (const double theta : {30., 85.}) {
        MeasureOptions options{.bins = {2, 2}, .turned = true};
        options.least_rays = options.most_rays = 8192;
        IncidenceMeasurement m(DirectionCell::at(theta * std::numbers::pi / 180., 0.),
                               options.bins);
        measure(patch, options, m);
        share[i++] = m.reflected(0).value;
    }
    EXPECT_GT(share[1], 2.5 * share[0]);
}

TEST(Microgeometry, SaysWhatIsWrong) {
    const std::pair<const char*, const char*> wrong[] = {
        {"gausian", "unknown microgeometry 'gausian'; did you mean 'gaussian'?"},
        {"cylinders depth=2", "cylinders: depth = 2 is out of range: must lie within [0, 1]"},
        {"brushed points=100",
         "brushed: 100 points do not resolve 200 correlation lengths: at least 800, or fewer "
         "lengths"},
        {"weave warp=0", "weave: warp = 0 is out of range: must lie within (0, 1]"},
        {"flat seed=1", "flat: it has no parameter 'seed'"},
    };
    for (const auto& [text, expected] : wrong) try {
            make_microgeometry(text);
            ADD_FAILURE() << text;
        } catch (const InputError& e) {
            EXPECT_EQ(std::string(e.what()).substr(0, std::string_view(expected).size()), expected);
        }
}

}  // namespace nacre
