#include "nacre/spectrum/spectrum.h"

#include <gtest/gtest.h>

#include "nacre/math/error.h"
#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/uplift.h"

namespace nacre {

namespace {

Vec3f colour_under_d65(const Spectrum& s) {
    return xyz_to_rgb(
        integrate_xyz([&](float nm) { return s.eval(Wavelengths::at(nm))[0] * d65_unit(nm); }));
}
Vec3f colour_of_light(const Spectrum& s) {
    return xyz_to_rgb(integrate_xyz([&](float nm) { return s.eval(Wavelengths::at(nm))[0]; }));
}
float distance(Vec3f a, Vec3f b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}
void expect_bands(const Spectrum& s) {
    const Spectral v = s.eval(Wavelengths::rgb_bands());
    const Vec3f rgb = s.rgb();
    EXPECT_EQ(v[0], rgb.x);
    EXPECT_EQ(v[1], rgb.y);
    EXPECT_EQ(v[2], rgb.z);
    EXPECT_EQ(v[3], 0.f);
}
void expect_bounded(const Spectrum& s) {
    for (float nm = visible_min; nm <= visible_max; nm += 0.5f)
        ASSERT_LE(s.eval(Wavelengths::at(nm))[0], s.max() * (1.f + 1e-6f)) << nm;
    const Vec3f rgb = s.rgb();
    EXPECT_LE(std::max({rgb.x, rgb.y, rgb.z}), s.max());
}

}  // namespace

TEST(Uplift, ColoursSurviveTheRoundTrip) {
    float worst = 0.f;
    const int steps = 12;
    for (int r = 0; r <= steps; ++r)
        for (int g = 0; g <= steps; ++g)
            for (int b = 0; b <= steps; ++b) {
                const Vec3f rgb = Vec3f(float(r), float(g), float(b)) / float(steps);
                const SigmoidPolynomial fit = fit_rgb(rgb);
                const Vec3f back = xyz_to_rgb(
                    integrate_xyz([&](float nm) { return fit.eval(nm)[0] * d65_unit(nm); }));
                worst = std::max(worst, distance(back, rgb));
                ASSERT_LT(distance(back, rgb), 3e-4f) << rgb.x << ' ' << rgb.y << ' ' << rgb.z;
            }
    RecordProperty("worst", std::to_string(worst));
}

TEST(Uplift, DarkColoursSurviveTheRoundTrip) {
    for (const float scale : {0.1f, 0.01f, 0.002f})
        for (const Vec3f& hue : {Vec3f(1.f, 0.3f, 0.2f), Vec3f(0.1f, 1.f, 0.4f),
                                 Vec3f(0.3f, 0.1f, 1.f), Vec3f(1.f, 0.02f, 0.9f)}) {
            const auto s = make_rgb_reflectance(hue * scale);
            EXPECT_LT(distance(colour_under_d65(*s), hue * scale), 0.01f * scale);
        }
}

TEST(Uplift, GreysAreConstantBlackAndWhiteExact) {
    for (const float v : {0.f, 0.001f, 0.18f, 0.5f, 0.9f, 1.f}) {
        const SigmoidPolynomial fit = fit_rgb({v, v, v});
        for (const float nm : {360.f, 500.f, 830.f}) {
            if (v == 0.f || v == 1.f)
                EXPECT_EQ(fit.eval(nm)[0], v);
            else
                EXPECT_NEAR(fit.eval(nm)[0], v, 1e-6f);
        }
    }
}

TEST(Uplift, SpectraAreSmoothReflectances) {
    const SigmoidPolynomial red = fit_rgb({0.8f, 0.1f, 0.05f});
    EXPECT_GT(red.eval(650.f)[0], 0.7f);
    EXPECT_LT(red.eval(450.f)[0], 0.15f);
    EXPECT_LE(red.max(), 1.f);
    EXPECT_GE(red.max(), red.eval(700.f)[0]);
}

TEST(Spectrum, RgbKindsShowTheirColour) {
    const Vec3f skin(0.032f, 0.17f, 0.48f), bright(3.f, 12.f, 7.f);
    EXPECT_LT(distance(colour_under_d65(*make_rgb_unbounded(skin)), skin), 3e-4f);
    EXPECT_LT(distance(colour_under_d65(*make_rgb_unbounded(bright)), bright), 0.01f);
    EXPECT_LT(distance(colour_of_light(*make_rgb_illuminant(bright)), bright), 0.01f);
    EXPECT_LT(distance(colour_of_light(*make_rgb_illuminant({1.f, 1.f, 1.f})), {1.f, 1.f, 1.f}),
              1e-5f);
    for (const auto& s :
         {make_rgb_unbounded(bright), make_rgb_illuminant(bright), make_rgb_reflectance(skin),
          make_constant(0.7f), make_blackbody(4000.f, 1.f), make_rgb_unbounded({0.f, 0.f, 0.f})}) {
        expect_bands(*s);
        expect_bounded(*s);
    }
    EXPECT_FALSE(make_rgb_reflectance(skin)->is_spectral());
    EXPECT_TRUE(make_blackbody(4000.f)->is_spectral());
}

TEST(Spectrum, TabulatedIsLinearBetweenItsPointsAndZeroOutside) {
    const auto s = make_tabulated({400.f, 500.f, 700.f}, {1.f, 0.f, 4.f}, SpectrumRole::unbounded);
    const Spectral v = s->eval(Wavelengths::at(Spectral(400.f, 450.f, 650.f, 700.f)));
    EXPECT_FLOAT_EQ(v[0], 1.f);
    EXPECT_FLOAT_EQ(v[1], 0.5f);
    EXPECT_FLOAT_EQ(v[2], 3.f);
    EXPECT_FLOAT_EQ(v[3], 4.f);
    EXPECT_EQ(s->eval(Wavelengths::at(399.f))[0], 0.f);
    EXPECT_EQ(s->eval(Wavelengths::at(701.f))[0], 0.f);
    EXPECT_TRUE(s->is_spectral());
    expect_bands(*s);
    expect_bounded(*s);
}

TEST(Spectrum, RoleDecidesTheColourOfWavelengthData) {
    const std::vector<float> nm{350.f, 840.f}, one{1.f, 1.f};
    // A white reflectance is white under D65; equal energy as a light is not, but of luminance 1.
    EXPECT_LT(distance(make_tabulated(nm, one, SpectrumRole::reflectance)->rgb(), {1.f, 1.f, 1.f}),
              1e-5f);
    const Vec3f light = make_tabulated(nm, one, SpectrumRole::illuminant)->rgb();
    EXPECT_NEAR(luminance(light), 1.f, 1e-5f);
    EXPECT_NEAR(light.x, 1.2048f, 2e-3f);  // illuminant E in linear sRGB: 1.2048, 0.9483, 0.9089
    EXPECT_NEAR(light.y, 0.9483f, 2e-3f);
    EXPECT_NEAR(light.z, 0.9089f, 2e-3f);
    // Beyond 1 a reflectance is clamped, a coefficient is not.
    const std::vector<float> three{3.f, 3.f};
    EXPECT_EQ(make_tabulated(nm, three, SpectrumRole::reflectance)->rgb().x, 1.f);
    EXPECT_NEAR(make_tabulated(nm, three, SpectrumRole::unbounded)->rgb().x, 3.f, 1e-4f);
}

TEST(Spectrum, BlackbodyObeysStefanBoltzmannAndWien) {
    // Radiance over all wavelengths is sigma T^4 / pi. The visible range holds only a part of it,
    // so wavelengths are moved to 600 nm by L(a lambda, T) = a^-5 L(lambda, a T).
    const double sigma = 5.670374419e-8;
    double total = 0.;
    for (double log_nm = std::log(20.); log_nm < std::log(5e6); log_nm += 1e-3) {
        const double nm = std::exp(log_nm);  // at 5000 K
        const double scaled = 5000. * nm / 600.;
        const double radiance = make_blackbody(float(scaled))->eval(Wavelengths::at(600.f))[0] *
                                std::pow(5000. / scaled, 5.);
        total += radiance * nm * 1e-3;
    }
    EXPECT_NEAR(total / (sigma * std::pow(5000., 4.) / std::acos(-1.)), 1., 1e-4);

    // The peak at 5000 K lies at 2897.772 um K / 5000 K = 579.55 nm.
    const auto sun = make_blackbody(5000.f);
    float best = 0.f, at = 0.f;
    for (float nm = 500.f; nm < 650.f; nm += 0.25f) {
        const float v = sun->eval(Wavelengths::at(nm))[0];
        if (v > best) best = v, at = nm;
    }
    EXPECT_NEAR(at, 579.55f, 2.f);
}

TEST(Spectrum, ColdBlackbodiesAreDarkAndFinite) {
    const auto cold = make_blackbody(100.f);
    EXPECT_EQ(cold->eval(Wavelengths::at(500.f))[0], 0.f);
    EXPECT_EQ(cold->max(), 0.f);
}

TEST(Spectrum, RefusesWrongInput) {
    const auto message = [](auto make) -> std::string {
        try {
            make();
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    const auto table = [](std::vector<float> nm, std::vector<float> v) {
        return [=] { make_tabulated(nm, v, SpectrumRole::reflectance); };
    };
    const float nan = std::nanf("");
    EXPECT_EQ(message(table({400.f, 500.f}, {1.f})),
              "tabulated spectrum: 2 wavelengths but 1 values");
    EXPECT_EQ(message(table({400.f}, {1.f})),
              "tabulated spectrum: 1 point(s), but at least two are needed to interpolate");
    EXPECT_EQ(message(table({500.f, 400.f}, {1.f, 1.f})),
              "tabulated spectrum: wavelength 2 (400 nm) does not follow the one before it; sort "
              "the points by increasing wavelength, each once");
    EXPECT_EQ(message(table({400.f, 500.f}, {1.f, -1.f})),
              "tabulated spectrum: value -1 at 500 nm must be finite and not negative");
    EXPECT_EQ(message(table({400.f, 500.f}, {1.f, nan})),
              "tabulated spectrum: value nan at 500 nm must be finite and not negative");
    EXPECT_EQ(message([] { make_blackbody(0.f); }), "blackbody: temperature 0 K must be positive");
    EXPECT_EQ(message([] { make_blackbody(3000.f, -2.f); }),
              "blackbody: scale -2 must not be negative");
    EXPECT_EQ(message([] {
                  make_rgb_unbounded({1.f, -1.f, 0.f});
              }),
              "rgb (1, -1, 0): components must be finite and not negative");
}

}  // namespace nacre
