#pragma once
// What the tests of the integrators share: scenes from XML, radiance along hand-made rays with its
// standard error, and comparisons with a stated significance.
#include <oneapi/tbb/parallel_for.h>

#include <functional>

#include "nacre/image/image.h"
#include "nacre/render/integrator.h"
#include "nacre/spectrum/color.h"
#include "tests/scene/scene_files.h"
#include "tests/support/constants.h"

namespace nacre {

/// Mean of independent values of three channels, with its standard error.
struct RadianceEstimate {
    Vec3d mean, error;
    std::vector<Vec3d> values;  ///< what the mean was taken of

    static RadianceEstimate of(std::vector<Vec3d> values) {
        RadianceEstimate e;
        const auto n = static_cast<double>(values.size());
        for (const Vec3d& v : values) e.mean += v / n;
        for (const Vec3d& v : values) e.error += (v - e.mean) * (v - e.mean) / (n * (n - 1));
        for (int c = 0; c < 3; ++c) e.error[c] = std::sqrt(e.error[c]);
        e.values = std::move(values);
        return e;
    }
    /// Of the luminance.
    double luminance() const { return nacre::luminance(Vec3f(mean)); }
    double luminance_error() const {
        double sum = 0;
        for (const Vec3d& v : values) {
            const double d = nacre::luminance(Vec3f(v)) - luminance();
            sum += d * d;
        }
        const auto n = static_cast<double>(values.size());
        return std::sqrt(sum / (n * (n - 1)));
    }
};

struct EstimateOptions {
    std::string sampler = "independent";
    int pixels = 1000;  ///< independent estimates: each pixel's mean is one, whatever the sampler
    int samples = 16;   ///< a pixel
    std::uint64_t seed = 1;
};

/// A ray of the camera from two uniform numbers.
using RayMaker = std::function<Ray(Vec2f)>;

inline RayMaker fixed_ray(const Point3f& o, const Vec3f& d) {
    return [ray = Ray{o, normalize(d)}](Vec2f) { return ray; };
}

/// Parallel rays along `d` that start on a disk about o, normal to d.
inline RayMaker ray_bundle(const Point3f& o, const Vec3f& d, float radius) {
    const Framef frame = Framef::around(normalize(d));
    return [=](Vec2f u) {
        const float r = radius * std::sqrt(u.x), phi = static_cast<float>(2 * pi) * u.y;
        return Ray{o + frame.to_world({r * std::cos(phi), r * std::sin(phi), 0.f}), frame.n};
    };
}

/// Linear RGB that the integrator finds along the rays. Same options, same result.
inline RadianceEstimate estimate(const Scene& scene, const Integrator& integrator,
                                 const RayMaker& rays, const EstimateOptions& options = {}) {
    std::vector<Vec3d> means(static_cast<std::size_t>(options.pixels));
    const Sampler prototype(Sampler::kind_from_name(options.sampler), options.seed,
                            options.samples);
    tbb::parallel_for(0, options.pixels, [&](int pixel) {
        Sampler sampler = prototype;
        RayCounts counts;
        Vec3d sum;
        for (int s = 0; s < options.samples; ++s) {
            sampler.start(static_cast<std::uint64_t>(pixel), static_cast<std::uint32_t>(s));
            const Ray ray = rays(sampler.next2d());
            const Wavelengths wavelengths = scene.mode == ColorMode::spectral
                                                ? Wavelengths::sample(sampler.next1d())
                                                : Wavelengths::rgb_bands();
            const Spectral radiance = integrator.radiance(ray, sampler, wavelengths, counts);
            sum += Vec3d(to_rgb(radiance, wavelengths));
        }
        means[static_cast<std::size_t>(pixel)] = sum / options.samples;
    });
    return RadianceEstimate::of(std::move(means));
}

inline RadianceEstimate estimate(const Scene& scene, const RayMaker& rays,
                                 const EstimateOptions& options = {}) {
    return estimate(scene, *make_integrator(scene), rays, options);
}

/// Deviations of a standard normal variable that one of `tests` comparisons exceeds, in either
/// direction, with probability `significance` (Sidak 1967).
inline double sidak_deviations(int tests, double significance = 1e-3) {
    const double each = 1 - std::pow(1 - significance, 1.0 / tests);
    double low = 0, high = 10;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.)) > each ? low : high) = middle;
    }
    return low;
}

