// Sampling in image space against the sum over all texels of the lights' pictures, which hold all that
// enters, whichever picture the technique takes it from; and against closed forms.
#include "tests/realtime/kept_frame.h"

namespace nacre {
namespace {

Vec3d ray_of(const View& view, const Vec3d& x) {
    return view.parallel ? Vec3d(view.eye) : normalize(x - Vec3d(view.eye));
}
/// Clip coordinates x, y (over w) and w.
Vec3d clip_of(const View& view, const Vec3d& x) {
    double c[4];
    for (std::size_t k = 0; k < 4; ++k)
        c[k] = view.clip[k] * x.x + view.clip[4 + k] * x.y + view.clip[8 + k] * x.z +
               view.clip[12 + k];
    return {c[0] / c[3], c[1] / c[3], c[3]};
}
/// The sum that samples stand for, at a pixel: R over all that a light sees.
class BruteForce {
  public:
    BruteForce(const KeptFrame& frame, const RadialProfile& profile, int band)
        : f_(frame), profile_(profile), band_(band) {}

    double at(int x, int y) const {
        const Vec3d o = f_.at(f_.position, x, y);
        double sum = 0;
        for (const KeptLight& light : f_.lights)
            for (std::size_t k = 0; k < light.entered.size(); k += 4)
                if (light.entered[k + 3] > 0) sum += of_texel(o, light, k);
        return sum;
    }

  private:
    /// The mean of R over the texel, of parts of it on the plane that it shows.
    double of_texel(const Vec3d& o, const KeptLight& light, std::size_t k) const {
        const Vec3d p(light.position[k], light.position[k + 1], light.position[k + 2]),
            n(light.entered[k], light.entered[k + 1], light.entered[k + 2]);
        const Vec3d ray = ray_of(light.view, p);
        const double texel = light.view.pixel * clip_of(light.view, p).z;
        const Vec3d s = normalize(cross(ray, Vec3d(0, 1, 0))), t = cross(s, ray);
        const int parts = length(p - o) < 30 * texel ? 4 : 2;
        double sum = 0;
        for (int j = 0; j < parts; ++j)
            for (int i = 0; i < parts; ++i) {
                Vec3d q = p + s * (texel * ((i + 0.5) / parts - 0.5)) +
                          t * (texel * ((j + 0.5) / parts - 0.5));
                if (-dot(ray, n) > 0.05) q += ray * (dot(p - q, n) / dot(ray, n));
                sum += profile_.eval(std::max(length(q - o), 1e-3)) / (parts * parts);
            }
        return sum * light.entered[k + 3] * light.point.color[band_];
    }

