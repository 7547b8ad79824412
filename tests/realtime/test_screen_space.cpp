// The techniques of engines: what they keep, what they know of thickness, and that all techniques in
// image space follow changes.
#include "tests/realtime/kept_frame.h"

namespace nacre {
namespace {

class ScreenSpace : public KeptFrames {
  protected:
    template <const TechniqueDescription& (*technique)()>
    void expect_total(const std::string& body, double bound) {
        const KeptFrame f = keep<technique>(scene(body)).front();
        for (int b = 0; b < 3; ++b) {
            const double total = profile_of(b)->total() * exit_scale();
            int pixels = 0;
            for (int y = 0; y < f.camera.height; ++y)
                for (int x = 0; x < f.camera.width; ++x) {
                    if (!(f.at(f.lit, x, y)[b] > 0)) continue;
                    ++pixels;
                    ASSERT_NEAR(f.at(f.below, x, y)[b] / (total * f.at(f.lit, x, y)[b]), 1, bound)
                        << x << " " << y << " band " << b;
                }
            EXPECT_GT(pixels, 300);
        }
    }
};

/// Even light on a plane stays as it is, to its edges, straight on and slanted.
TEST_F(ScreenSpace, KeepsEvenLight) {
    const std::string slanted = xml::integrator("path") +
                                sensor({60, 0, 80}, {0, 0, 0}, 40, 40, 24) +
                                parallel_light({0, 0, -1}, 2) +
                                xml::shape("cube",
                                           "<transform name=\"to_world\"><scale x=\"20\" y=\"20\" "
                                           "z=\"0.005\"/></transform>" +
                                               xml::flag("face_normals", true) + translucent());
    for (const std::string& body : {lit_slab(50, false), slanted}) {
        expect_total<screen_diffusion_technique>(body, 1e-3);
        expect_total<separable_technique>(body, 1e-3);
    }
}

/// Seen against the light, what comes through falls by the transport coefficient.
TEST_F(ScreenSpace, ThicknessWeakensLight) {
    const double s[] = {1, 0.7, 2}, a[] = {0.02, 0.05, 0.03};
    for (const double thickness : {1., 3., 8.}) {
        const KeptFrame f =
            keep<thickness_trick_technique>(
                scene(lit_slab(thickness, true)),
                {{"strength", "0.7"}, {"ambient", "0.2"}, {"distortion", "0"}, {"power", "1"}})
                .front();
        for (int b = 0; b < 3; ++b) {
            const double transport = std::sqrt(3 * a[b] * (a[b] + s[b]));
            EXPECT_NEAR(
                f.at(f.below, 16, 16)[b] / (profile_of(b)->total() * exit_scale() * entered() *
                                            0.9 * std::exp(-transport * thickness)),
                1, 2e-3)
                << thickness << " mm, band " << b;
        }
    }
}

/// In front it is a Lambert surface of the profile's total.
TEST_F(ScreenSpace, ThicknessIsDiffuseInFront) {
    const KeptFrame f =
        keep<thickness_trick_technique>(scene(lit_slab(50, false)), {{"ambient", "0"}}).front();
    for (int b = 0; b < 3; ++b)
        EXPECT_NEAR(f.at(f.below, 16, 16)[b], profile_of(b)->total() * exit_scale() * entered(),
                    1e-4);
}

/// Told of a change, each renders what one made for the new scene renders, to the bit.
TEST_F(ScreenSpace, ChangesAreFollowed) {
    const auto body = [&](bool light, bool material) {
        return xml::integrator("path") + sensor({0, 0, 40}, {0, 0, 0}, 16, 16, 20) +
               point_light({light ? -40. : 40., 10, 30}, 4000) +
               xml::sphere({0, 0, 0}, 5, translucent(material ? 2 : 1));
    };
    for (const auto technique : {image_space_technique, screen_diffusion_technique,
                                 separable_technique, thickness_trick_technique})
        for (const Changes& what : {Changes{.light = true}, Changes{.material = true}}) {
            Scene s = scene(body(false, false));
            const Scene other = scene(body(what.light, what.material));
            const auto picture = [&](FrameRenderer& r, const Scene& of) {
                return r.render(camera_of(of, r.scene()), {.light_view = 64}).read();
            };
            FrameRenderer kept(gpu(), s, shapes_of(s, technique()));
            const std::vector<float> before = picture(kept, s);
            // Whoever keeps what he should not would look at what is gone.
            const auto gone = std::tuple{s.lights, s.shapes, s.media};
            if (what.light) s.lights = other.lights;
            if (what.material) {
                s.shapes[0].material = other.shapes[0].material;
                s.shapes[0].interior = other.shapes[0].interior;
                s.media = other.media;
            }
            kept.changed(what);
            const std::vector<float> after = picture(kept, s);
            FrameRenderer fresh(gpu(), other, shapes_of(other, technique()));
            EXPECT_EQ(after, picture(fresh, other)) << technique().name << ": " << what.text();
            EXPECT_NE(after, before) << technique().name << ": " << what.text();
        }
}

}  // namespace
}  // namespace nacre