/// All channels agree with `truth` within `deviations` standard errors and rounding, and the
/// standard error is at most `largest_error`, so that deviations of a few times that are seen.
inline void expect_radiance(const RadianceEstimate& e, const Vec3d& truth, double largest_error,
                            const std::string& what, double deviations = 4, int channels = 3) {
    for (int c = 0; c < channels; ++c) {
        const double allowed = deviations * e.error[c] + 2e-5 * std::abs(truth[c]);
        if (!(std::abs(e.mean[c] - truth[c]) <= allowed))
            ADD_FAILURE() << what << ", channel " << c << ": " << e.mean[c] << " +- " << e.error[c]
                          << " instead of " << truth[c];
        if (!(e.error[c] <= largest_error))
            ADD_FAILURE() << what << ", channel " << c << ": standard error " << e.error[c]
                          << " is too large to tell, " << largest_error << " allowed";
    }
}

/// Two independent estimates agree within `deviations` standard errors of their difference. Where
/// they do not, the single values are left behind as pictures.
inline void expect_agreement(const RadianceEstimate& a, const RadianceEstimate& b,
                             double deviations, const std::string& what, int channels = 3) {
    for (int c = 0; c < channels; ++c) {
        const double error = std::hypot(a.error[c], b.error[c]);
        if (std::abs(a.mean[c] - b.mean[c]) <= deviations * error + 2e-5 * std::abs(a.mean[c]))
            continue;
        std::string files;
        for (const auto* e : {&a, &b}) {
            const auto* info = testing::UnitTest::GetInstance()->current_test_info();
            const std::string file = fmt::format("{}nacre_{}_{}_{}.pfm", testing::TempDir(),
                                                 info->name(), getpid(), e == &a ? "a" : "b");
            Image image(static_cast<int>(e->values.size()), 1);
            for (int x = 0; x < image.width; ++x)
                for (int k = 0; k < 3; ++k) image.at(x, 0, k) = float(e->values[x][k]);
            write_image(image, file);
            files += " " + file;
        }
        ADD_FAILURE() << what << ", channel " << c << ": " << a.mean[c] << " +- " << a.error[c]
                      << " and " << b.mean[c] << " +- " << b.error[c] << " differ by "
                      << std::abs(a.mean[c] - b.mean[c]) / error << " standard errors, "
                      << deviations << " allowed; values in" << files;
    }
}

/// Scenes from the text between <scene> and </scene>, and files that they need.
class RenderTest : public SceneFiles {
  protected:
    Scene scene(const std::string& body, std::optional<ColorMode> mode = ColorMode::rgb_bands) {
        LoadOptions options;
        options.mode = mode;
        return load_scene(write("scene.xml", "<scene version=\"3.0.0\">\n" + body + "</scene>\n"),
                          options);
    }
    /// An <emitter> with the radiance `upper` above the plane y = 0 and `lower` below it. 4096 rows
    /// make the step between them sharp to 0.04 degrees.
    std::string two_skies(const Vec3f& upper, const Vec3f& lower) const {
        Image image(2, 4096);
        for (int y = 0; y < image.height; ++y)
            for (int i = 0; i < 6; ++i)
                image.at(i / 3, y, i % 3) = y < image.height / 2 ? upper[i % 3] : lower[i % 3];
        write_image(image, folder_ / "sky.pfm");
        return "<emitter type=\"envmap\"><string name=\"filename\" value=\"sky.pfm\"/></emitter>";
    }
    /// An even sky of radiance 0.2 with a bright window of some 20 x 18 degrees about a direction up
    /// and to the side of -z.
    std::string window_sky(const Vec3f& radiance) const {
        Image image(128, 64);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) =
                        x >= 3 && x < 10 && y >= 21 && y < 27 ? radiance[std::size_t(c)] : 0.2f;
        write_image(image, folder_ / "window.pfm");
        return "<emitter type=\"envmap\"><string name=\"filename\" "
               "value=\"window.pfm\"/></emitter>";
    }
    /// Writes Mitsuba's .vol format: n^3 cells, value(x, y, z, channel).
    template <class F>
    void write_vol(const std::string& name, int n, int channels, F&& value) const {
        std::ofstream out(folder_ / name, std::ios::binary);
        const auto put = [&](const auto& v) {
            out.write(reinterpret_cast<const char*>(&v), sizeof v);
        };
        out.write("VOL\3", 4);
        for (const std::int32_t i : {1, n, n, n, channels}) put(i);
        for (const float f : {0.f, 0.f, 0.f, 1.f, 1.f, 1.f}) put(f);
        for (int z = 0; z < n; ++z)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    for (int c = 0; c < channels; ++c) put(float(value(x, y, z, c)));
    }
};

