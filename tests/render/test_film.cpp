#include "nacre/render/film.h"

#include <gtest/gtest.h>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/render/filter.h"

namespace nacre {
namespace {

FilmSettings film_settings(int width, int height, const std::string& filter = "box") {
    FilmSettings s;
    s.width = width;
    s.height = height;
    s.filter.type = filter;
    s.sample_border = true;  // the whole filter at every pixel
    return s;
}

const std::vector<std::string> filters{"box", "tent", "gaussian", "mitchell"};

TEST(Film, MeanAndVarianceAreThoseOfTheSamples) {
    Film film(film_settings(2, 1));
    // 1, 2, 3, 4: mean 2.5, variance with n - 1: 5/3.
    for (int i = 1; i <= 4; ++i) film.add(1, 0, i, Vec3f(float(i), 2.f * float(i), 7.f), 1.f);
    EXPECT_EQ(film.count(1, 0), 4u);
    EXPECT_EQ(film.mean(1, 0), Vec3f(2.5f, 5.f, 7.f));
    EXPECT_FLOAT_EQ(film.sample_variance(1, 0).x, 5.f / 3.f);
    EXPECT_FLOAT_EQ(film.sample_variance(1, 0).y, 20.f / 3.f);
    EXPECT_EQ(film.sample_variance(1, 0).z, 0.f);
    EXPECT_EQ(film.count(0, 0), 0u);
    EXPECT_EQ(film.mean(0, 0), Vec3f(0, 0, 0));
}

TEST(Film, InvalidSamplesAreCountedAndLocatedAndNeverAdded) {
    FilmSettings s = film_settings(100, 100);
    s.crop_x = 10, s.crop_y = 20, s.crop_width = 30, s.crop_height = 40;
    Film film(s);
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();
    film.add(5, 6, 0, {1, 1, 1}, 1.f);
    film.add(5, 6, 2, {1, nan, 1}, 1.f);
    film.add(5, 6, 1, {inf, 0, 0}, 1.f);
    film.add(2, 3, 9, {0, 0, -1}, 1.f);
    film.add(2, 3, 8, {0, 0, -1}, 1.f, true);  // a colour that may be negative
    EXPECT_EQ(film.invalid_count(), 3u);
    EXPECT_EQ(film.mean(5, 6), Vec3f(1, 1, 1));
    EXPECT_EQ(film.mean(2, 3), Vec3f(0, 0, -1));
    const auto invalid = film.invalid_samples();
    ASSERT_EQ(invalid.size(), 3u);
    EXPECT_EQ(std::tuple(invalid[0].x, invalid[0].y, invalid[0].sample), std::tuple(12, 23, 9u));
    EXPECT_EQ(std::tuple(invalid[1].x, invalid[1].y, invalid[1].sample), std::tuple(15, 26, 1u));
    EXPECT_EQ(std::tuple(invalid[2].x, invalid[2].y, invalid[2].sample), std::tuple(15, 26, 2u));
    EXPECT_EQ(invalid[1].value.x, inf);
    for (int i = 0; i < 100; ++i) film.add_invalid(1, 1, i, {nan, nan, nan});
    EXPECT_EQ(film.invalid_count(), 103u);
    EXPECT_EQ(film.invalid_samples().size(), 16u);
    EXPECT_EQ(film.invalid_samples()[0].y, 21);
}

TEST(Film, WrongSizesAreAnswered) {
    const auto error = [](int w, int h, int x, int y, int cw, int ch,
                          FilterSettings filter = {}) -> std::string {
        FilmSettings s = film_settings(w, h);
        s.crop_x = x, s.crop_y = y, s.crop_width = cw, s.crop_height = ch;
        s.filter = filter;
        try {
            Film film(s);
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    EXPECT_EQ(error(0, 5, 0, 0, 0, 0),
              "a film of 0 x 5 pixels has no area; both sides must be positive");
    EXPECT_EQ(error(8, 8, 4, 0, 5, 8), "the crop window 4,0 5x8 leaves the film of 8 x 8 pixels");
    EXPECT_EQ(error(8, 8, -1, 0, 2, 2), "the crop window -1,0 2x2 leaves the film of 8 x 8 pixels");
    EXPECT_EQ(error(8, 8, 1, 1, 0, 3), "the crop window 1,1 0x3 leaves the film of 8 x 8 pixels");
    EXPECT_EQ(error(8, 8, 0, 0, 8, 8), "no error");
    FilterSettings filter;
    filter.type = "lanczos";
    EXPECT_EQ(error(8, 8, 0, 0, 0, 0, filter),
              "unknown reconstruction filter 'lanczos'; known are: box, tent, gaussian, mitchell");
    filter.type = "tent";
    filter.radius = -1;
    EXPECT_EQ(error(8, 8, 0, 0, 0, 0, filter),
              "a reconstruction filter of radius -1 has no area; give it a positive radius or "
              "standard deviation");
}

/// A constant picture is the same constant whatever the filter, with any number of samples.
TEST(Film, AConstantPictureStaysConstantUnderEveryFilter) {
    for (const std::string& type : filters) {
        const FilmSettings settings = film_settings(16, 16, type);
        const Filter filter(settings.filter);
        for (int samples : {1, 2, 3, 16}) {
            Film film(settings);
            Random random(1);
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) {
                    for (int s = 0; s < samples; ++s)
                        film.add(x, y, s, {0.3f, 2.f, 0.f}, filter.sample(random.next2()).weight);
                    const Vec3f mean = film.mean(x, y);
                    ASSERT_FLOAT_EQ(mean.x, 0.3f) << type << " " << samples;
                    ASSERT_FLOAT_EQ(mean.y, 2.f);
                    ASSERT_NEAR(film.sample_variance(x, y).y, 0.f, 1e-6f);
                }
        }
    }
}

/// Simpson's rule for the filter's moments, independent of its table.
double integrate(const Filter& f, const std::function<double(double)>& g) {
    const int n = 20000;
    double sum = 0;
    const double r = f.radius(), h = 2 * r / n;
    for (int i = 0; i <= n; ++i) {
        const double x = -r + i * h, w = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
        sum += w * f.eval(static_cast<float>(x)) * g(x);
    }
    return sum * h / 3;
}

TEST(Filter, RadiiIntegralsAndValuesAreThoseOfTheLiterature) {
    const auto filter = [](const char* type) {
        FilterSettings s;
        s.type = type;
        return Filter(s);
    };
    EXPECT_EQ(filter("box").radius(), 0.5f);
    EXPECT_EQ(filter("tent").radius(), 1.f);
    EXPECT_EQ(filter("gaussian").radius(), 2.f);
    EXPECT_EQ(filter("mitchell").radius(), 2.f);
    for (const std::string& type : filters)
        EXPECT_NEAR(integrate(filter(type.c_str()), [](double) { return 1.0; }), 1, 1e-5) << type;
    EXPECT_FLOAT_EQ(filter("box").eval(0.2f), 1.f);
    EXPECT_FLOAT_EQ(filter("tent").eval(0.25f), 0.75f);
    // Mitchell and Netravali with B = C = 1/3: k(0) = 16/18, k(1) = 1/18, and in the
    // outer lobe (-7 x^3 + 36 x^2 - 60 x + 32)/18.
    EXPECT_NEAR(filter("mitchell").eval(0.f), 16.0 / 18, 1e-5);
    EXPECT_NEAR(filter("mitchell").eval(1.f), 1.0 / 18, 1e-5);
    const double x = 10.0 / 7;
    EXPECT_NEAR(filter("mitchell").eval(float(x)), (-7 * x * x * x + 36 * x * x - 60 * x + 32) / 18,
                1e-5);
    // Gaussian of 0.5 lowered by exp(-8), relative to its middle.
    const double low = std::exp(-8.0);
    EXPECT_NEAR(filter("gaussian").eval(0.5f) / filter("gaussian").eval(0.f),
                (std::exp(-0.5) - low) / (1 - low), 1e-5);
    EXPECT_EQ(filter("box").absolute_integral(), 1.f);
    // The cubic is negative for 8/7 < |x| < 2.
    const auto cubic = [](double t) {
        return (-7 * t * t * t * t / 4 + 12 * t * t * t - 30 * t * t + 32 * t) / 18;
    };
    const double lobe = 2 * (cubic(8.0 / 7) - cubic(2.0));
    EXPECT_NEAR(filter("mitchell").absolute_integral(), (1 + 2 * lobe) * (1 + 2 * lobe), 2e-4);
}

/// The weighted mean of a smooth function over the samples is its integral against the filter:
/// cos(2 x) cos(3 y), whose transform is known by quadrature, within 5 standard errors.
TEST(Filter, SamplesAverageToTheFilteredPicture) {
    for (const std::string& type : filters) {
        const FilmSettings settings = film_settings(1, 1, type);
        const Filter filter(settings.filter);
        const double exact = integrate(filter, [](double x) { return std::cos(2 * x); }) *
                             integrate(filter, [](double x) { return std::cos(3 * x); });
        Film film(settings);
        Random random(11);
        const int n = 400000;
        for (int i = 0; i < n; ++i) {
            const FilterSample s = filter.sample(random.next2());
            EXPECT_FLOAT_EQ(std::abs(s.weight), filter.absolute_integral());
            const float v = 2.f + std::cos(2 * s.offset.x) * std::cos(3 * s.offset.y);
            film.add(0, 0, i, {v, v, v}, s.weight);
        }
        const double error = std::sqrt(film.sample_variance(0, 0).x / n);
        EXPECT_GT(error, 0.0);
        EXPECT_NEAR(film.mean(0, 0).x - 2, exact, 5 * error) << type;
    }
}

/// Off the border a window changes nothing; at it samples stay on the film, and a constant picture
/// stays constant.
TEST(Filter, SamplesAtTheBorderStayOnTheFilm) {
    for (const std::string& type : filters) {
        FilmSettings settings = film_settings(12, 12, type);
        settings.sample_border = false;
        const Filter filter(settings.filter);
        Film film(settings);
        Random random(3);
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x)
                for (int i = 0; i < 64; ++i) {
                    const Vec2f u = random.next2();
                    const FilterSample s = filter.sample(u, filter_window(settings, x, y));
                    const float at_x = float(x) + 0.5f + s.offset.x,
                                at_y = float(y) + 0.5f + s.offset.y;
                    ASSERT_TRUE(at_x >= 0.f && at_x <= 12.f && at_y >= 0.f && at_y <= 12.f)
                        << type << " " << x << " " << y;
                    if (x >= 2 && x < 10 && y >= 2 && y < 10) {
                        ASSERT_EQ(s.offset.x, filter.sample(u).offset.x);
                        ASSERT_EQ(s.offset.y, filter.sample(u).offset.y);
                    }
                    film.add(x, y, i, {1.f, 1.f, 1.f}, s.weight);
                }
        for (int i = 0; i < 12; ++i) ASSERT_FLOAT_EQ(film.mean(i, 0).x, 1.f) << type;
    }
}

/// By hand: a tent of radius 1 at the left border keeps x > -1/2; its mean is
/// (1/6 - 1/12) / (7/8) = 2/21.
TEST(Filter, TheMeanOfATentCutAtTheBorderIsThatByHand) {
    FilmSettings settings = film_settings(8, 8, "tent");
    settings.sample_border = false;
    const Filter filter(settings.filter);
    Random random(4);
    double sum = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i)
        sum += filter.sample(random.next2(), filter_window(settings, 0, 4)).offset.x;
    EXPECT_NEAR(sum / n, 2. / 21, 5 * 0.36 / std::sqrt(n));
}

/// Pixels of many short runs: their mean is the expectation and their scatter is what
/// sample_variance / count promises. Fails if the negative lobes are added with the wrong factor.
TEST(Film, TheVarianceOfSignedSamplesPredictsTheScatterOfPixels) {
    const FilmSettings settings = film_settings(64, 64, "mitchell");
    const Filter filter(settings.filter);
    Film film(settings);
    Random random(5);
    double sum = 0, sum2 = 0, promised = 0;
    const int samples = 64, pixels = 64 * 64;
    for (int p = 0; p < pixels; ++p) {
        const int x = p % 64, y = p / 64;
        for (int i = 0; i < samples; ++i) {
            const FilterSample s = filter.sample(random.next2());
            const float v = 2.f + s.offset.x + (s.weight < 0 ? 1.f : 0.f) * random.next();
            film.add(x, y, i, {v, v, v}, s.weight);
        }
        const double m = film.mean(x, y).x;
        sum += m;
        sum2 += m * m;
        promised += film.sample_variance(x, y).x / samples;
    }
    const double scatter = (sum2 - sum * sum / pixels) / (pixels - 1);
    // Relative standard error of a variance from 4096 pixels is sqrt(2 / 4095) = 2.2 %; 5 sigma.
    EXPECT_NEAR(promised / pixels / scatter, 1.0, 0.11);
}

}  // namespace
}  // namespace nacre
