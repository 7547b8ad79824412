#include "nacre/metrics/flip.h"

#include <gtest/gtest.h>

#include "nacre/metrics/flip_color.h"
#include "nacre/metrics/flip_filters.h"
#include "tests/metrics/pictures_fixture.h"

namespace nacre {
namespace {

using namespace flip_steps;
using test::constant;
using test::error_of;
using test::waves;
using test::with_noise;

/// LDR-FLIP of two even pictures by the formulas: no filter changes them and they have no features.
double error_of_even(Vec3f a, Vec3f b) {
    return double(redistribute(std::pow(hyab(hunt_lab(a), hunt_lab(b)), 0.7f)));
}

Image tone_mapped(Image image, double exposure) {
    for (float& v : image.data) v = flip_tone_map(v, exposure);
    return image;
}

/// A red square with a white dot, its corner at (x, y), on grey.
Image square_at(int x0, int y0) {
    Image r = constant(96, 80, {0.3f, 0.3f, 0.3f});
    for (int y = y0; y < y0 + 6; ++y)
        for (int x = x0; x < x0 + 9; ++x)
            for (int c = 0; c < 3; ++c) r.at(x, y, c) = c == 0 ? 0.8f : 0.1f;
    for (int c = 0; c < 3; ++c) r.at(x0 + 4, y0 + 2, c) = 1.f;
    return r;
}

}  // namespace

TEST(Flip, EqualPicturesAreNotDifferent) {
    const Image a = waves(60, 50);
    const FlipResult r = flip(a, a);
    EXPECT_EQ(r.mean, 0.);
    EXPECT_EQ(r.map.channels, std::vector<std::string>{"Y"});
    EXPECT_EQ(*std::max_element(r.map.data.begin(), r.map.data.end()), 0.f);
    EXPECT_EQ(flip_hdr(a, a).mean, 0.);
    Image b = a;
    b.at(30, 25, 1) += 0.01f;
    EXPECT_GT(flip(a, b).mean, 0.);
    EXPECT_GT(flip_hdr(a, b).mean, 0.);
}

TEST(Flip, EvenPicturesDifferByTheirColours) {
    // Black and white: L* differs by 100; 100^0.7 = 25.1189, c_max = 41.276, and 0.95 + 0.05
    // (25.1189 - 0.4 c_max) / (0.6 c_max) = 0.96738.
    const Image black = constant(30, 20, {}), white = constant(30, 20, {1.f, 1.f, 1.f});
    EXPECT_NEAR(flip(white, black).mean, 0.96738, 2e-5);
    const Vec3f green{0.f, 1.f, 0.f}, blue{0.f, 0.f, 1.f}, dull{0.2f, 0.3f, 0.25f};
    EXPECT_NEAR(flip(constant(30, 20, green), constant(30, 20, blue)).mean, 1., 1e-4);
    EXPECT_NEAR(flip(constant(30, 20, dull), constant(30, 20, blue)).mean,
                error_of_even(dull, blue), 1e-4);
    // What is brighter than the screen's white is white.
    EXPECT_NEAR(flip(constant(30, 20, {7.f, 7.f, 7.f}), white).mean, 0., 1e-6);
}

TEST(Flip, IsSymmetricAndWithinBounds) {
    const Image a = with_noise(waves(70, 60), 0.3, 1), b = with_noise(waves(70, 60), 0.3, 2);
    const FlipResult ab = flip(a, b), ba = flip(b, a);
    EXPECT_EQ(ab.map.data, ba.map.data);
    EXPECT_EQ(ab.mean, ba.mean);
    for (const float v : ab.map.data) {
        EXPECT_GT(v, 0.f);
        EXPECT_LE(v, 1.f);
    }
}

TEST(Flip, MovesWithThePictures) {
    const Image grey = constant(96, 80, {0.3f, 0.3f, 0.3f});
    const FlipResult r = flip(square_at(40, 36), grey), moved = flip(square_at(47, 31), grey);
    EXPECT_NEAR(r.mean, moved.mean, 1e-9);
    int seen = 0;
    for (int y = 10; y < 70; ++y)
        for (int x = 10; x < 80; ++x) {
            EXPECT_EQ(r.map.at(x, y, 0), moved.map.at(x + 7, y - 5, 0));
            seen += r.map.at(x, y, 0) > 0.1f;
        }
    EXPECT_GT(seen, 54);  // more than the square: the eye blurs it
}

TEST(Flip, TurnsWithThePictures) {
    // Both detectors look along both axes: transposed pictures have a transposed error.
    const Image a = with_noise(waves(40, 56), 0.2, 5), b = waves(40, 56);
    const auto transposed = [](const Image& image) {
        Image r(image.height, image.width, image.channels);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < image.channel_count(); ++c) r.at(y, x, c) = image.at(x, y, c);
        return r;
    };
    const Image map = transposed(flip(transposed(a), transposed(b)).map), direct = flip(a, b).map;
    for (std::size_t i = 0; i < map.data.size(); ++i)
        EXPECT_NEAR(map.data[i], direct.data[i], 2e-3f);  // small errors have a steep power
}

