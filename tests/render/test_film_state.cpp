// Films that are kept, sent and put together: no bit is lost, and what is damaged is not taken.
#include "nacre/render/film_state.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/render/render.h"
#include "nacre/render/render_job.h"
#include "tests/metrics/pictures_fixture.h"

namespace nacre {
namespace {

using test::error_of;

FilmSettings settings(const char* filter) {
    FilmSettings s;
    s.width = 7;
    s.height = 5;
    s.filter.type = filter;
    return s;
}

/// Samples of very different sizes, some invalid; sample s of pixel i is the same in every film.
void add_samples(Film& film, int first, int last) {
    const FilmSettings& s = film.settings();
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            for (int i = first; i < last; ++i) {
                Random random(std::uint64_t((y + s.crop_y) * 100 + x + s.crop_x) * 1000 + i);
                const float v = std::exp(60.f * (random.next() - 0.7f));
                const bool wrong = random.next() < 0.05f;
                film.add(x, y, std::uint32_t(i), {v, wrong ? std::nanf("") : 2.f * v, 1.f / 3.f},
                         i % 3 == 2 ? -1.f : 1.f);
            }
}

void expect_same(const Film& a, const Film& b) {
    ASSERT_EQ(a.width(), b.width());
    ASSERT_EQ(a.height(), b.height());
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            EXPECT_EQ(a.mean(x, y), b.mean(x, y));
            EXPECT_EQ(a.sample_variance(x, y), b.sample_variance(x, y));
            EXPECT_EQ(a.count(x, y), b.count(x, y));
        }
    EXPECT_EQ(a.invalid_count(), b.invalid_count());
    const auto i = a.invalid_samples(), k = b.invalid_samples();
    ASSERT_EQ(i.size(), k.size());
    for (std::size_t n = 0; n < i.size(); ++n) {
        EXPECT_EQ(std::tuple(i[n].x, i[n].y, i[n].sample), std::tuple(k[n].x, k[n].y, k[n].sample));
        EXPECT_EQ(i[n].value.x, k[n].value.x);
        EXPECT_TRUE(std::isnan(k[n].value.y));
    }
}

/// What is added after a film was kept and taken up makes the bits that it would have made anyway.
TEST(FilmState, AFilmThatWasKeptGoesOnToTheSameBits) {
    for (const char* filter : {"box", "mitchell"}) {
        FilmSettings s = settings(filter);
        s.crop_x = 1, s.crop_y = 2, s.crop_width = 5, s.crop_height = 3;
        Film whole(s), part(s);
        add_samples(whole, 0, 20);
        add_samples(part, 0, 11);
        ASSERT_GT(part.invalid_count(), 0u);
        FilmState kept = FilmState::decode(
            FilmState::encode(part, {{"rounds", "3"}, {"command", "a \"b\" = c"}}));
        expect_same(part, kept.film);
        EXPECT_EQ(kept.notes, (std::map<std::string, std::string>{{"rounds", "3"},
                                                                  {"command", "a \"b\" = c"}}));
        EXPECT_EQ(kept.film.settings().crop_x, 1);
        EXPECT_EQ(kept.film.settings().filter, s.filter);
        add_samples(kept.film, 11, 20);
        expect_same(whole, kept.film);
    }
}

TEST(FilmState, TilesThatWereRenderedApartMakeTheWhole) {
    Film whole(settings("gaussian")), joined(settings("gaussian"));
    add_samples(whole, 0, 6);
    for (const auto& [x, y, w, h] : {std::tuple(0, 0, 7, 2), {0, 2, 3, 3}, {3, 2, 4, 3}}) {
        FilmSettings s = settings("gaussian");
        s.crop_x = x, s.crop_y = y, s.crop_width = w, s.crop_height = h;
        Film tile(s);
        add_samples(tile, 0, 6);
        joined.merge(FilmState::decode(FilmState::encode(tile, {})).film);
    }
    expect_same(whole, joined);
}

TEST(FilmState, SamplesThatWereRenderedApartHaveTheMeanAndVarianceOfAll) {
    Film whole(settings("mitchell")), a(settings("mitchell")), b(settings("mitchell"));
    add_samples(whole, 0, 30);
    add_samples(a, 0, 12);
    add_samples(b, 12, 30);
    a.merge(b);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            EXPECT_EQ(a.count(x, y), whole.count(x, y));
            EXPECT_FLOAT_EQ(a.mean(x, y).x, whole.mean(x, y).x);
            EXPECT_FLOAT_EQ(a.sample_variance(x, y).x, whole.sample_variance(x, y).x);
        }
    EXPECT_EQ(a.invalid_count(), whole.invalid_count());
}

