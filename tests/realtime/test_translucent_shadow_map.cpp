// Translucent shadow maps against the sum over all texels of the light's picture, against closed
// forms, and as what the passes owe to every technique.
#include "nacre/bssrdf/dipole.h"
#include "nacre/realtime/band_profiles.h"
#include "tests/realtime/frames.h"

namespace nacre {

const TechniqueDescription& translucent_shadow_map_technique();

namespace {

/// What a technique was given and made of the first light, read back.
struct Recorded {
    std::vector<float> position, normal, lit, light_position, entered, below;
    View camera, light;
    LightPoint point;
    int lights = 0;
};

/// Passes everything on to another technique and keeps what passed.
class Recorder final : public RealtimeTechnique {
  public:
    Recorder(std::unique_ptr<RealtimeTechnique> inner, Recorded& kept)
        : inner_(std::move(inner)), kept_(kept) {}
    void add_light(const CameraSurface& camera, const LightSurface& light,
                   const Texture& below) override {
        inner_->add_light(camera, light, below);
        if (kept_.lights++ > 0) return;
        kept_.camera = camera.view;
        kept_.light = light.view;
        kept_.point = light.light;
        kept_.position = camera.position.read();
        kept_.normal = camera.normal.read();
        kept_.lit = camera.lit.read();
        kept_.light_position = light.position.read();
        kept_.entered = light.entered.read();
        kept_.below = below.read();
    }
    void finish(const CameraSurface& camera, const Texture& below) override {
        inner_->finish(camera, below);
    }