TEST(Flip, GrowsWithTheDifference) {
    const Image grey = constant(48, 48, {0.3f, 0.3f, 0.3f});
    double even = 0., dot = 0.;
    for (const float d : {0.02f, 0.05f, 0.1f, 0.2f, 0.4f, 0.7f}) {
        const double e = flip(constant(48, 48, {0.3f + d, 0.3f + d, 0.3f + d}), grey).mean;
        Image dotted = grey;
        for (int c = 0; c < 3; ++c) dotted.at(24, 24, c) += d;
        const double f = flip(dotted, grey).mean;
        EXPECT_GT(e, even) << d;
        EXPECT_GT(f, dot) << d;
        even = e, dot = f;
    }
    EXPECT_LT(dot, 0.1 * even);
}

TEST(Flip, FeaturesAddToTheColourError) {
    // A vertical edge in one picture only, 2 sigma of the detector from pixels of equal colour:
    // beside the edge the error exceeds that of the colours, C^(1 - F) with F from the taps.
    Image step = constant(120, 5, {});
    for (int y = 0; y < 5; ++y)
        for (int x = 60; x < 120; ++x)
            for (int c = 0; c < 3; ++c) step.at(x, y, c) = 1.f;
    const FlipResult r = flip(step, constant(120, 5, {}));
    // White against black, far from the edge.
    EXPECT_NEAR(r.map.at(100, 2, 0), 0.96738f, 2e-5f);
    // Beside the edge |edge| = 1 and F = 1 / 2^(1/4); C is the error of the blurred step: the
    // achromatic channel there is 1/2 + taps[10] / 2 of white on the white side.
    const auto a = contrast_sensitivity(Opponent::achromatic, flip_pixels_per_degree);
    const float y = 0.5f + 0.5f * a[0].taps[10];
    const double color = error_of_even({y, y, y}, {});
    EXPECT_NEAR(r.map.at(60, 2, 0), std::pow(color, 1. - std::pow(2., -0.25)), 1e-4);
}

TEST(Flip, FilteredColoursStayOnTheScreen) {
    // The dark side of an edge from black to blue: chroma is blurred more than luminance, which
    // gives a colour that no screen shows, and it is clamped.
    constexpr Vec3f blue{0.f, 0.f, 1.f};
    Image step = constant(120, 5, {});
    for (int y = 0; y < 5; ++y)
        for (int x = 60; x < 120; ++x) step.at(x, y, 2) = 1.f;
    const float error = flip(step, constant(120, 5, {})).map.at(59, 2, 0);

    Vec3f mixed;
    const Opponent channels[] = {Opponent::achromatic, Opponent::red_green, Opponent::blue_yellow};
    for (std::size_t c = 0; c < 3; ++c) {
        float part = 0.f;  // of the light that comes from the blue side
        for (const SpatialFilter& f : contrast_sensitivity(channels[c], flip_pixels_per_degree))
            part += f.weight * (0.5f - 0.5f * f.taps[10]);
        mixed[c] = (1.f - part) * to_ycxcz({})[c] + part * to_ycxcz(blue)[c];
    }
    Vec3f rgb = from_ycxcz(mixed);
    EXPECT_LT(std::min({rgb.x, rgb.y, rgb.z}), -0.001f);
    const double unclamped = error_of_even(rgb, {});
    for (int c = 0; c < 3; ++c) rgb[c] = std::clamp(rgb[c], 0.f, 1.f);
    // |edge| is the luminance of blue, (to_ycxcz(blue).x + 16) / 116.
    const double feature = std::sqrt((double(to_ycxcz(blue).x) + 16.) / 116. / std::sqrt(2.));
    const double expected = std::pow(error_of_even(rgb, {}), 1. - feature);
    EXPECT_NEAR(error, expected, 1e-4);
    EXPECT_GT(std::abs(std::pow(unclamped, 1. - feature) - expected), 1e-3);
}

