// Sampling in image space against the sum over all pixels of the camera's picture and all texels of
// the lights', and against closed forms.
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
double smooth(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0., 1.);
    return t * t * (3 - 2 * t);
}

/// The sum that samples stand for, at a pixel. What part of a place each picture has is that of the
/// technique; areas, distances and R are the test's own.
class BruteForce {
  public:
    BruteForce(const KeptFrame& frame, const RadialProfile& profile, int band)
        : f_(frame), profile_(profile), band_(band) {}

    double at(int x, int y) const {
        const Vec3d o = f_.at(f_.position, x, y);
        double sum = 0;
        for (int j = 0; j < f_.camera.height; ++j)
            for (int i = 0; i < f_.camera.width; ++i) sum += of_pixel(o, i, j);
        for (const KeptLight& light : f_.lights)
            for (std::size_t k = 0; k < light.entered.size(); k += 4)
                if (light.entered[k + 3] > 0) sum += of_texel(o, light, k);
        return sum;
    }

  private:
    bool is_seen(int x, int y) const {
        return f_.position[4 * std::size_t(y * f_.camera.width + x) + 3] > 0;
    }
    /// The mean of R over the pixel, of parts of it on the plane that it shows.
    double of_pixel(const Vec3d& o, int x, int y) const {
        if (!is_seen(x, y)) return 0;
        const Vec3d p = f_.at(f_.position, x, y), n = f_.at(f_.normal, x, y);
        const Vec3d ray = ray_of(f_.camera, p);
        const double d = length(p - Vec3d(f_.camera.eye)), cosine = -dot(ray, n);
        const double share = smooth(0.05, 0.2, cosine);
        if (share <= 0) return 0;
        const double w = clip_of(f_.camera, p).z, pixel = f_.camera.pixel * w, c = w / d;
        // Two sides of the pixel, on the plane.
        const Vec3d s = normalize(cross(ray, Vec3d(0, 1, 0))), t = cross(s, ray);
        double sum = 0;
        constexpr int parts = 4;
        for (int j = 0; j < parts; ++j)
            for (int i = 0; i < parts; ++i) {
                Vec3d q = p + s * (pixel * ((i + 0.5) / parts - 0.5)) +
                          t * (pixel * ((j + 0.5) / parts - 0.5));
                q += ray * (dot(p - q, n) / dot(ray, n));
                sum += profile_.eval(std::max(length(q - o), 1e-3)) / (parts * parts);
            }
        const double area = f_.camera.pixel * f_.camera.pixel * c * c * c * d * d / cosine;
        return sum * area * share * f_.at(f_.lit, x, y)[band_];
    }
    /// The same of a light's texel, without what the camera's picture has of it.
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
                sum += (1 - share_of_camera(q, n, texel)) *
                       profile_.eval(std::max(length(q - o), 1e-3)) / (parts * parts);
            }
        return sum * light.entered[k + 3] * light.point.color[band_];
    }
    double share_of_camera(const Vec3d& p, const Vec3d& own, double texel) const {
        const Vec3d c = clip_of(f_.camera, p);
        const int x = int(std::floor((c.x * 0.5 + 0.5) * f_.camera.width)),
                  y = int(std::floor((c.y * 0.5 + 0.5) * f_.camera.height));
        if (x < 0 || y < 0 || x >= f_.camera.width || y >= f_.camera.height || !is_seen(x, y))
            return 0;
        const Vec3d seen = f_.at(f_.position, x, y), n = f_.at(f_.normal, x, y);
        const double cosine = -dot(ray_of(f_.camera, p), n), pixel = f_.camera.pixel * c.z;
        const bool here = dot(own, n) > 0 && std::abs(dot(p - seen, n)) < 2 * pixel + texel &&
                          length(p - seen) < 3 * pixel / std::max(cosine, 0.05) + texel;
        return here ? smooth(0.05, 0.2, cosine) : 0;
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
            keep<image_space_technique>(scene(body), {{"samples", "250"}}, frame_count, 64);
        const KeptFrame& f = frames.front();
        std::vector<std::pair<int, int>> places;
        for (int y = 2; y < f.camera.height; y += 5)
            for (int x = 2; x < f.camera.width; x += 5)
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
                // Few frames hardly know their own error, whose distribution is skewed; here
                // texels are sums of few points.
                EXPECT_NEAR(e.mean[b], truth,
                            (frame_count < 10 ? 2 : 1.3) * deviations * e.error[b] + 0.02 * truth)
                    << what << ", band " << b << ", pixel " << x << " " << y;
                all += e.mean[b];
                all_brute += truth;
            }
            EXPECT_NEAR(all / all_brute, 1, bound) << what << ", band " << b;
        }
    }
};

std::string sphere_lit_from(const Vec3d& light) {
    return xml::integrator("path") + KeptFrames::sensor({0, 0, 40}, {0, 0, 0}, 32, 32, 18) +
           KeptFrames::point_light(light, 4000) +
           xml::sphere({0, 0, 0}, 5, KeptFrames::translucent());
}
std::string block_lit_from(double z) {
    return xml::integrator("path") + KeptFrames::sensor({12, 5, 40}, {0, 0, 0}, 32, 32, 24) +
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
    expect_brute_force(sphere_lit_from({60, 20, 40}), "sphere, light in front", 24, 0.01);
    expect_brute_force(sphere_lit_from({-50, 10, -40}), "sphere, light behind", 24, 0.01);
    expect_brute_force(block_lit_from(30), "slab, light in front", 24, 0.01);
    expect_brute_force(block_lit_from(-30), "slab, light behind", 24, 0.01);
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

/// The same place from other distances, and through a parallel camera's eyes the same again.
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
