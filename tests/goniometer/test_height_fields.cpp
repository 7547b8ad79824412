// Fractal heights against their spectrum, and pictures against the surfaces that they show.
#include <complex>
#include <filesystem>

#include "nacre/goniometer/measurement.h"
#include "nacre/goniometer/patch_material.h"
#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/math/statistics.h"
#include "tests/support/error_of.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for pictures, removed at the end.
class HeightFields : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / fmt::format("nacre_heights_{}", getpid());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    template <class F>
    std::string picture(const char* name, int width, int height, F&& value) const {
        Image image(width, height, {"Y"});
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) image.at(x, y, 0) = float(value(x, y));
        const fs::path file = folder_ / name;
        write_image(image, file);
        return file.string();
    }
    fs::path folder_;
};

/// Heights of the grid points of a tile of n x n.
std::vector<double> grid_heights(const Microgeometry& g, int n) {
    std::vector<double> heights(std::size_t(n) * n, 1e9);
    for (const Point3f& p : g.mesh.positions) {
        const int i = int(std::lround(p.x / g.width * n)), j = int(std::lround(p.y / g.height * n));
        if (i >= 0 && i < n && j >= 0 && j < n) heights[std::size_t(j) * n + i] = p.z;
    }
    return heights;
}

/// Power of the wave (a, b) in n x n heights.
double power(const std::vector<double>& heights, int n, int a, int b) {
    std::complex<double> sum = 0.;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            sum += heights[std::size_t(j) * n + i] *
                   std::polar(1., 2. * std::numbers::pi * ((a * i + b * j) % n) / n);
    return std::norm(sum / double(n * n));
}

IncidenceMeasurement measured_at(const Microgeometry& g, std::uint64_t seed) {
    const Patch patch = make_patch(g, surface_bsdf("mirror", Wavelengths::rgb_bands()));
    MeasureOptions options{.bins = {30, 8}, .orders = 1, .seed = seed};
    options.least_rays = options.most_rays = 100'000;
    constexpr double degree = std::numbers::pi / 180.;
    IncidenceMeasurement m(DirectionCell::at(25. * degree, 80. * degree), options.bins);
    measure(patch, options, m);
    return m;
}

}  // namespace

// Slopes as asked for; of the waves the power falls as k^-2(H+1), and there are none beyond the ends.
// 24 surfaces and some 20 waves a ring: powers are exponentially distributed, so 1/sqrt(480) = 5 %.
TEST_F(HeightFields, FractalsHaveTheirSlopeAndSpectrum) {
    constexpr int n = 64, surfaces = 24;
    constexpr double alpha = 0.35;
    for (const double hurst : {0.3, 0.9}) {
        double inner = 0., outer = 0., of_inner = 0., of_outer = 0.;
        for (int seed = 0; seed < surfaces; ++seed) {
            const auto g = make_microgeometry(
                fmt::format("fractal alpha={} hurst={} longest=3 shortest=10 points={} seed={}",
                            alpha, hurst, n, seed));
            EXPECT_EQ(g.width, 10.);
            const std::vector<double> h = grid_heights(g, n);
            double slopes = 0.;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const double here = h[std::size_t(j) * n + i];
                    const double x = h[std::size_t(j) * n + (i + 1) % n] - here,
                                 y = h[std::size_t((j + 1) % n) * n + i] - here;
                    slopes += x * x + y * y;
                }
            const double step = g.width / n;
            EXPECT_NEAR(slopes / (n * n * step * step), alpha * alpha, 1e-5);
            double whole = 0.;
            for (double x : h) whole += x * x / (n * n);
            for (const auto& [a, b] : {std::pair(0, 2), {2, 2}, {8, 7}, {11, 0}, {0, 20}})
                EXPECT_LT(power(h, n, a, b), 1e-12 * whole) << a << " " << b;
            for (int a = 0; a <= 10; ++a)
                for (int b = -10; b <= 10; ++b) {
                    const double k = std::hypot(a, b), law = std::pow(k, -2. * (hurst + 1.));
                    if (k >= 3. && k < 4.)
                        inner += power(h, n, a, b), of_inner += law;
                    else if (k >= 9.5 && k <= 10.)
                        outer += power(h, n, a, b), of_outer += law;
                }
        }
        EXPECT_NEAR(outer / inner, of_outer / of_inner, 0.3 * of_outer / of_inner) << hurst;
    }
}

TEST_F(HeightFields, APictureOfVGroovesIsVGrooves) {
    // Sixteen pixels from ridge to ridge; the corners lie on pixels.
    const std::string file =
        picture("grooves.exr", 16, 16, [](int, int y) { return std::abs(15 - y - 8) / 8.; });
    const double height = 0.5 * std::tan(std::numbers::pi / 6.);
    const auto seen = measured_at(
        make_microgeometry(fmt::format("height_field file={} height={}", file, height)), 1);
    const auto made = measured_at(make_microgeometry("v_grooves angle=30"), 2);
    double statistic = 0.;
    int cells = 0;
    for (std::size_t i = 0; i < seen.bins.size(); ++i) {
        const MeasuredValue a = seen.brdf(i, 0), b = made.brdf(i, 0);
        EXPECT_EQ(a.value > 0., b.value > 0.) << i;
        if (!(a.value > 0.)) continue;
        const double z = (a.value - b.value) / std::hypot(a.error, b.error);
        statistic += z * z;
        ++cells;
    }
    EXPECT_GE(cells, 2);
    EXPECT_GT(chi_square_probability(statistic, cells), 1e-4);
    EXPECT_NEAR(seen.blocked(0).value, made.blocked(0).value,
                4. * std::hypot(seen.blocked(0).error, made.blocked(0).error) + 1e-9);
}