TEST(Flip, FarAwayFinePatternsVanish) {
    // A checkerboard of single pixels against its mean, at its centre, which the border's stripes
    // do not reach: at 150 pixels a degree the eye's filter passes exp(-pi^2 sigma^2 / 2) of a
    // frequency of 1/2 on each axis, sigma = 150 sqrt(0.0047 / 2) / pi = 2.3, which is nothing.
    Image board = constant(64, 64, {});
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) board.at(x, y, c) = (x + y) % 2 ? 1.f : 0.f;
    const Image mean = constant(64, 64, {0.5f, 0.5f, 0.5f});
    EXPECT_GT(flip(board, mean, {}, 20.).map.at(32, 32, 0), 0.1f);
    EXPECT_LT(flip(board, mean, {}, 150.).map.at(32, 32, 0), 1e-3f);
}

TEST(FlipHdr, TheToneMapperByHand) {
    // x = 0.6: 0.6 (2.51 * 0.6 + 0.03) / (0.6 (2.43 * 0.6 + 0.59) + 0.14) = 0.9216 / 1.3688.
    EXPECT_NEAR(flip_tone_map(1.f, 0.), 0.673291f, 1e-6f);
    EXPECT_NEAR(flip_tone_map(0.25f, 2.), 0.673291f, 1e-6f);
    EXPECT_EQ(flip_tone_map(0.f, 5.), 0.f);
    EXPECT_EQ(flip_tone_map(-1.f, 0.), 0.f);
    EXPECT_EQ(flip_tone_map(1e30f, 100.), 1.f);
}

TEST(FlipHdr, ExposuresPutMaximumAndMedianBelowWhite) {
    Image t = constant(5, 1, {0.1f, 0.1f, 0.1f});
    for (int c = 0; c < 3; ++c) t.at(3, 0, c) = 50.f, t.at(4, 0, c) = 2.f;
    const FlipExposures e = flip_exposures(t);
    EXPECT_NEAR(flip_tone_map(50.f, e.start), 0.85f, 1e-6f);
    EXPECT_NEAR(flip_tone_map(0.1f, e.stop), 0.85f, 1e-6f);
    EXPECT_NEAR(e.stop - e.start, std::log2(500.), 1e-6);
    EXPECT_EQ(e.count, 9);  // 8.97, rounded up
    EXPECT_EQ(e[0], e.start);
    EXPECT_NEAR(e[8], e.stop, 1e-12);
    for (int x = 0; x < 3; ++x)
        for (int c = 0; c < 3; ++c) t.at(x, 0, c) = 0.f;
    EXPECT_NEAR(flip_exposures(t).stop - flip_exposures(t).start, std::log2(50. / 26.), 1e-6);
    EXPECT_EQ(flip_exposures(t).count, 2);
    EXPECT_EQ(flip_exposures(constant(2, 2, {})).count, 1);
    EXPECT_EQ(flip_exposures(constant(2, 2, {})).start, 0.);
    EXPECT_EQ(flip_exposures(constant(2, 2, {3.f, 3.f, 3.f})).count, 1);
}

TEST(FlipHdr, IsTheLargestOfItsExposures) {
    Image t = waves(48, 40);
    for (std::size_t i = 0; i < t.data.size(); i += 97) t.data[i] *= 40.f;
    const Image p = with_noise(t, 0.1, 7);
    const HdrFlipResult r = flip_hdr(p, t);
    ASSERT_GE(r.exposures.count, 4);
    Image largest(48, 40, {"Y"});
    for (int i = 0; i < r.exposures.count; ++i) {
        const double e = r.exposures[i];
        const FlipResult ldr = flip(tone_mapped(p, e), tone_mapped(t, e));
        EXPECT_LE(ldr.mean, r.mean);
        for (std::size_t k = 0; k < largest.data.size(); ++k) {
            largest.data[k] = std::max(largest.data[k], ldr.map.data[k]);
            if (r.exposure.data[k] == float(e)) {
                EXPECT_EQ(ldr.map.data[k], r.map.data[k]);
            }
        }
    }
    EXPECT_EQ(largest.data, r.map.data);
    const HdrFlipResult one = flip_hdr(p, t, {}, flip_pixels_per_degree, FlipExposures{1., 9., 1});
    EXPECT_EQ(one.map.data, flip(tone_mapped(p, 1.), tone_mapped(t, 1.)).map.data);
}