  private:
    std::unique_ptr<RealtimeTechnique> inner_;
    Recorded& kept_;
};

class ShadowMaps : public Frames {
  protected:
    /// One frame of translucent shadow maps; what they saw of the first light.
    Recorded record(const Scene& s, const Settings& options = {}, int light_view = 512) {
        // A plain function makes techniques: where to record is passed beside it.
        static thread_local Recorded* kept;
        Recorded result;
        kept = &result;
        TechniqueDescription recording = translucent_shadow_map_technique();
        recording.realtime = [](const RealtimeInput& in) -> std::unique_ptr<RealtimeTechnique> {
            return std::make_unique<Recorder>(translucent_shadow_map_technique().realtime(in),
                                              *kept);
        };
        FrameRenderer renderer(gpu(), s, shapes_of(s, recording, options));
        renderer.render(camera_of(s, renderer.scene()), {.light_view = light_view});
        return result;
    }
    static ProfileMedium band(int c) {
        const double s[] = {1, 0.7, 2}, a[] = {0.02, 0.05, 0.03};
        return {s[c], a[c], 0, 1.3};
    }
    /// The sum over all texels of the light's picture, of R of the distance, at one pixel.
    static Vec3d brute_force(const Recorded& r, std::size_t pixel) {
        const Vec3d p(r.position[4 * pixel], r.position[4 * pixel + 1], r.position[4 * pixel + 2]);
        std::vector<Dipole<double>> dipoles;
        for (int c = 0; c < 3; ++c)
            dipoles.emplace_back(band(c).sigma_s_prime(), band(c).sigma_a, 1.3);
        Vec3d sum;
        for (std::size_t i = 0; i < r.entered.size(); i += 4) {
            if (!(r.entered[i + 3] > 0)) continue;
            const Vec3d x(r.light_position[i], r.light_position[i + 1], r.light_position[i + 2]);
            const double r2 = dot(p - x, p - x);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += r.entered[i + 3] * dipoles[c].eval(r2);
        }
        return sum * Vec3d(r.point.color) / (pi * ObjectBoundary(1.3f).mean_transmittance());
    }
    /// RMS deviation of the technique from the sum, over the RMS of the sum, at pixels spread over
    /// the object.
    static double deviation(const Recorded& r) {
        std::vector<std::size_t> pixels;
        for (std::size_t i = 0; i < r.position.size() / 4; ++i)
            if (r.position[4 * i + 3] > 0) pixels.push_back(i);
        double squares = 0, reference = 0;
        for (std::size_t k = 0; k < 24; ++k) {
            const std::size_t i = pixels[(2 * k + 1) * pixels.size() / 48];
            const Vec3d exact = brute_force(r, i);
            for (std::size_t c = 0; c < 3; ++c) {
                const double d = r.below[4 * i + c] - exact[c];
                squares += d * d;
                reference += exact[c] * exact[c];
            }
        }
        return std::sqrt(squares / reference);
    }
    void expect_sums(bool all);
    std::string slab(double thickness) const {
        return xml::shape("cube", fmt::format("<transform name=\"to_world\"><scale x=\"30\" "
                                              "y=\"30\" z=\"{}\"/></transform>",
                                              0.5 * thickness) +
                                      xml::flag("face_normals", true) + translucent());
    }
};

/// The technique's own error, apart from its kernel's. Nested squares come within 2 % RMS of the sum
/// over all texels; behind a ball of 40 mm, where light has fallen by e^17 in the densest band and R
/// changes much within a block, finer blocks do. Rings of 21 taps see an edge or a bent surface by
/// seven points only: 12 %, 22 % where light grazes the ball, behind it 30 % of what little comes
/// there.
class LongShadowMaps : public ShadowMaps {};

void ShadowMaps::expect_sums(bool all) {
    const std::string camera = sensor({0, 20, 100}, {0, 0, 0}, 64, 64, 40);
    const std::string ball = xml::sphere({0, 0, 0}, 20, translucent());
    struct Case {
        std::string name, body;
        double nested, fine, rings;
    };
    for (const Case& c :
         {Case{"slab, from behind", slab(8) + parallel_light({0, 0, 1}, 2), 0.02, 0.004, 0.12},
          Case{"slab, from the front", slab(8) + parallel_light({0.3, -0.2, -1}, 2), 0.02, 0.004,
               0.12},
          Case{"slab, a near point behind", slab(8) + point_light({5, 3, -60}, 1000), 0.02, 0.006,
               0.12},
          Case{"ball, from behind", ball + parallel_light({0, 0, 1}, 2), 0.06, 0.025, 0.3},
          Case{"ball, from the side", ball + parallel_light({-1, -0.3, 0}, 2), 0.02, 0.015, 0.22},
          Case{"ball, a point in front", ball + point_light({20, 30, 60}, 1000), 0.02, 0.005,
               0.12}}) {
        if (!all && !c.name.starts_with("slab, from b") && c.name != "ball, from the side")
            continue;
        const Scene s = scene(camera + c.body);
        EXPECT_LT(deviation(record(s, {}, 256)), c.nested) << c.name;
        EXPECT_LT(deviation(record(s, {{"blocks", "4"}}, 256)), c.fine) << c.name;
        EXPECT_LT(deviation(record(s, {{"pattern", "rings"}}, 256)), c.rings) << c.name;
    }
}

TEST_F(ShadowMaps, AreTheSumOverAllTexels) { expect_sums(false); }
TEST_F(LongShadowMaps, AreTheSumOverAllTexels) { expect_sums(true); }

/// What a light's picture holds in all is what comes through the cone that the object fills: of a
/// ball without a boundary, the intensity times 2 pi (1 - cos). Near enough that texels at the
/// picture's edge are half as large as those in its middle.
TEST_F(ShadowMaps, HoldAllLightOfACone) {
    const Scene s = scene(sensor({0, 20, 100}, {0, 0, 0}, 8, 8) + point_light({0, 0, 27}, 100) +
                          xml::sphere({0, 0, 0}, 20, xml::bsdf("null") + matter()));
    const Recorded r = record(s);
    double sum = 0;
    for (std::size_t i = 3; i < r.entered.size(); i += 4) sum += r.entered[i];
    const double sine = 20. / 27, expected = 2 * pi * (1 - std::sqrt(1 - sine * sine)) * 100;
    // The tessellated ball is smaller by up to a thousandth of its radius; pixels on its outline.
    EXPECT_NEAR(sum * r.point.color.x, expected, 0.005 * expected);
}

/// A wide slab evenly lit from behind, seen in its middle: rings are made to be exact there.
TEST_F(ShadowMaps, RingsAreExactBehindAPlane) {
    for (const double thickness : {0.5, 3., 12.}) {
        const Scene s =
            scene(sensor({0, 0, 40}, {0, 0, 0}, 8, 8, 4) + parallel_light({0, 0, 1}, 2) +
                  xml::shape("cube", fmt::format("<transform name=\"to_world\"><scale "
                                                 "x=\"150\" y=\"150\" "
                                                 "z=\"{}\"/></transform>",
                                                 0.5 * thickness) +
                                         xml::flag("face_normals", true) + translucent()));
        const Recorded r = record(s, {{"pattern", "rings"}});
        for (int c = 0; c < 3; ++c) {
            // Of uniform light on a plane at distance d: alpha'/2 sum of z e^(-sigma_tr h) / h with
            // h^2 = d^2 + z^2, the lateral integral of the dipole (compendium, 8.6).
            const Dipole<double> d(band(c).sigma_s_prime(), band(c).sigma_a, 1.3);
            double m = 0;
            for (const double z : {d.z_r, d.z_v}) {
                const double h = std::hypot(thickness, z);
                m += 0.5 * d.albedo * z * std::exp(-d.sigma_tr * h) / h;
            }
            const ObjectBoundary boundary(1.3f);
            const double expected =
                2 * boundary.transmittance(1.f) * m / (pi * boundary.mean_transmittance());
            EXPECT_NEAR(r.below[4 * 27 + std::size_t(c)], expected, 0.005 * expected)
                << thickness << " mm, band " << c;
        }
    }
}

/// Where the sources stand as in the paper: behind a plane its closed form (realtime.md, item 4),
/// which is another one than that of the distance.
TEST_F(ShadowMaps, PlacementAsInThePaper) {
    const double thickness = 6;
    const Scene s = scene(sensor({0, 0, 40}, {0, 0, 0}, 8, 8, 4) + parallel_light({0, 0, 1}, 2) +
                          xml::shape("cube", fmt::format("<transform name=\"to_world\"><scale "
                                                         "x=\"150\" y=\"150\" "
                                                         "z=\"{}\"/></transform>",
                                                         0.5 * thickness) +
                                                 xml::flag("face_normals", true) + translucent()));
    const Recorded r = record(s, {{"placement", "paper"}, {"pattern", "rings"}});
    for (int c = 0; c < 3; ++c) {
        const Dipole<double> d(band(c).sigma_s_prime(), band(c).sigma_a, 1.3);
        double m = 0;
        for (const auto& [z, h] : {std::pair{d.z_r, thickness - d.z_r}, {d.z_v, thickness + d.z_v}})
            m += 0.5 * d.albedo * z * std::exp(-d.sigma_tr * h) / h;
        const ObjectBoundary boundary(1.3f);
        const double expected =
            2 * boundary.transmittance(1.f) * m / (pi * boundary.mean_transmittance());
        EXPECT_NEAR(r.below[4 * 27 + std::size_t(c)], expected, 0.005 * expected) << "band " << c;
    }
}

}  // namespace
}  // namespace nacre