TEST_F(HeightFields, PixelsAreHeightsWithTheTopTowardsY) {
    const std::string file =
        picture("steps.pfm", 4, 2, [](int x, int y) { return x == 1 && y == 0 ? 2. : 0.25 * x; });
    const auto g = make_microgeometry(fmt::format("height_field file={} height=3 width=2", file));
    EXPECT_EQ(g.width, 2.);
    EXPECT_EQ(g.height, 1.);
    const auto height_at = [&](const Microgeometry& m, double x, double y) {
        for (const Point3f& p : m.mesh.positions)
            if (std::abs(p.x - x) < 1e-6 && std::abs(p.y - y) < 1e-6) return double(p.z);
        return 1e9;
    };
    EXPECT_EQ(height_at(g, 0.5, 0.5), 6.);   // the upper row
    EXPECT_EQ(height_at(g, 0.5, 0.), 0.75);  // the lower
    EXPECT_EQ(height_at(g, 1.5, 0.), 2.25);
    EXPECT_EQ(height_at(g, 2., 0.), 0.);  // the next picture
    const auto m =
        make_microgeometry(fmt::format("height_field edges=mirror file={} height=3 width=2", file));
    EXPECT_EQ(m.width, 4.);
    EXPECT_EQ(m.height, 2.);
    EXPECT_EQ(height_at(m, 2., 0.), 2.25);  // the last column again
    EXPECT_EQ(height_at(m, 3., 1.), 6.);    // both mirrored
}

TEST_F(HeightFields, EightBitsAreNotTakenForColours) {
    const std::string file = picture("half.png", 4, 4, [](int, int) { return 0.5; });
    // 188 of 255 is what half becomes by the curve of sRGB.
    const auto g = make_microgeometry(fmt::format("height_field file={} height=255", file));
    EXPECT_NEAR(g.mesh.positions[0].z, 187.5, 1.2);
}

TEST_F(HeightFields, WhiteSurfacesLoseNothing) {
    const std::string file =
        picture("waves.exr", 16, 16, [](int x, int y) { return std::sin(x * 0.4) * (y % 5); });
    for (const std::string& text : {std::string("fractal alpha=0.8 points=64 shortest=8"),
                                    "height_field edges=mirror height=0.1 file=" + file}) {
        const Patch patch =
            make_patch(make_microgeometry(text),
                       surface_bsdf("lambert reflectance=1", Wavelengths::rgb_bands()));
        MeasureOptions options{.bins = {6, 6}};
        options.least_rays = options.most_rays = 8192;
        IncidenceMeasurement m(DirectionCell::at(1., 0.5), options.bins);
        measure(patch, options, m);
        EXPECT_NEAR(m.reflected(0).value, 1., 1e-3) << text;
        EXPECT_EQ(m.transmitted(0).value, 0.) << text;
    }
}

TEST_F(HeightFields, SayWhatIsWrong) {
    Image coloured(2, 2);
    coloured.at(1, 1, 1) = 0.5f;
    const std::string colour = (folder_ / "colour.exr").string();
    write_image(coloured, colour);
    const std::string odd =
        picture("odd.exr", 3, 2, [](int x, int y) { return x == 2 && y == 1 ? NAN : 0.; });
    const std::string thin = picture("thin.exr", 1, 5, [](int, int) { return 0.; });
    const std::string good = picture("good.exr", 2, 2, [](int, int) { return 0.; });
    const std::string none = (folder_ / "none.exr").string();
    const std::pair<std::string, std::string> wrong[] = {
        {"height_field height=1", "height_field: which one? file=NAME is missing"},
        {"height_field file=", "height_field: which one? file=NAME is missing"},
        {"height_field file=a.exr file=b.exr", "height_field: file is given twice"},
        {"height_field file=" + good + " heigth=2",
         "height_field: unknown parameter 'heigth'; did you mean 'height'?"},
        {"height_field file=" + good + " width=0",
         "height_field: width = 0 is out of range: must lie within (0, 1000000000]"},
        {"height_field file=" + colour,
         colour + ": pixel 1, 1 is coloured (0, 0.5, 0): heights are grey; convert the picture"},
        {"height_field file=" + odd, odd + ": pixel 2, 1 is no number"},
        {"height_field file=" + thin,
         thin + ": heights at 1 by 5 points: at least 2 by 2 and at most 10^8 are possible"},
        {"height_field file=" + none, none + ": "},
        {"flat file=" + good, "flat: it has no parameter 'file'"},
        {"fractal points=100",
         "fractal: 100 points do not resolve waves of which 64 are a period: at least 256, or a "
         "smaller 'shortest'"},
        {"fractal longest=9 shortest=8",
         "fractal: the longest waves, 9 of a period, must not be shorter than the shortest, 8"},
        {"fractal hurst=0", "fractal: hurst = 0 is out of range: must lie within (0, 1]"},
    };
    for (const auto& [text, expected] : wrong) {
        const std::string message = test::error_of([&, &t = text] { (void)make_microgeometry(t); });
        EXPECT_EQ(message.substr(0, expected.size()), expected) << text;
    }
}

}  // namespace nacre