TEST(FlipHdr, AgreesWithTheAuthorsProgram) {
    // Means and pixels (20, 15), (33, 40) and (0, 0) by the authors' Python package flip-evaluator
    // 1.7, which computes in single precision.
    const Image t = waves(64, 48);
    Image p = t;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) {
                float& v = p.at(x, y, c);
                if (x >= 12 && x < 30 && y >= 10 && y < 20) v = c == 0 ? 0.8f : 0.1f;
                if ((x + y) % 7 == 0) v *= 0.7f;
            }
    const auto lit = [](Image image) {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) *=
                        std::exp2(5.f * std::sin(0.1f * float(x) + 0.06f * float(y)));
        return image;
    };
    struct Row {
        double pixels_per_degree;
        bool hdr;
        double mean, at[3];
    };
    constexpr Row rows[] = {
        {67.0206, false, 0.1555106, {0.8278344, 0.0630910, 0.3696821}},
        {67.0206, true, 0.1334160, {0.9114972, 0.0439416, 0.2442920}},
        {30.0, false, 0.1606151, {0.8240057, 0.0492012, 0.5152021}},
        {30.0, true, 0.1263987, {0.9670291, 0.0165633, 0.3759247}},
    };
    for (const Row& row : rows) {
        const FlipResult r = row.hdr ? flip_hdr(lit(p), lit(t), {}, row.pixels_per_degree)
                                     : flip(p, t, {}, row.pixels_per_degree);
        EXPECT_NEAR(r.mean, row.mean, 2e-5);
        EXPECT_NEAR(r.map.at(20, 15, 0), row.at[0], 1e-4);
        EXPECT_NEAR(r.map.at(33, 40, 0), row.at[1], 1e-4);
        EXPECT_NEAR(r.map.at(0, 0, 0), row.at[2], 1e-4);
    }
}

TEST(FlipHdr, DoesNotDependOnTheUnitOfLight) {
    Image t = waves(40, 40);
    t.at(20, 20, 1) = 30.f;
    Image p = with_noise(t, 0.05, 8);
    const double mean = flip_hdr(p, t).mean;
    for (Image* image : {&p, &t})
        for (float& v : image->data) v *= 64.f;
    EXPECT_NEAR(flip_hdr(p, t).mean, mean, 1e-6);
}

TEST(Flip, TheMeanIsOverTheMask) {
    Image a = constant(64, 16, {0.3f, 0.3f, 0.3f});
    const Image b = a;
    for (int c = 0; c < 3; ++c) a.at(8, 8, c) = 1.f;
    const FlipResult near = flip(a, b, PixelMask(64, 16, [](int x, int) { return x < 32; }));
    const FlipResult far = flip(a, b, PixelMask(64, 16, [](int x, int) { return x >= 32; }));
    EXPECT_NEAR(near.mean, 2. * flip(a, b).mean, 1e-9);
    EXPECT_NEAR(far.mean, 0., 1e-9);
}

TEST(Flip, WrongInputIsNamed) {
    const Image a(3, 2), b(2, 2);
    Image bad = a;
    bad.at(2, 1, 0) = std::nanf("");
    const std::pair<std::function<void()>, const char*> cases[] = {
        {[&] { flip(a, b); },
         "the picture has 3 x 2 pixels, but the reference has 2 x 2; compare pictures of one size"},
        {[&] { flip_hdr(a, b); },
         "the picture has 3 x 2 pixels, but the reference has 2 x 2; compare pictures of one size"},
        {[&] { flip(a, a, PixelMask(b)); },
         "the mask has 2 x 2 pixels, but the pictures have 3 x 2; make it of their size"},
        {[&] { flip(a, a, PixelMask(a)); },
         "the mask leaves no pixel; its green must be above 0.5 where a pixel counts"},
        {[&] { flip(bad, a); },
         "the picture is not finite at pixel (2, 1): (nan, 0, 0); mend it: FLIP sees every pixel, "
         "masked or not"},
        {[&] { flip(a, a, {}, 0.); },
         "pixels per degree: 0 is out of range; it must be from 1 to 10000"},
        {[&] {
             flip_hdr(a, a, {}, 67., FlipExposures{0., 1., 0});
         },
         "exposures: 0 are too few; there must be at least 1"},
    };
    for (const auto& [act, message] : cases) EXPECT_EQ(error_of(act), message);
}

}  // namespace nacre