/// Pieces of scene files.
namespace xml {

inline std::string integrator(const std::string& type, const std::string& inside = "") {
    return "<integrator type=\"" + type + "\">" + inside + "</integrator>\n";
}
inline std::string flag(const std::string& name, bool value) {
    return "<boolean name=\"" + name + "\" value=\"" + (value ? "true" : "false") + "\"/>";
}
inline std::string integer(const std::string& name, int value) {
    return fmt::format("<integer name=\"{}\" value=\"{}\"/>", name, value);
}
inline std::string number(const std::string& name, double value) {
    return fmt::format("<float name=\"{}\" value=\"{}\"/>", name, value);
}
inline std::string rgb(const std::string& name, const Vec3d& v) {
    return fmt::format("<rgb name=\"{}\" value=\"{}, {}, {}\"/>", name, v.x, v.y, v.z);
}
inline std::string bsdf(const std::string& type, const std::string& inside = "") {
    return "<bsdf type=\"" + type + "\">" + inside + "</bsdf>";
}
inline std::string dielectric(double index) {
    return bsdf("dielectric", number("int_ior", index) + number("ext_ior", 1));
}
inline std::string rough_dielectric(double index, double alpha, const std::string& facets = "ggx") {
    return bsdf("roughdielectric", "<string name=\"distribution\" value=\"" + facets + "\"/>" +
                                       number("alpha", alpha) + number("int_ior", index) +
                                       number("ext_ior", 1));
}
inline std::string constant_light(double radiance = 1) {
    return "<emitter type=\"constant\">" + rgb("radiance", Vec3d(radiance, radiance, radiance)) +
           "</emitter>\n";
}
inline std::string area_light(const Vec3d& radiance) {
    return "<emitter type=\"area\">" + rgb("radiance", radiance) + "</emitter>";
}
inline std::string phase(const std::string& type, double g = 0) {
    return "<phase type=\"" + type + "\">" + (type == "hg" ? number("g", g) : "") + "</phase>";
}
inline std::string medium(const std::string& side, const std::string& inside) {
    return "<medium name=\"" + side + "\" type=\"homogeneous\">" + inside + "</medium>";
}
inline std::string shape(const std::string& type, const std::string& inside) {
    return "<shape type=\"" + type + "\">" + inside + "</shape>\n";
}
/// A sphere about a point.
inline std::string sphere(const Vec3d& center, double radius, const std::string& inside) {
    return shape("sphere", fmt::format("<point name=\"center\" x=\"{}\" y=\"{}\" z=\"{}\"/>",
                                       center.x, center.y, center.z) +
                               number("radius", radius) + inside);
}
/// A large sphere around everything that shines inwards.
inline std::string shining_shell(double radius, double radiance = 1) {
    return sphere({}, radius,
                  flag("flip_normals", true) + area_light(Vec3d(radiance, radiance, radiance)));
}

}  // namespace xml
}  // namespace nacre