TEST(FilmState, FilmsOfOtherPicturesAreNotAdded) {
    const Film film(settings("box"));
    struct Case {
        const char* what;
        void (*change)(FilmSettings&);
    };
    for (const Case& c :
         {Case{"size", [](FilmSettings& s) { s.width = 8; }},
          {"filter", [](FilmSettings& s) { s.filter.type = "tent"; }},
          {"radius", [](FilmSettings& s) { s.filter.radius = 1; }},
          {"border", [](FilmSettings& s) { s.sample_border = true; }},
          {"quantity", [](FilmSettings& s) { s.quantity = FilmQuantity::luminance; }}}) {
        FilmSettings s = settings("box");
        c.change(s);
        Film other(s);
        EXPECT_THROW(other.merge(film), InputError) << c.what;
    }
    FilmSettings s = settings("box");
    s.crop_x = 1, s.crop_y = 1, s.crop_width = 3, s.crop_height = 3;
    Film window(s);
    EXPECT_EQ(error_of([&] { window.merge(film); }),
              "a film of 7 x 5 pixels, window 0,0 7x5, box filter cannot be added to one of 7 x 5 "
              "pixels, window 1,1 3x3, box filter: they must show the same picture, and its window "
              "must lie within this one's");
}

/// A kept film is a picture for everybody else.
TEST(FilmState, IsAPictureWithVariance) {
    Film film(settings("box"));
    add_samples(film, 0, 4);
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / fmt::format("film_{}.exr", getpid());
    FilmState::save(film, {{"samples", "4"}}, file);
    const Image image = read_image(file);
    EXPECT_EQ(image.at(3, 2, 1), film.mean(3, 2).y);
    EXPECT_EQ(image.at(3, 2, image.channel("variance.G")), film.sample_variance(3, 2).y);
    EXPECT_EQ(image.metadata.at("nacre.samples"), "4");
    expect_same(FilmState::load(file).film, film);
    std::filesystem::remove(file);
    EXPECT_EQ(error_of([&] { FilmState::load(file); }), "it cannot be read");
}

TEST(FilmState, WhatIsDamagedIsNotTaken) {
    Film film(settings("box"));
    add_samples(film, 0, 4);
    const std::string bytes = FilmState::encode(film, {{"samples", "4"}});
    EXPECT_NE(error_of([&] { FilmState::decode("nothing"); }), "");
    for (std::size_t n : {std::size_t(0), std::size_t(100), bytes.size() / 2, bytes.size() - 1})
        EXPECT_NE(error_of([&] { FilmState::decode(bytes.substr(0, n)); }), "") << n;
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string text = bytes;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, text.npos);
        return text.replace(at, from.size(), to);
    };
    EXPECT_EQ(error_of([&] { FilmState::decode(replaced("7 5 0 0 7 5", "7 6 0 0 7 6")); }),
              "it holds pixels of another film");
    EXPECT_EQ(error_of([&] { FilmState::decode(replaced("7 5 0 0 7 5", "7 x 0 0 7 5")); }),
              "it holds 'x' in nacre.film");
    EXPECT_EQ(error_of([&] { FilmState::decode(replaced("sum.G.low", "sum.X.low")); }),
              "it holds no sum.G.low");
    EXPECT_EQ(error_of([&] { FilmState::decode(replaced("nacre.film", "nacre.fulm")); }),
              "it holds no nacre.film");
}

}  // namespace
}  // namespace nacre