    const KeptFrame& f_;
    const RadialProfile& profile_;
    int band_;
};

class ImageSpace : public KeptFrames {
  protected:
    static Vec3d mean_below(const std::vector<KeptFrame>& frames, int x, int y) {
        Vec3d sum;
        for (const KeptFrame& f : frames) sum += f.at(f.below, x, y) / double(frames.size());
        return sum;
    }
    /// Frames agree with the brute force at pixels of the object.
    void expect_brute_force(const std::string& body, const std::string& what, int frame_count,
                            double bound) {
        const std::vector<KeptFrame> frames =
            keep<image_space_technique>(scene(body), {{"samples", "250"}}, frame_count, 128);
        const KeptFrame& f = frames.front();
        std::vector<std::pair<int, int>> places;
        for (int y = 4; y < f.camera.height; y += 8)
            for (int x = 4; x < f.camera.width; x += 8)
                if (f.position[4 * std::size_t(y * f.camera.width + x) + 3] > 0)
                    places.emplace_back(x, y);
        ASSERT_GT(places.size(), 12u) << what;
        const double deviations = sidak_deviations(int(3 * places.size()));
        for (int b = 0; b < 3; ++b) {
            const auto profile = profile_of(b);
            const BruteForce brute(f, *profile, b);
            double all = 0, all_brute = 0;
            for (const auto& [x, y] : places) {
                const double truth = brute.at(x, y) * exit_scale();
                std::vector<Vec3d> values;
                for (const KeptFrame& one : frames) values.push_back(one.at(one.below, x, y));
                const RadianceEstimate e = RadianceEstimate::of(values);
                // Few frames hardly know their own error, whose distribution is skewed. The
                // camera's picture covers the object by whole pixels: an edge may lie 0.18 mm off,
                // and R integrated along it is up to some 0.5 of the total a mm.
                EXPECT_NEAR(e.mean[b], truth,
                            (frame_count < 10 ? 2 : 1.3) * deviations * e.error[b] + 0.1 * truth)
                    << what << ", band " << b << ", pixel " << x << " " << y;
                all += e.mean[b];
                all_brute += truth;
            }
            EXPECT_NEAR(all / all_brute, 1, bound) << what << ", band " << b;
        }
    }
};

std::string sphere_lit_from(const Vec3d& light) {
    return xml::integrator("path") + KeptFrames::sensor({0, 0, 40}, {0, 0, 0}, 48, 48, 18) +
           KeptFrames::point_light(light, 4000) +
           xml::sphere({0, 0, 0}, 5, KeptFrames::translucent());
}
std::string block_lit_from(double z) {
    return xml::integrator("path") + KeptFrames::sensor({12, 5, 40}, {0, 0, 0}, 48, 48, 24) +
           KeptFrames::point_light({10, 15, z}, 4000) +
           xml::shape("cube",
                      "<transform name=\"to_world\"><scale x=\"8\" y=\"8\" z=\"1\"/></transform>" +
                          xml::flag("face_normals", true) + KeptFrames::translucent());
}

TEST_F(ImageSpace, IsTheSumOverPicturesOfASphere) {
    expect_brute_force(sphere_lit_from({60, 20, 40}), "sphere", 6, 0.02);
}
TEST_F(ImageSpace, IsTheSumOverPicturesOfASlab) {
    expect_brute_force(block_lit_from(-30), "slab", 6, 0.02);
}
using LongImageSpace = ImageSpace;
TEST_F(LongImageSpace, IsTheSumOverPictures) {
    expect_brute_force(sphere_lit_from({60, 20, 40}), "sphere, light in front", 24, 0.02);
    expect_brute_force(sphere_lit_from({-50, 10, -40}), "sphere, light behind", 24, 0.02);
    expect_brute_force(block_lit_from(30), "slab, light in front", 24, 0.02);
    expect_brute_force(block_lit_from(-30), "slab, light behind", 24, 0.02);
}

/// Seen straight on, an evenly lit plane gives back its total, in both estimators.
TEST_F(ImageSpace, PlanesGiveBackTheTotal) {
    const Scene s = scene(lit_slab(50, false));
    for (const auto& [estimator, bound] : {std::pair{"weighted", 0.01}, {"fast", 1e-3}}) {
        const auto frames = keep<image_space_technique>(s, {{"estimator", estimator}}, 8);
        for (int b = 0; b < 3; ++b) {
            const double truth = profile_of(b)->total() * entered() * exit_scale();
            EXPECT_NEAR(mean_below(frames, 16, 16)[b] / truth, 1, bound) << estimator << b;
        }
    }
}

/// Lit from behind, straight through, R integrated over the plane at a depth is what is left of the
/// cumulative profile; the camera's picture alone has none of it.
TEST_F(ImageSpace, LightComesThroughSlabs) {
    for (const double thickness : {0.5, 2., 6.}) {
        const Scene s = scene(lit_slab(thickness, true));
        const auto frames = keep<image_space_technique>(s, {}, 8);
        const auto camera = keep<image_space_technique>(s, {{"pictures", "camera"}});
        for (int b = 0; b < 3; ++b) {
            const auto profile = profile_of(b);
            const double truth =
                (profile->total() - profile->cumulative(thickness)) * entered() * exit_scale();
            EXPECT_NEAR(mean_below(frames, 16, 16)[b] / truth, 1, 0.015)
                << thickness << " mm, band " << b;
            EXPECT_EQ(mean_below(camera, 16, 16)[b], 0.);
        }
    }
}

/// The same place from near and from far.
TEST_F(ImageSpace, DistanceOfTheCameraDoesNotMatter) {
    const auto from = [&](double distance) {
        const double fov = 2 * std::atan(7 / distance) * 180 / pi;
        const Scene s =
            scene(xml::integrator("path") + sensor({0, 0, distance}, {0, 0, 0}, 33, 33, fov) +
                  parallel_light({-0.3, 0, -1}, 2) + xml::sphere({0, 0, 0}, 5, translucent()));
        return mean_below(keep<image_space_technique>(s, {{"samples", "128"}}, 8), 16, 16);
    };
    const Vec3d near = from(25), far = from(400);
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(near[b] / far[b], 1, 0.01) << b;
}

/// Frames of one number are one picture, of other numbers others.
TEST_F(ImageSpace, StandsStillWithTheFrameNumber) {
    const Scene s = scene(lit_slab(2, true));
    const auto frames = keep<image_space_technique>(s, {}, 2),
               again = keep<image_space_technique>(s, {}, 1);
    EXPECT_EQ(frames[0].below, again[0].below);
    EXPECT_NE(frames[0].below, frames[1].below);
}

}  // namespace
}  // namespace nacre
