// Four lanes in one path: each shows what it would show alone.
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

class SpectralMedia : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        const auto density = [](int x, int y, int z) {
            return 0.3 + ((x + 2 * y + 3 * z) % 5) / 4.;
        };
        for (int c = 0; c < 3; ++c) {
            write_vol(fmt::format("grey{}.vol", c), 6, 1,
                      [&](int x, int y, int z, int) { return sigma_[c] * density(x, y, z); });
        }
        write_vol("chromatic.vol", 6, 3,
                  [&](int x, int y, int z, int c) { return sigma_[c] * density(x, y, z); });
    }
    static std::string grid(const std::string& file) {
        return "<volume name=\"sigma_t\" type=\"gridvolume\"><string name=\"filename\" value=\"" +
               file +
               "\"/><transform name=\"to_world\"><translate x=\"-0.5\" y=\"-0.5\" z=\"-0.5\"/>"
               "<scale value=\"2\"/></transform></volume>";
    }
    /// Body about the origin, its medium described by the text, lit by a ball and a dim sky.
    std::string stage(const std::string& boundary, const std::string& type,
                      const std::string& coefficients, const std::string& phase) const {
        return xml::integrator("volpath") + xml::constant_light(0.4) +
               xml::sphere({1.5, 2, -2}, 0.8, xml::area_light({6, 6, 6})) +
               xml::sphere({}, 1,
                           boundary + "<medium name=\"interior\" type=\"" + type + "\">" +
                               coefficients + phase + "</medium>");
    }
    const RayMaker rays_ = ray_bundle({0, 0, 4}, {0, 0, -1}, 0.95f);
    const Vec3d sigma_{0.8, 3, 9}, albedo_{0.99, 0.8, 0.5};
};

// In RGB bands, where the hero's probabilities make the path for all: each band of a medium whose
// extinction varies by a factor of ten is what a grey medium of that extinction shows.
TEST_F(SpectralMedia, EachBandIsAGreyMedium) {
    const double deviations = sidak_deviations(5 * 3);
    struct Case {
        std::string name, boundary;
        bool grid;
        std::string phase;
    };
    for (const Case& k :
         {Case{"glass, isotropic", xml::dielectric(1.4), false, xml::phase("isotropic")},
          Case{"glass, hg", xml::dielectric(1.4), false, xml::phase("hg", 0.6)},
          Case{"no boundary, hg", xml::bsdf("null"), false, xml::phase("hg", 0.6)},
          Case{"no boundary, grid", xml::bsdf("null"), true, xml::phase("isotropic")},
          Case{"glass, grid", xml::dielectric(1.4), true, xml::phase("isotropic")}}) {
        const std::string type = k.grid ? "heterogeneous" : "homogeneous";
        const Scene chromatic =
            scene(stage(k.boundary, type,
                        (k.grid ? grid("chromatic.vol") : xml::rgb("sigma_t", sigma_)) +
                            xml::rgb("albedo", albedo_),
                        k.phase));
        const auto all = estimate(chromatic, rays_, {.pixels = 8000, .samples = 15, .seed = 1});
        RadianceEstimate grey = all;
        for (int c = 0; c < 3; ++c) {
            const Scene s = scene(stage(
                k.boundary, type,
                (k.grid ? grid(fmt::format("grey{}.vol", c)) : xml::number("sigma_t", sigma_[c])) +
                    xml::number("albedo", albedo_[c]),
                k.phase));
            const auto e = estimate(s, rays_, {.pixels = 4000, .seed = std::uint64_t(2 + c)});
            grey.mean[c] = e.mean[c];
            grey.error[c] = e.error[c];
        }
        expect_agreement(all, grey, deviations, k.name);
        for (int c = 0; c < 3; ++c) EXPECT_LT(all.error[c], 0.02 * all.mean[c]) << k.name;
    }
}

// A medium without colour looks the same in both modes.
TEST_F(SpectralMedia, GreyMediaLookTheSameInBothModes) {
    for (const bool glass : {false, true}) {
        const std::string text =
            stage(glass ? xml::dielectric(1.4) : xml::bsdf("null"), "homogeneous",
                  xml::number("sigma_t", 3) + xml::number("albedo", 0.9), xml::phase("hg", 0.5));
        const auto rgb = estimate(scene(text), rays_, {.pixels = 6000, .seed = 1});
        const auto spectral =
            estimate(scene(text, ColorMode::spectral), rays_, {.pixels = 6000, .seed = 2});
        const double error = std::hypot(rgb.luminance_error(), spectral.luminance_error());
        EXPECT_NEAR(rgb.luminance(), spectral.luminance(), 4 * error);
        EXPECT_LT(error, 0.015 * rgb.luminance());
    }
}

// In spectral mode a chromatic medium shows, by wavelength, what grey media of its values show:
// here a step, below and above 550 nm, so that the picture is the sum of two grey ones.
TEST_F(SpectralMedia, WavelengthsOfOnePathDoNotMix) {
    for (const bool glass : {false, true}) {
        const std::string boundary = glass ? xml::dielectric(1.4) : xml::bsdf("null");
        const auto stepped = [](const std::string& name, double low, double high) {
            return fmt::format(
                "<spectrum name=\"{}\" value=\"360:{}, 549.99:{}, 550.01:{}, "
                "830:{}\"/>",
                name, low, low, high, high);
        };
        const auto render = [&](double low_sigma, double high_sigma, double low_albedo,
                                double high_albedo, std::uint64_t seed) {
            return estimate(scene(stage(boundary, "homogeneous",
                                        stepped("sigma_t", low_sigma, high_sigma) +
                                            stepped("albedo", low_albedo, high_albedo),
                                        xml::phase("hg", 0.5)),
                                  ColorMode::spectral),
                            rays_, {.pixels = 8000, .seed = seed});
        };
        // Black above or below the step: nothing of the other range is seen but the reflection at
        // the boundary, which is there in both, and in a medium that is black throughout.
        const auto both = render(0.7, 8, 0.9, 0.99, 1), low = render(0.7, 8, 0.9, 0, 2),
                   high = render(0.7, 8, 0, 0.99, 3), none = render(0.7, 8, 0, 0, 4);
        for (int c = 0; c < 3; ++c) {
            const double error =
                std::sqrt(both.error[c] * both.error[c] + low.error[c] * low.error[c] +
                          high.error[c] * high.error[c] + none.error[c] * none.error[c]);
            EXPECT_NEAR(both.mean[c], low.mean[c] + high.mean[c] - none.mean[c],
                        sidak_deviations(6) * error)
                << "glass " << glass << ", channel " << c;
        }
        // And single wavelengths are those of grey media: the colour that the low range brings.
        const auto grey =
            estimate(scene(stage(boundary, "homogeneous",
                                 xml::number("sigma_t", 8) + xml::number("albedo", 0.99),
                                 xml::phase("hg", 0.5)),
                           ColorMode::spectral),
                     rays_, {.pixels = 8000, .seed = 5});
        const auto same = render(8, 8, 0.99, 0.99, 6);
        expect_agreement(grey, same, sidak_deviations(6), "constant spectrum and number");
    }
}

// Media of one extinction but several albedos, and of an extinction that is zero in one band.
TEST_F(SpectralMedia, BandsWithoutExtinctionAreClear) {
    const Scene s = scene(
        xml::integrator("volpath") + xml::constant_light() +
        xml::sphere({}, 1,
                    xml::bsdf("null") + xml::medium("interior", xml::rgb("sigma_t", {0, 2, 5}) +
                                                                    xml::number("albedo", 0))));
    const auto e = estimate(s, fixed_ray({0, 0, 4}, {0, 0, -1}), {.pixels = 4000, .samples = 15});
    expect_radiance(e, {1, std::exp(-4.), std::exp(-10.)}, 4e-3, "absorption");
}

}  // namespace
}  // namespace nacre
